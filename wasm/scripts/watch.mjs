// Seeing whether a program gets on. A limit on its time would judge the machine, not the program.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';

/** Clock ticks a second in /proc, the same on every Linux. */
const kTicks = 100;

/**
 * When a program counts as stuck. Output sets both counts back.
 *   still      seconds in which it used next to no processor time
 *   processor  seconds of processor time
 */
export const kLimits = { still: 600, processor: 3600 };

/** Every process: its id, its parent's, and the seconds of processor time of it and of its ended children. */
function processes() {
  try {
    return readdirSync('/proc').flatMap((name) => (/^\d+$/.test(name) ? readStat(name) : []));
  } catch {
    return fromPs();
  }
}

function readStat(name) {
  try {
    const text = readFileSync(`/proc/${name}/stat`, 'utf8');
    // The name of the program stands in parentheses and may hold anything.
    const fields = text.slice(text.lastIndexOf(')') + 2).split(' ').map(Number);
    return [{ id: Number(name), parent: fields[1], seconds: (fields[11] + fields[12] + fields[13] + fields[14]) / kTicks }];
  } catch {
    return []; // it has ended meanwhile
  }
}

function fromPs() {
  try {
    const lines = execFileSync('ps', ['-A', '-o', 'pid=,ppid=,time='], { encoding: 'utf8' }).trim().split('\n');
    return lines.map((line) => {
      const [id, parent, time] = line.trim().split(/\s+/);
      // [[days-]hours:]minutes:seconds
      const seconds = time.split(/[-:]/).reverse().reduce((sum, part, i) => sum + Number(part) * [1, 60, 3600, 86400][i], 0);
      return { id: Number(id), parent: Number(parent), seconds };
    });
  } catch {
    return [];
  }
}

/** The process `id` and all below it. */
function treeOf(id) {
  const all = processes();
  const tree = all.filter((process) => process.id === id);
  for (let i = 0; i < tree.length; i++) tree.push(...all.filter(({ parent }) => parent === tree[i].id));
  return tree;
}

/** Sends a signal to the process `id` and to all below it. */
export function killTree(id, signal) {
  for (const process_ of treeOf(id).reverse()) {
    try {
      process.kill(process_.id, signal);
    } catch {
      // it has ended by itself
    }
  }
}

/**
 * Kills the process `id` and all below it once it is stuck.
 *   every  seconds between two looks
 * Returns { progress(), end() }: to be called with each output, and at the end; end() says why the
 * process was killed, or nothing.
 */
export function watch(id, { still = kLimits.still, processor = kLimits.processor, every = 5 } = {}) {
  let [stillFor, usedWhenStill, usedAtOutput, fault] = [0, 0, 0, ''];
  let used = 0;
  const look = () => {
    used = Math.max(used, treeOf(id).reduce((sum, { seconds }) => sum + seconds, 0));
    // A count of looks, not a clock: a machine that was asleep has not been idle.
    stillFor += every;
    // A hundredth of one processor is what a program still has beside a hundred busy ones.
    if (used - usedWhenStill >= still / 100) [stillFor, usedWhenStill] = [0, used];
    if (stillFor >= still) fault = `for ${still} s it neither wrote a line nor used the processor`;
    else if (used - usedAtOutput >= processor) fault = `it used ${processor} s of processor time without writing a line`;
    if (fault) killTree(id, 'SIGKILL');
  };
  const timer = setInterval(look, every * 1000);
  return {
    progress: () => ([stillFor, usedWhenStill, usedAtOutput] = [0, used, used]),
    end() {
      clearInterval(timer);
      return fault;
    },
  };
}

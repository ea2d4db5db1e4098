// Times spanLoops of the built package on one curve file and prints what it found as one line of JSON.
// A process a case, so that memory and the engine's compilation are the case's own. Times are the
// processor's; the first run, in which the engine compiles, is told by the clock too.
//   node span.bench.mjs '{ "curves": file, "space", "objective", "weights": [3] or null,
//                          "bestSoFar": limits or null }'
import { readFileSync } from 'node:fs';
import { load, parseLoops, SoapfilmError, spanLoops } from 'soapfilm';
import { watchMemory } from './watch_memory.mjs';

// The same in span.cpp.
const kSecondsPerCase = 0.6;
const kDear = 2;
const kVeryDear = 5;
const kMostSeconds = 30;
const kLeastRuns = 3;
const kMostRuns = 500;

const kNothing = { cost: 0, lowerBound: 0, optimal: false, triangles: [] };

/** Runs until the median is worth something; dear cases fewer times, very dear ones once. */
function isEnough([first, ...warm]) {
  if (first > kVeryDear) return true;
  if (first > kDear) return warm.length >= 1;
  const spent = warm.reduce((sum, s) => sum + s, 0);
  return warm.length >= kMostRuns || (warm.length >= kLeastRuns && spent >= kSecondsPerCase);
}

/** FNV-1a of the triangles. */
function checksum(triangles) {
  let hash = 2166136261;
  for (const v of triangles) {
    for (let shift = 0; shift < 32; shift += 8) {
      hash = Math.imul(hash ^ ((v >>> shift) & 255), 16777619);
    }
  }
  return (hash >>> 0).toString(16).padStart(8, '0');
}

const peak = watchMemory();
await load({ parts: ['loops'] });
const { curves, space, objective, weights, bestSoFar } = JSON.parse(process.argv[2]);
const loops = parseLoops(readFileSync(curves));
const options = { candidates: space, objective };
if (weights) options.weights = { area: weights[0], perimeter: weights[1], dihedral: weights[2] };
if (bestSoFar) Object.assign(options, bestSoFar, { bestSoFar: true });

/** Seconds that this process has worked. */
function secondsWorked() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1e6;
}

const byClock = () => performance.now() / 1000;
// Limits of time are the clock's.
const now = bestSoFar ? byClock : secondsWorked;

class TooLong extends Error {}

function measure() {
  const seconds = [];
  let span, start, first;
  if (!bestSoFar) {
    options.onProgress = () => {
      if (now() - start > kMostSeconds) throw new TooLong();
    };
  }
  do {
    start = now();
    const clock = byClock();
    span = spanLoops(loops, options);
    first ??= byClock() - clock;
    seconds.push(now() - start);
    peak();
  } while (!isEnough(seconds));
  return { first, seconds, ...describe(span) };
}

function describe(span) {
  const { cost, lowerBound, optimal, triangles } = span.found ? span : kNothing;
  const { candidates, domains, minimalSets, peakBytes } = span.stats;
  return {
    peakBytes,
    processBytes: peak(),
    found: span.found,
    optimal,
    cost,
    lowerBound,
    candidates,
    domains,
    minimalSets,
    space: span.candidates,
    hash: checksum(triangles),
  };
}

/** What there is to print instead of figures. */
function problem(error) {
  if (error instanceof TooLong) return { problem: `> ${kMostSeconds} s` };
  if (error instanceof SoapfilmError) return { problem: error.code };
  throw error;
}

let found;
try {
  found = measure();
} catch (error) {
  found = problem(error);
}
console.log(JSON.stringify(found));

// npm run bench -- polygons [words…]: triangulators of polygons on the same inputs, in the same process,
// in turns. Medians of warm runs, in time of the processor, all threads of the process together; copies
// into and out of WebAssembly are in the times.
//   node polygon.bench.mjs <cases.mjs> <results.json> [words…]     all cases whose id holds the words
//   node polygon.bench.mjs <cases.mjs> --case <id>                 one case, as lines of JSON; the last holds
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { load, triangulatePolygon, triangulatePolygons } from 'soapfilm';
import { measureSessions } from './polygon_sessions.mjs';
import { angles, degrees, greedyStrips, maximumDegree } from './polygon_quality.mjs';
import { goals, kColumns, row, exponents } from './polygon_report.mjs';
import { kEngines } from './polygon_engines.mjs';
import { watchMemory } from './watch_memory.mjs';

/** Engines that are measured in turns with each other. */
const kQuick = new Set([...Object.keys(kEngines).slice(0, 6), 'earcut', 'earcut, refined']);
/** Time for the warm turns of all engines of a case together; how many there are at least. */
const kSeconds = 3;
const kLeastTurns = 6;
/** A turn is as many runs as take so long, or one: so quick engines, too, find their own in the caches. */
const kTurn = 0.01;
const kMostRuns = 1000;
/** An engine whose first run takes longer is run once more, or not at all; the shorter run counts. */
const kDear = 2;
const kVeryDear = 10;
/** Vertices of the inputs that are taken in turn, together. */
const kInTurn = 20_000;
/** A case that takes longer is given up. */
const kMostSeconds = 120;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function timed(run, count = 1) {
  const start = process.cpuUsage();
  for (let i = 0; i < count; i++) run();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1e6 / count;
}

/** Medians of seconds for each engine; a string where one fails. */
function race(runs, peak) {
  const seconds = {};
  const times = new Map();
  let peakBytes;
  for (const [name, run] of runs) {
    try {
      const first = timed(run);
      peakBytes ??= peak();
      times.set(name, first > kDear ? [first] : []);
      if (first > kDear) seconds[name] = first > kVeryDear ? first : Math.min(first, timed(run));
    } catch (error) {
      seconds[name] = `fails: ${error.code ?? error.message}`;
    }
  }
  const going = runs.filter(([name]) => times.get(name)?.length === 0);
  const end = performance.now() + 1000 * kSeconds;
  const counts = new Map();
  for (let turn = 0; going.length > 0 && (turn < kLeastTurns || performance.now() < end); turn++) {
    for (const [name, run] of going) {
      const took = timed(run, counts.get(name));
      times.get(name).push(took);
      counts.set(name, Math.floor(Math.min(Math.max(kTurn / took, 1), kMostRuns)));
    }
  }
  // The first turns warm up: compilers of JavaScript and of WebAssembly come back to what runs often.
  for (const [name] of going) {
    const all = times.get(name);
    seconds[name] = median(all.slice(Math.ceil(all.length / 4)));
  }
  return { seconds, peakBytes };
}

function look(polygon, points, run) {
  const positions = Float64Array.from([...polygon.flat(), ...(points ?? [])].flat());
  const triangles = run().flat(2);
  return { ...angles(positions, triangles), degree: maximumDegree(triangles) };
}

function qualities(polygons, points) {
  const [polygon] = polygons;
  const found = {};
  const names = points
    ? ['flooding', 'trapezoids', 'delaunay']
    : ['flooding', 'trapezoids', 'delaunay', 'earcut', 'earcut, refined', 'cdt2d'];
  const flat = points && Float64Array.from(points.flat());
  for (const name of names) {
    const run = kEngines[name].prepare(polygons, flat);
    found[name] = look(polygon, points, () => [...run()]);
  }
  const options = { method: 'trapezoids', output: 'strips' };
  const starts = Uint32Array.of(0, polygon[0].length);
  const positions = Float64Array.from(polygon.flat(2));
  const { triangles, strips, stripStarts } = triangulatePolygon(
    { positions, starts, ...(points && { points: flat }) },
    options,
  );
  const m = triangles.length / 3;
  return {
    ...found,
    strips: {
      indices: strips.length / m,
      length: m / (stripStarts.length - 1),
      greedyLength: m / greedyStrips(triangles),
      ...degrees(positions, points, triangles),
    },
  };
}

async function measureCase(c) {
  const peak = watchMemory();
  await load({ parts: ['polygons'] });
  const { polygons: all, points } = c.make(kSeed);
  const errors = c.validOnly ? triangulatePolygons(all, { skipInvalid: true }).errors : [];
  const invalid = new Set(errors.map(({ polygon }) => polygon));
  const polygons = all.filter((_, p) => !invalid.has(p));
  const n = polygons.flat(2).length + (points?.length ?? 0);
  const inner = points && Float64Array.from(points.flat());
  const names = Object.keys(kEngines).filter((name) => {
    if (name === 'one by one') return c.oneByOne;
    const takesPoints = ['flooding', 'trapezoids', 'delaunay', 'verify', 'strips'].includes(name);
    return points ? takesPoints : n / polygons.length <= kEngines[name].most;
  });
  const inputs = c.inTurn ? Math.ceil(kInTurn / n) : 1;
  const others = Array.from({ length: inputs - 1 }, (_, i) => c.make(kSeed + 1 + i).polygons);
  const racers = (wanted) =>
    names.filter(wanted).map((name) => {
      const runs = [polygons, ...others].map((input) => kEngines[name].prepare(input, inner, c.repairs));
      let next = 0;
      return [name, () => runs[next++ % runs.length]()];
    });
  // Flooding first, so that the peak is its own; the slower ones last, since a case may take too long.
  const { seconds, peakBytes } = race(racers((name) => kQuick.has(name)), peak);
  const found = { n, polygons: polygons.length, seconds, peakBytes };
  console.log(JSON.stringify(found));
  if (c.quality) found.quality = qualities(polygons, points);
  for (const slow of names.filter((name) => !kQuick.has(name))) {
    Object.assign(seconds, race(racers((name) => name === slow), peak).seconds);
    console.log(JSON.stringify(found));
  }
}

function measureApart(module, c) {
  const args = [fileURLToPath(import.meta.url), module, '--case', c.id];
  const { stdout, stderr } = spawnSync(process.execPath, ['--stack-size=4000', ...args], {
    encoding: 'utf8',
    timeout: 1000 * kMostSeconds,
    maxBuffer: 2 ** 26,
  });
  const lines = stdout.trim().split('\n');
  return lines[0] ? JSON.parse(lines[lines.length - 1]) : { problem: stderr.slice(-500) || `> ${kMostSeconds} s` };
}

const [, , module, second, ...words] = process.argv;
const { polygonCases, kSeed } = await import(pathToFileURL(module).href);
if (second === '--case') {
  const c = polygonCases().find(({ id }) => id === words.join(' '));
  await measureCase(c);
} else {
  const wanted = polygonCases().filter(({ id }) => words.every((word) => id.includes(word)));
  console.log(kColumns);
  const results = wanted.map((c) => {
    const { id, family, ratio, limit, repairs, title } = c;
    const result = { id, family, ratio, limit, repairs, title, ...measureApart(module, c) };
    console.log(row(result));
    return result;
  });
  const sessions = words.length === 0 || words.includes('session') ? await measureSessions(module) : [];
  for (const lines of [exponents(results), goals(results, sessions)]) console.log(`\n${lines.join('\n')}`);
  writeFileSync(second, `${JSON.stringify({ node: process.versions.node, results, sessions }, null, 1)}\n`);
}

// Off the main thread: progress, cancelling, the best answer so far, and two solves at once.
import { createWorker } from 'soapfilm/worker';

const film = await createWorker({ size: 2 });

const wave = (radius, z, count) =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z + 0.3 * Math.cos(2 * angle)];
  });

const [tube, disc] = await Promise.all([
  film.spanLoops([wave(1, 0, 12), wave(1, 1, 12)]),
  film.spanLoops([wave(1, 0, 40)]),
]);
console.log(`tube: ${tube.triangles.length / 3} triangles`);
console.log(`disc: ${disc.triangles.length / 3} triangles`);

// Cancelling rejects the promise with the code `cancelled`; the worker can be used again.
const controller = new AbortController();
const long = film.spanLoops([wave(1, 0, 60), wave(1, 2, 60)], {
  candidates: 'all',
  signal: controller.signal,
  onProgress: () => controller.abort(),
});
try {
  await long;
} catch (error) {
  console.log(`cancelled: ${error.code}`);
}

// With `bestSoFar` the work ends with the best surface found until then, and says how good it is: here once that is
// proven to cost less than twice the optimum. `maxSeconds` would be another way to end it.
const enough = new AbortController();
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2].map((x) => 3 * x));
const best = await film.spanLoops(
  corners.map((at) => wave(1, 0, 12).map((point) => point.map((x, i) => x + at[i] + 0.02 * at[(i + 1) % 3]))),
  {
    candidates: 'delaunay',
    bestSoFar: true,
    signal: enough.signal,
    onProgress: (fraction, bestCost, lowerBound) => {
      if (bestCost < 2 * lowerBound) enough.abort();
    },
  },
);
console.log(
  `eight loops, ended early: ${best.triangles.length / 3} triangles, ` +
    `at most ${Math.ceil(100 * (best.cost / best.lowerBound - 1))} % above the optimum`,
);

let reports = 0;
const last = await film.spanLoops([wave(1, 0, 200)], {
  candidates: 'all',
  onProgress: () => (reports += 1),
});
console.log(`afterwards: ${last.triangles.length / 3} triangles, progress reported ${reports > 0}`);

film.dispose();

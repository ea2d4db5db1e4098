// Loops on their way to a worker: how long the caller is held up until they are under way. Prints the times,
// in seconds, as one line of JSON.
//   node transfer.bench.mjs
import { createWorker } from 'soapfilm/worker';

const kVertices = 100_000;
const kCalls = 100;

const loop = Array.from({ length: kVertices }, (_, i) => {
  const angle = (2 * Math.PI * i) / kVertices;
  return [Math.cos(angle), Math.sin(angle), 0.1 * Math.sin(3 * angle)];
});
const forms = {
  'arrays of numbers': [loop],
  'objects with x, y and z': [loop.map(([x, y, z]) => ({ x, y, z }))],
  'flat arrays': { positions: Float64Array.from(loop.flat()), starts: Uint32Array.of(0, kVertices) },
};

const film = await createWorker({ parts: ['loops'] });
const seconds = Object.fromEntries(Object.keys(forms).map((form) => [form, []]));
// In turns, so that whatever else goes on meets all forms alike.
for (let call = 0; call < kCalls; call++) {
  for (const [form, loops] of Object.entries(forms)) {
    const begin = performance.now();
    // Ended as soon as the core looks up: the worker's time is not what is measured.
    const work = film.spanLoops(loops, { maxSeconds: 0 });
    const end = performance.now();
    const code = await work.then(() => 'done', (error) => error.code);
    if (code !== 'time-limit') throw new Error(`${form}: ${code}`);
    seconds[form].push((end - begin) / 1000);
  }
}
film.dispose();
console.log(JSON.stringify({ vertices: kVertices, seconds }));

// One vertex moved in a PolygonSession, against triangulating anew: in the quickest way, and in the one
// that gives what a session has, Delaunay triangles, certified, and strips.
import { pathToFileURL } from 'node:url';
import { PolygonSession, load, triangulatePolygon } from 'soapfilm';

const kMoves = 3000;
const kWarm = 1500;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function timed(run) {
  const start = performance.now();
  run();
  return (performance.now() - start) / 1000;
}

/** Each vertex moves by up to a third of an edge, and back. */
function measure({ id, goal, ring, inner }) {
  const polygon = {
    positions: Float64Array.from(ring.flat()),
    starts: Uint32Array.of(0, ring.length),
    points: Float64Array.from(inner.flat()),
  };
  const session = new PolygonSession(polygon);
  const moves = [];
  const anew = [];
  const alike = [];
  const same = { quality: 'delaunay', output: 'strips', verify: true };
  for (let i = 0; i < kWarm + kMoves; i++) {
    const v = (i * 7919) % ring.length;
    const [a, b] = [ring[v], ring[(v + 1) % ring.length]];
    const to = [a[0] + (b[0] - a[0]) / 3, a[1] + (b[1] - a[1]) / 3];
    const there = timed(() => session.move(v, to));
    const back = timed(() => session.move(v, a));
    if (i >= kWarm) moves.push(there, back);
    if (i % 10 !== 0) continue;
    anew.push(timed(() => triangulatePolygon(polygon)));
    alike.push(timed(() => triangulatePolygon(polygon, same)));
  }
  const { certified } = session.read();
  session.dispose();
  if (!certified) throw new Error(`${id}: not certified`);
  const [move, scratch, full] = [moves, anew, alike].map(median);
  return { id, goal, move, scratch, full, share: scratch / move };
}

export async function measureSessions(module) {
  await load({ parts: ['polygons'] });
  const { sessionCases } = await import(pathToFileURL(module).href);
  const found = sessionCases().map(measure);
  for (const { id, move, scratch, full } of found) {
    const [quick, alike] = [scratch, full].map((seconds) => (1e6 * seconds).toFixed(0));
    const moved = (1e6 * move).toFixed(1);
    console.log(`${id}: moved in ${moved} µs; anew in ${quick} µs, with the same result in ${alike} µs`);
  }
  return found;
}

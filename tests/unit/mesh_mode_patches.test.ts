import { fillHoles, findHoles, load } from 'soapfilm';
import { beforeAll, test } from 'vitest';
import { turned, together, type Mesh } from '../support/meshes.js';
beforeAll(() => load({ parts: ['meshes'] }));
function disc(x: number, y: number, z=0): Mesh {
  const corners = Array.from({ length: 6 }, (_, i) => [x + 0.3 * Math.cos((Math.PI * i) / 3), y + 0.3 * Math.sin((Math.PI * i) / 3), z]);
  return { positions: Float64Array.from(corners.flat()), faces: Uint32Array.of(0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5) };
}
function plate(): Mesh {
  const xy = [-3, -3, 15, -3, 15, 13, -3, 13, 0, 0, 12, 0, 12, 5, 12, 10, 0, 10, 0, 5.5, 0, 4.5];
  const positions = Float64Array.from({length: 33}, (_, i) => i % 3 === 2 ? 0 : xy[2 * Math.floor(i/3) + i % 3]);
  const faces = Uint32Array.of(0,1,5, 0,5,4, 1,2,6, 1,6,5, 2,7,6, 2,3,8, 2,8,7, 0,4,10, 0,10,3, 3,10,9, 3,9,8, 9,10,6);
  return {positions, faces}; }

test('x', () => {
  const out: string[] = [];
  for (const tilt of [0, 1]) for (const flip of [0,1,2,3]) for (const z of [.3, .6, 1]) for (const [xa, xb] of [[4,8],[5,7],[3,6]]) {
  const put = (x: number, y: number, z: number, f: number): Mesh => {
    const d = disc(0, 0);
    const at = Float64Array.from({length: d.positions.length}, (_, i) => { const v = i - i % 3; const q = [d.positions[v], d.positions[v+1]];
      return tilt ? [x + q[1] * .5, y, z + q[0]][i%3] : [x + q[0], y + q[1], z][i % 3]; });
    const m = { positions: at, faces: d.faces };
    return f ? turned(m) : m;
  };
  const mesh = together(plate(), ...[xa,xb].flatMap((x, i) => [put(x, 5 + (i ? -1 : 1)*.5*(1-x/12), z, flip&1), put(x, 5 + (i ? -1 : 1)*.5*(1-x/12), -z, flip & 2)]));
  try {
    const f = fillHoles(mesh, { candidates: 'delaunay', groups: [[0],[1,5,6],[2,3,4]], holes: [1,2] });
    out.push([tilt, flip, z, xa, xb, f.splitFaces.map(s => [s.face, s.count]).join('/'), f.holes.slice(1).map(h => [h.status, h.reason, h.faces, h.intersections.length].join(' ')).join(' | ')].join(' '));
    } catch (e) { out.push(String(e)); }
  }
  console.log(out.join('\n'));
});

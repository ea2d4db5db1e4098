// Meshes as STL in binary.
import type { MeshLike } from './types.js';

/** @param mesh checked */
export function writeStl({ positions: p, faces }: MeshLike): Uint8Array<ArrayBuffer> {
  const m = faces.length / 3;
  const bytes = new Uint8Array(84 + 50 * m);
  bytes.set(new TextEncoder().encode('soapfilm'));
  const data = new DataView(bytes.buffer);
  data.setUint32(80, m, true);
  for (let f = 0; f < m; f++) {
    const [a, b, c] = [3 * faces[3 * f], 3 * faces[3 * f + 1], 3 * faces[3 * f + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(x, y, z) || 1;
    const at = 84 + 50 * f;
    data.setFloat32(at, x / length, true);
    data.setFloat32(at + 4, y / length, true);
    data.setFloat32(at + 8, z / length, true);
    for (let k = 0; k < 3; k++) {
      data.setFloat32(at + 12 + 4 * k, p[a + k], true);
      data.setFloat32(at + 24 + 4 * k, p[b + k], true);
      data.setFloat32(at + 36 + 4 * k, p[c + k], true);
    }
  }
  return bytes;
}

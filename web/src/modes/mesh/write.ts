// Meshes as files; fetched when first wanted.
import type { MeshShape } from './settings.ts';

/** Nine digits give a number in single precision back as it was. */
const digits = (x: number): string => String(Number(x.toPrecision(9)));

/** Pieces of text, so that none is larger than a text may be. */
const kLines = 100_000;

export function writeObj({ positions: p, faces }: MeshShape, name: string): Blob {
  const pieces = [`# soapfilm\no ${name.replace(/\s+/g, ' ')}\n`];
  put(pieces, p.length, (i) => `v ${digits(p[i])} ${digits(p[i + 1])} ${digits(p[i + 2])}\n`);
  put(pieces, faces.length, (i) => `f ${faces[i] + 1} ${faces[i + 1] + 1} ${faces[i + 2] + 1}\n`);
  return new Blob(pieces, { type: 'model/obj' });
}

function put(pieces: string[], length: number, line: (at: number) => string): void {
  for (let from = 0; from < length; from += 3 * kLines) {
    let piece = '';
    for (let i = from; i < Math.min(length, from + 3 * kLines); i += 3) piece += line(i);
    pieces.push(piece);
  }
}

/** PLY in binary, little-endian. */
export function writePly({ positions, faces }: MeshShape): Blob {
  const [n, m] = [positions.length / 3, faces.length / 3];
  const header =
    `ply\nformat binary_little_endian 1.0\ncomment soapfilm\nelement vertex ${n}\nproperty float x\nproperty float y\nproperty float z\n` +
    `element face ${m}\nproperty list uchar int vertex_indices\nend_header\n`;
  const data = new DataView(new ArrayBuffer(12 * n + 13 * m));
  positions.forEach((x, i) => { data.setFloat32(4 * i, x, true); });
  for (let f = 0; f < m; f++) {
    const at = 12 * n + 13 * f;
    data.setUint8(at, 3);
    for (let k = 0; k < 3; k++) data.setInt32(at + 1 + 4 * k, faces[3 * f + k], true);
  }
  return new Blob([header, data], { type: 'application/octet-stream' });
}

/** STL in binary. */
export function writeStl({ positions: p, faces }: MeshShape): Blob {
  const m = faces.length / 3;
  const data = new DataView(new ArrayBuffer(84 + 50 * m));
  Array.from('soapfilm').forEach((letter, i) => { data.setUint8(i, letter.charCodeAt(0)); });
  data.setUint32(80, m, true);
  for (let f = 0; f < m; f++) {
    const [a, b, c] = [3 * faces[3 * f], 3 * faces[3 * f + 1], 3 * faces[3 * f + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(...normal) || 1;
    const at = 84 + 50 * f;
    normal.forEach((x, k) => { data.setFloat32(at + 4 * k, x / length, true); });
    [a, b, c].forEach((from, corner) => {
      for (let k = 0; k < 3; k++) data.setFloat32(at + 12 * (corner + 1) + 4 * k, p[from + k], true);
    });
  }
  return new Blob([data], { type: 'model/stl' });
}

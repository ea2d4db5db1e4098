// Meshes as PLY in binary, little-endian, with all their attributes.
import { kColor, kUv } from './mesh_file.js';
import type { MeshAttribute, MeshLike } from './types.js';

/** A property of vertices, and how it is stored. */
interface Column {
  readonly name: string;
  readonly type: 'float' | 'double' | 'uchar';
  readonly at: (vertex: number) => number;
}

const kBytes = { float: 4, double: 8, uchar: 1 };

/** @param mesh checked */
export function writePly({ positions, faces, attributes = {} }: MeshLike): Uint8Array<ArrayBuffer> {
  const [n, m] = [positions.length / 3, faces.length / 3];
  const type = positions instanceof Float64Array ? 'double' : 'float';
  const columns = ['x', 'y', 'z'].map((name, axis): Column => ({ name, type, at: (v) => positions[3 * v + axis] }));
  for (const [name, attribute] of Object.entries(attributes)) columns.push(...columnsOf(name, attribute, columns));
  const header = new TextEncoder().encode(
    `ply\nformat binary_little_endian 1.0\ncomment soapfilm\nelement vertex ${n}\n` +
      columns.map((column) => `property ${column.type} ${column.name}\n`).join('') +
      `element face ${m}\nproperty list uchar int vertex_indices\nend_header\n`,
  );
  const row = columns.reduce((sum, column) => sum + kBytes[column.type], 0);
  const bytes = new Uint8Array(header.length + row * n + 13 * m);
  bytes.set(header);
  const data = new DataView(bytes.buffer, header.length);
  let from = 0;
  for (const column of columns) {
    for (let v = 0, at = from; v < n; v++, at += row) {
      const value = column.at(v);
      if (column.type === 'float') data.setFloat32(at, value, true);
      else if (column.type === 'double') data.setFloat64(at, value, true);
      else data.setUint8(at, Math.round(255 * Math.min(1, Math.max(0, value))));
    }
    from += kBytes[column.type];
  }
  for (let f = 0; f < m; f++) {
    const at = row * n + 13 * f;
    data.setUint8(at, 3);
    for (let k = 0; k < 3; k++) data.setInt32(at + 1 + 4 * k, faces[3 * f + k], true);
  }
  return bytes;
}

/** Names without blanks, and none twice. */
function columnsOf(name: string, { data, size }: MeshAttribute, others: readonly Column[]): Column[] {
  const isColor = name === kColor;
  const names = isColor ? ['red', 'green', 'blue', 'alpha'] : name === kUv ? ['s', 't'] : [];
  const taken = new Set(others.map((other) => other.name));
  return Array.from({ length: size }, (_, k): Column => {
    let own = names.length > 0 ? names[k] : `${name.replace(/\s+/g, '_') || '_'}${size > 1 ? `_${k}` : ''}`;
    while (taken.has(own)) own += '_';
    taken.add(own);
    return { name: own, type: isColor ? 'uchar' : 'float', at: (v) => data[size * v + k] };
  });
}

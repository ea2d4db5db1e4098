// Meshes as OBJ, with colours after the coordinates.
import { kColor, kUv } from './mesh_file.js';
import type { MeshLike } from './types.js';
import { digitsOf, TextWriter } from './write_text.js';

/** @param mesh checked */
export function writeObj({ positions: p, faces, attributes = {} }: MeshLike, name: string): Uint8Array<ArrayBuffer> {
  const writer = new TextWriter();
  writer.add(`# soapfilm\no ${name.replace(/\s+/g, ' ')}\n`);
  const digits = digitsOf(p);
  const color = kColor in attributes ? attributes[kColor] : null;
  const uv = kUv in attributes ? attributes[kUv] : null;
  for (let v = 0; v < p.length / 3; v++) {
    let line = `v ${digits(p[3 * v])} ${digits(p[3 * v + 1])} ${digits(p[3 * v + 2])}`;
    // Alpha has no place here.
    if (color) for (let k = 0; k < 3; k++) line += ` ${Number(color.data[color.size * v + k].toPrecision(6))}`;
    writer.add(`${line}\n`);
  }
  if (uv) {
    const short = digitsOf(uv.data);
    for (let i = 0; i < uv.data.length; i += 2) writer.add(`vt ${short(uv.data[i])} ${short(uv.data[i + 1])}\n`);
  }
  const corner = (v: number): string => (uv ? `${v + 1}/${v + 1}` : String(v + 1));
  for (let i = 0; i < faces.length; i += 3) writer.add(`f ${corner(faces[i])} ${corner(faces[i + 1])} ${corner(faces[i + 2])}\n`);
  return writer.taken();
}

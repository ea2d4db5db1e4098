// The package's entry for files of meshes. It needs no `load`.
import { choiceOf, guarded, mustBe, optionsOf, viewOf } from './check.js';
import { SoapfilmError } from './errors.js';
import { flattenMesh } from './hole_input.js';
import { badFile, kColor, kUv, type MeshFile, type MeshFormat, type ReadMeshOptions } from './mesh_file.js';
import { readObj } from './read_obj.js';
import { readPly } from './read_ply.js';
import { isBinaryStl, readStl } from './read_stl.js';
import type { MeshInput, MeshLike } from './types.js';
import { writeObj } from './write_obj.js';
import { writePly } from './write_ply.js';
import { writeStl } from './write_stl.js';

export type { MeshFile, MeshFormat, ReadMeshOptions } from './mesh_file.js';
export type { MeshAttribute, MeshInput, MeshLike } from './types.js';

/**
 * Reads the triangles in a file: OBJ, PLY and STL, each as text or binary, and GLB. What is in the file tells its format.
 *
 * Vertices are those of the file, in its order, so that faces that share a vertex there share it here. STL and GLB have
 * vertices for each face or for each piece of a texture: those at the same place become one. Polygons become triangles.
 * All objects of a file become one mesh; those of GLB are put where its scene has them.
 *
 * Attributes: `color` has red, green, blue, and perhaps alpha, from 0 to 1, as displays take them. `uv` has texture
 * coordinates from the lower left corner; where a vertex has several of them, the option `seams` says what becomes of them. Other numbers of the vertices in PLY have the names that they have
 * there. `warnings` says what was left out.
 *
 * @param name of the file: its extension counts where the content could be of several formats
 * @returns positions are as precise as the file: those of OBJ, and doubles of PLY, are a `Float64Array`
 * @throws SoapfilmError `bad-file` if it is in none of the formats, or broken, with `line`, `vertex` or `face` where known;
 *   `bad-option`
 */
export async function readMesh(bytes: ArrayBuffer | Uint8Array, name = '', options: ReadMeshOptions = {}): Promise<MeshFile> {
  if (typeof name !== 'string') throw mustBe('bad-option', 'name', 'a string', name);
  const given = optionsOf<ReadMeshOptions>(options, { seams: true });
  const seams = choiceOf<'join' | 'split'>('seams', ['join', 'split'], given.seams);
  const content = guarded('bad-file', 'bytes', () => utf8(bytesOf(bytes)));
  try {
    switch (formatOf(content, name)) {
      case 'obj':
        return readObj(content, seams);
      case 'ply':
        return readPly(content);
      case 'stl':
        return readStl(content);
      case 'glb':
        return await (await import('./glb.js')).readGlb(content, seams);
    }
  } catch (error) {
    // Arrays cannot be of any length.
    if (error instanceof RangeError) throw new SoapfilmError('too-large', 'The file is too large to be read at once', {}, { cause: error });
    throw error;
  }
}

type Bytes = Uint8Array<ArrayBuffer>;

const tagOf = (value: unknown): string => Object.prototype.toString.call(value);

/** A view of the bytes; a copy of memory that is shared, which decoders refuse. */
function bytesOf(given: unknown): Bytes {
  const isBuffer = tagOf(given) === '[object ArrayBuffer]';
  const bytes = isBuffer ? new Uint8Array(given as ArrayBuffer) : viewOf(['Uint8Array'], given);
  if (!bytes) throw mustBe('bad-file', 'bytes', 'an ArrayBuffer or a Uint8Array', given);
  return tagOf(bytes.buffer) === '[object ArrayBuffer]' ? bytes : bytes.slice();
}

/** Text of 16 bits in UTF-8, and without a byte order mark; other content as it is. */
function utf8(bytes: Bytes): Bytes {
  const [first, second, third] = bytes;
  if (first === 0xef && second === 0xbb && third === 0xbf) return bytes.subarray(3);
  const encoding = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : null;
  return encoding === null ? bytes : new TextEncoder().encode(new TextDecoder(encoding).decode(bytes));
}

/** Enough to tell a format by its beginning. */
const kHeadBytes = 4096;

function formatOf(bytes: Uint8Array, name: string): MeshFormat {
  const head = new TextDecoder('latin1').decode(bytes.subarray(0, kHeadBytes));
  if (head.startsWith('glTF')) return 'glb';
  if (/^ply\s/.test(head)) return 'ply';
  if (isBinaryStl(bytes)) return 'stl';
  const extension = /\.(obj|ply|stl|glb)$/i.exec(name)?.[1].toLowerCase();
  const isText = !head.includes('\0');
  if (isText && (extension === 'obj' || extension === 'stl')) return extension;
  if (isText && /^\s*solid\b[^]*\bfacet\b/i.test(head)) return 'stl';
  if (isText && /^[ \t]*(v|vn|vt|f|o|g|mtllib)[ \t]/m.test(head)) return 'obj';
  if (!isText && extension === 'stl') return 'stl';
  // Many comments may come first.
  if (isText && /^\s*#/.test(head)) return 'obj';
  throw badFile(bytes.length === 0 ? 'the file is empty' : 'the file is in none of the formats OBJ, PLY, STL and GLB');
}

/** Options of `writeMesh`. */
export interface WriteMeshOptions {
  /** Of the object, in OBJ and GLB. */
  readonly name?: string;
}

const kFormats: readonly MeshFormat[] = ['obj', 'ply', 'stl', 'glb'];

/**
 * Writes a mesh as a file: what `fillHoles` and `readMesh` return, or the surface of `spanLoops`. PLY and STL are binary.
 *
 * OBJ and PLY keep positions exactly, the others in single precision. Attributes: OBJ and GLB have `color` (OBJ without alpha)
 * and `uv`; PLY has all of them, colours in 8 bits; STL has none.
 *
 * @throws SoapfilmError `bad-mesh` (`.face`), `not-finite` (`.vertex`), `bad-attributes`, `bad-option`
 */
export async function writeMesh(mesh: MeshInput, format: MeshFormat, options: WriteMeshOptions = {}): Promise<Uint8Array<ArrayBuffer>> {
  const { name = 'mesh' } = optionsOf<WriteMeshOptions>(options, { name: true });
  if (typeof name !== 'string') throw mustBe('bad-option', 'name', 'a string', name);
  // Left out, it would be the first.
  const chosen = choiceOf('format', kFormats, (format as unknown) ?? null);
  const checked = checkedMesh(mesh);
  switch (chosen) {
    case 'obj':
      return writeObj(checked, name);
    case 'ply':
      return writePly(checked);
    case 'stl':
      return writeStl(checked);
    case 'glb':
      return (await import('./glb.js')).writeGlb(checked, name);
  }
}

/** The sizes that attributes of a known meaning have. */
const kSizes: Readonly<Record<string, readonly number[]>> = { [kColor]: [3, 4], [kUv]: [2] };

/** The mesh, whose arrays may be the caller's. */
function checkedMesh(mesh: MeshInput): MeshLike {
  const { positions: points, faces, single, attributes = {} } = flattenMesh(mesh, false);
  const wrong = points.findIndex((x) => !Number.isFinite(x));
  if (wrong >= 0) throw new SoapfilmError('not-finite', '`mesh.positions` has a number that is not finite', { vertex: Math.floor(wrong / 3) });
  const outside = faces.findIndex((vertex) => 3 * vertex >= points.length);
  if (outside >= 0) {
    const face = Math.floor(outside / 3);
    throw new SoapfilmError('bad-mesh', `Face ${face} of \`mesh\` has the vertex ${faces[outside]}, and there are only ${points.length / 3}`, { face });
  }
  if (faces.length === 0) throw new SoapfilmError('bad-mesh', '`mesh` has no faces');
  for (const [name, sizes] of Object.entries(kSizes)) {
    if (!Object.hasOwn(attributes, name) || sizes.includes(attributes[name].size)) continue;
    throw new SoapfilmError('bad-attributes', `\`mesh.attributes.${name}\` must have ${sizes.join(' or ')} numbers for each vertex`);
  }
  return { positions: single ? new Float32Array(points) : points, faces, attributes };
}

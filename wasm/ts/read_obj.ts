// Meshes in OBJ. A reader of its own: those of three and of loaders.gl, which stems from it, give every face vertices of
// its own, which opens all edges, and none says in which line a file is broken.
import { ByteScanner } from './byte_scanner.js';
import { FaceBuilder } from './concave.js';
import { Growing } from './growing.js';
import { badFile, kColor, kSeamWarning, kUv, meshFile, scaleColors, type MeshFile, type ReadMeshOptions } from './mesh_file.js';
import type { MeshAttribute } from './types.js';

const [kF, kT, kV, kSlash] = [102, 116, 118, 47];

/** @throws SoapfilmError `bad-file` */
export function readObj(bytes: Uint8Array, seams: ReadMeshOptions['seams']): MeshFile {
  const scan = new ByteScanner(bytes, true);
  const positions = new Growing(new Float64Array(3072));
  const colors = new Colors();
  const textures = new Textures(seams === 'split');
  const faces = new Growing(new Uint32Array(3072));
  const builder = new FaceBuilder(faces);
  /** Faces may come before their vertices: the largest number so far, and its line. */
  let [most, mostLine] = [0, 0];
  const others = new Set<string>();
  do {
    if (!scan.toWord()) continue;
    if (scan.peek() === kV) {
      if (scan.isWordEnd(1)) {
        scan.at++;
        for (let axis = 0; axis < 3; axis++) positions.push(scan.number('the vertex'));
        colors.read(scan);
      } else if (scan.peek(1) === kT && scan.isWordEnd(2)) {
        scan.at += 2;
        textures.read(scan);
      }
    } else if (scan.peek() === kF && scan.isWordEnd(1)) {
      scan.at++;
      while (scan.toWord()) {
        const from = scan.at;
        const vertex = absolute(scan.integer(), positions.length / 3);
        let isWhole = vertex > 0;
        let texture = 0;
        if (scan.peek() === kSlash) {
          scan.at++;
          if (scan.peek() !== kSlash && !scan.isWordEnd()) {
            texture = absolute(scan.integer(), textures.count);
            isWhole &&= texture > 0;
          }
          // Normals are of no use.
          if (scan.peek() === kSlash) while (!scan.isWordEnd()) scan.at++;
        }
        if (!isWhole || !scan.isWordEnd()) throw badFile(`“${scan.wordAt(from)}” names no vertex`, { line: scan.line });
        if (vertex > most) [most, mostLine] = [vertex, scan.line];
        builder.add(textures.vertexFor(vertex - 1, texture));
      }
      if (builder.end() < 3) throw badFile('a face has fewer than three vertices', { line: scan.line });
    } else others.add(scan.word());
  } while (scan.nextLine());
  const n = positions.length / 3;
  if (most > n) throw badFile(`there is no vertex ${most}`, { line: mostLine });
  if (faces.length === 0) throw badFile('the file has no faces');
  const more = textures.extra.length;
  const mesh = { positions: positions.taken(), faces: faces.taken() };
  if (more > 0) {
    mesh.positions = withCopies(mesh.positions, 3, textures.extra);
    for (let i = 0; i < mesh.faces.length; i++) if (mesh.faces[i] >= kExtra) mesh.faces[i] += n - kExtra;
  }
  builder.cut(mesh.faces, mesh.positions);
  const warnings = [
    ...(others.has('usemtl') ? ['Materials are left out'] : []),
    ...(others.has('l') || others.has('p') ? ['Lines and points are left out'] : []),
    ...(['curv', 'curv2', 'surf'].some((name) => others.has(name)) ? ['Curved surfaces are left out'] : []),
  ];
  return meshFile('obj', mesh, [...colors.taken(n, textures.extra, warnings), ...textures.taken(mesh.faces, n, warnings)], warnings);
}

/** Vertices that are there once more, for another texture, are numbered from here on until all others are known. */
const kExtra = 2 ** 31;

/** Numbers of vertices, and of some of them once more at the end. */
function withCopies<T extends Float32Array | Float64Array>(data: T, size: number, vertices: readonly number[]): T {
  const all = new (data.constructor as new (length: number) => T)(data.length + size * vertices.length);
  all.set(data);
  vertices.forEach((vertex, i) => { all.set(data.subarray(size * vertex, size * (vertex + 1)), data.length + size * i); });
  return all;
}

/** Numbers count from 1, and negative ones backwards from the last one so far; 0 or less where there is none such. */
const absolute = (number: number, count: number): number => (number < 0 ? count + 1 + number : number);

type Attributes = readonly (readonly [name: string, attribute: MeshAttribute])[];

/** Colours after the coordinates: red, green, blue, and perhaps alpha. One number alone is a weight. */
class Colors {
  private readonly data = new Growing(new Float32Array(4));
  private vertices = 0;
  private coloured = 0;
  private hasAlpha = false;

  read(scan: ByteScanner): void {
    this.vertices++;
    if (!scan.toWord()) return;
    const numbers: number[] = [];
    while (scan.toWord()) numbers.push(scan.number('the vertex'));
    if (numbers.length !== 3 && numbers.length !== 4) return;
    this.coloured++;
    if (numbers.length === 4) this.hasAlpha = true;
    for (let k = 0; k < 4; k++) this.data.push(numbers[k] ?? 1);
  }

  taken(n: number, extra: readonly number[], warnings: string[]): Attributes {
    if (this.coloured === 0) return [];
    if (this.coloured < n) {
      warnings.push('Only some vertices have a colour: colours are left out');
      return [];
    }
    const all = this.data.taken();
    const size = this.hasAlpha ? 4 : 3;
    const color = { data: withCopies(this.hasAlpha ? all : all.filter((_, i) => i % 4 < 3), size, extra), size };
    scaleColors(color);
    return [[kColor, color]];
  }
}

/** Texture coordinates, which faces give their corners. A vertex can have only one, and is split where that is asked for. */
class Textures {
  /** The vertices that are there once more, from number `kExtra` on. */
  readonly extra: number[] = [];
  private readonly data = new Growing(new Float32Array(2048));
  /** By vertex, its texture coordinates, from 1; 0: none so far. */
  private of = new Uint32Array(1024);
  private readonly extraTextures: number[] = [];
  /** By vertex and texture, `extra`. */
  private readonly extraAt = new Map<number, number>();
  private isTorn = false;

  constructor(private readonly doSplit: boolean) {}

  get count(): number {
    return this.data.length / 2;
  }

  read(scan: ByteScanner): void {
    this.data.push(scan.number('the texture coordinates'));
    this.data.push(scan.toWord() ? scan.number('the texture coordinates') : 0);
  }

  /** The vertex for a corner with a texture; 0: without. */
  vertexFor(vertex: number, texture: number): number {
    // So large a number is an error, which is told once all vertices are known.
    if (texture === 0 || this.isTorn || vertex > 2 ** 28 || texture > 2 ** 24) return vertex;
    if (vertex >= this.of.length) {
      const larger = new Uint32Array(Math.max(2 * this.of.length, vertex + 1));
      larger.set(this.of);
      this.of = larger;
    }
    const known = this.of[vertex];
    if (known === 0) this.of[vertex] = texture;
    else if (known !== texture && !this.isSame(known, texture)) {
      if (this.doSplit) return this.extraFor(vertex, texture);
      this.isTorn = true;
    }
    return vertex;
  }

  taken(faces: Uint32Array, n: number, warnings: string[]): Attributes {
    if (this.isTorn) {
      warnings.push(kSeamWarning);
      return [];
    }
    const all = new Uint32Array(n + this.extra.length);
    all.set(this.of.subarray(0, n));
    all.set(this.extraTextures, n);
    if (all.every((texture) => texture === 0)) return [];
    if (all.some((texture) => texture > this.count) || faces.some((vertex) => all[vertex] === 0)) {
      warnings.push('Only some vertices have texture coordinates: these are left out');
      return [];
    }
    const data = new Float32Array(2 * all.length);
    all.forEach((texture, v) => {
      for (let k = 0; k < 2 && texture > 0; k++) data[2 * v + k] = this.data.at(2 * (texture - 1) + k);
    });
    return [[kUv, { data, size: 2 }]];
  }

  private extraFor(vertex: number, texture: number): number {
    const key = 2 ** 24 * vertex + texture;
    const known = this.extraAt.get(key);
    if (known !== undefined) return known;
    const made = kExtra + this.extra.length;
    this.extra.push(vertex);
    this.extraTextures.push(texture);
    this.extraAt.set(key, made);
    return made;
  }

  private isSame(a: number, b: number): boolean {
    return [-2, -1].every((k) => this.data.at(2 * a + k) === this.data.at(2 * b + k));
  }
}

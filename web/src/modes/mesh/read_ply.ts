// Meshes in PLY: text, or binary with either order of bytes. A reader of its own: three's PLYLoader drops polygons of
// more than four vertices, and does not say where a file is broken.
import type { MeshShape } from './settings.ts';
import { bad, Growing, Scanner } from './scanner.ts';

type Scalar = 'int8' | 'uint8' | 'int16' | 'uint16' | 'int32' | 'uint32' | 'float32' | 'float64';

const kScalars: Partial<Record<string, Scalar>> = {
  char: 'int8', uchar: 'uint8', short: 'int16', ushort: 'uint16', int: 'int32', uint: 'uint32', float: 'float32', double: 'float64',
  int8: 'int8', uint8: 'uint8', int16: 'int16', uint16: 'uint16', int32: 'int32', uint32: 'uint32', float32: 'float32', float64: 'float64',
};

const kFormats: Partial<Record<string, 'ascii' | 'little' | 'big'>> = {
  ascii: 'ascii',
  binary_little_endian: 'little',
  binary_big_endian: 'big',
};

interface Property {
  readonly name: string;
  readonly type: Scalar;
  /** Of lists, the type of their length. */
  readonly countType: Scalar | null;
}

interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: Property[];
}

/** Values one after the other. */
interface Source {
  next(type: Scalar): number;
  where(): number | undefined;
}

/** @throws SoapfilmError `bad-file` */
export function readPly(bytes: Uint8Array): MeshShape {
  const { format, elements, length, lines } = readHeader(bytes);
  const source =
    format === 'ascii' ? textSource(new TextDecoder().decode(bytes.subarray(length)), lines + 1) : binarySource(bytes, length, format === 'little');
  let positions = new Float32Array();
  const faces = new Growing(new Uint32Array(3072));
  const strips: number[][] = [];
  for (const element of elements) {
    if (element.name === 'vertex') positions = readVertices(element, source);
    else readOthers(element, source, faces, strips);
  }
  if (positions.length === 0) throw bad('it has no vertices');
  for (const strip of strips) putStrip(strip, faces);
  if (faces.length === 0) throw bad('it has no faces');
  for (let i = 0; i < faces.length; i++) {
    if (3 * faces.at(i) >= positions.length) throw bad(`a face names the vertex ${faces.at(i)}, and there are only ${positions.length / 3}`);
  }
  return { positions, faces: faces.taken() };
}

function readHeader(bytes: Uint8Array) {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, 1 << 16));
  const end = /(^|[\r\n])end_header[ \t]*(\r\n|\n|\r)/.exec(text);
  if (end === null) throw bad('its header has no end');
  const length = end.index + end[0].length;
  const header = text.slice(0, length).split(/\r\n|\n|\r/).slice(0, -1);
  const elements: Element[] = [];
  const format = kFormats[/^format\s+(\S+)/m.exec(text)?.[1] ?? ''];
  if (!format) throw bad('its header names no known format');
  header.forEach((line, i) => {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === 'element') {
      const count = Number(rest[1]);
      if (!Number.isInteger(count) || count < 0) throw bad(`“${rest[1]}” is no number of elements`, i + 1);
      elements.push({ name: rest[0], count, properties: [] });
    } else if (word === 'property') {
      const types = (rest[0] === 'list' ? rest.slice(1, 3) : rest.slice(0, 1)).map((name) => kScalars[name]);
      const [first, second] = types;
      const element = elements.at(-1);
      if (!first || !element || types.includes(undefined)) throw bad('a property of no known type', i + 1);
      const name = rest[types.length === 2 ? 3 : 1];
      element.properties.push(second ? { name, type: second, countType: first } : { name, type: first, countType: null });
    }
  });
  return { format, elements, length, lines: header.length };
}

function readVertices({ count, properties }: Element, source: Source): Float32Array<ArrayBuffer> {
  const axes = properties.map(({ name, countType }) => (countType === null ? ['x', 'y', 'z'].indexOf(name) : -1));
  if (![0, 1, 2].every((axis) => axes.includes(axis))) throw bad('its vertices have no x, y and z');
  const positions = new Growing(new Float32Array(3072));
  const point = [0, 0, 0];
  for (let v = 0; v < count; v++) {
    properties.forEach((property, i) => {
      if (property.countType !== null) skipList(property, source);
      else {
        const value = source.next(property.type);
        if (axes[i] >= 0) point[axes[i]] = value;
      }
    });
    for (const x of point) {
      if (!Number.isFinite(Math.fround(x))) throw bad(`a coordinate of vertex ${v} is not a finite number`, source.where());
      positions.push(x);
    }
  }
  return positions.taken();
}

function skipList({ type, countType }: Property, source: Source): void {
  if (countType === null) return;
  for (let left = source.next(countType); left > 0; left--) source.next(type);
}

/** Faces, triangle strips, and what is of no use here. */
function readOthers({ name, count, properties }: Element, source: Source, faces: Growing<Uint32Array>, strips: number[][]): void {
  for (let e = 0; e < count; e++) {
    for (const property of properties) {
      const { name: of, type, countType } = property;
      if (countType === null) source.next(type);
      else if (name === 'face' && (of === 'vertex_indices' || of === 'vertex_index')) readFace(source, type, source.next(countType), e, faces);
      else if (name === 'tristrips') strips.push(Array.from({ length: source.next(countType) }, () => source.next(type)));
      else skipList(property, source);
    }
  }
}

function readFace(source: Source, type: Scalar, length: number, face: number, faces: Growing<Uint32Array>): void {
  let [first, before] = [0, 0];
  for (let i = 0; i < length; i++) {
    const vertex = source.next(type);
    if (!Number.isInteger(vertex) || vertex < 0) throw bad(`face ${face} names the vertex ${vertex}`, source.where());
    if (i === 0) first = vertex;
    if (i > 1) for (const each of [first, before, vertex]) faces.push(each);
    before = vertex;
  }
}

/** Every other triangle of a strip runs the other way round; −1 begins another. */
function putStrip(strip: readonly number[], faces: Growing<Uint32Array>): void {
  let from = 0;
  strip.forEach((vertex, i) => {
    if (vertex < 0) from = i + 1;
    if (i < from + 2) return;
    const [a, b] = (i - from) % 2 === 0 ? [strip[i - 2], strip[i - 1]] : [strip[i - 1], strip[i - 2]];
    if (a !== b && b !== vertex && a !== vertex) for (const each of [a, b, vertex]) faces.push(each);
  });
}

function textSource(text: string, line: number): Source {
  const scan = new Scanner(text, 0, line);
  return {
    next() {
      const word = scan.nextWord();
      if (word === '') throw bad('it ends too early', scan.line);
      const value = Number(word);
      if (Number.isNaN(value)) throw bad(`“${word.slice(0, 30)}” is not a number`, scan.line);
      return value;
    },
    where: () => scan.line,
  };
}

function binarySource(bytes: Uint8Array, from: number, isLittle: boolean): Source {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = from;
  const read: Record<Scalar, (at: number) => number> = {
    int8: (i) => view.getInt8(i),
    uint8: (i) => view.getUint8(i),
    int16: (i) => view.getInt16(i, isLittle),
    uint16: (i) => view.getUint16(i, isLittle),
    int32: (i) => view.getInt32(i, isLittle),
    uint32: (i) => view.getUint32(i, isLittle),
    float32: (i) => view.getFloat32(i, isLittle),
    float64: (i) => view.getFloat64(i, isLittle),
  };
  const size: Record<Scalar, number> = { int8: 1, uint8: 1, int16: 2, uint16: 2, int32: 4, uint32: 4, float32: 4, float64: 8 };
  return {
    next(type) {
      if (at + size[type] > bytes.length) throw bad('it ends too early');
      const value = read[type](at);
      at += size[type];
      return value;
    },
    where: () => undefined,
  };
}

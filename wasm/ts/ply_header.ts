// The header of PLY: which elements there are, and what each of them has.
import { badFile } from './mesh_file.js';

export type Scalar = 'int8' | 'uint8' | 'int16' | 'uint16' | 'int32' | 'uint32' | 'float32' | 'float64';

const kScalars: Readonly<Partial<Record<string, Scalar>>> = {
  char: 'int8', uchar: 'uint8', short: 'int16', ushort: 'uint16', int: 'int32', uint: 'uint32', float: 'float32', double: 'float64',
  int8: 'int8', uint8: 'uint8', int16: 'int16', uint16: 'uint16', int32: 'int32', uint32: 'uint32', float32: 'float32', float64: 'float64',
};

export const kSizes: Readonly<Record<Scalar, number>> = { int8: 1, uint8: 1, int16: 2, uint16: 2, int32: 4, uint32: 4, float32: 4, float64: 8 };

const kFormats: Readonly<Partial<Record<string, PlyHeader['format']>>> = { ascii: 'ascii', binary_little_endian: 'little', binary_big_endian: 'big' };

export interface Property {
  readonly name: string;
  readonly type: Scalar;
  /** Of lists, the type of their length. */
  readonly countType: Scalar | null;
}

export interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: readonly Property[];
}

export interface PlyHeader {
  readonly format: 'ascii' | 'little' | 'big';
  readonly elements: readonly Element[];
  /** How many bytes and lines it has. */
  readonly length: number;
  readonly lines: number;
}

/** @throws SoapfilmError `bad-file` */
export function readPlyHeader(bytes: Uint8Array): PlyHeader {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, 1 << 16));
  const end = /(^|[\r\n])end_header[ \t]*(\r\n|\n|\r)/.exec(text);
  if (end === null) throw badFile('the header of the file has no end');
  const length = end.index + end[0].length;
  const lines = text.slice(0, length).split(/\r\n|\n|\r/).slice(0, -1);
  const elements: (Element & { readonly properties: Property[] })[] = [];
  let format: PlyHeader['format'] | undefined;
  lines.forEach((each, i) => {
    const line = i + 1;
    const [word, ...rest] = each.trim().split(/\s+/);
    if (word === 'format') {
      format = kFormats[rest[0]];
    } else if (word === 'element') {
      const count = /^\d+$/.test(rest[1]) ? Number(rest[1]) : NaN;
      if (!(count < 2 ** 32)) throw badFile(`“${rest[1] ?? ''}” is no number of elements`, { line });
      elements.push({ name: rest[0], count, properties: [] });
    } else if (word === 'property') {
      const types = (rest[0] === 'list' ? rest.slice(1, 3) : rest.slice(0, 1)).map((name) => kScalars[name]);
      const [first, second] = types;
      const element = elements.at(-1);
      const name = rest.at(rest[0] === 'list' ? 3 : 1);
      if (!first || !element || types.includes(undefined) || name === undefined) throw badFile('a property of no known type', { line });
      element.properties.push(second ? { name, type: second, countType: first } : { name, type: first, countType: null });
    }
  });
  if (!format) throw badFile('the header of the file names no known format');
  return { format, elements, length, lines: lines.length };
}

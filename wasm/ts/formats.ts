// Loops and surfaces as text: `.curve`, JSON and OBJ.
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';
import { jsonLine } from './jsonline.js';
import {
  arrayOf,
  choiceOf,
  fieldsOf,
  guarded,
  mustBe,
  optionsOf,
  show,
  viewOf,
} from './check.js';
import { flatPositions, flatStarts, flattenLoops } from './flatten.js';
import type { LoopSet, LoopsLike, Span } from './types.js';

/**
 * - `curve`: the number of loops, the number of all vertices, then for each loop its number of
 *   vertices, and a line `x y z` for each vertex; `#` begins a comment.
 * - `json`: `{ "name": …, "loops": [[[x, y, z], …], …] }`, or the array of loops alone.
 * - `obj`: Wavefront, `v` and closed polylines `l`; all else is ignored.
 */
export type LoopFormat = 'curve' | 'json' | 'obj';

/** Loops read from a file, with their name if the file has one. */
export interface LoopFile extends LoopSet {
  readonly name?: string;
}

/**
 * Reads the loops in a file; coordinates are exact to the last bit.
 *
 * In OBJ, polylines are joined where they share an index, whatever their directions. A loop begins
 * with its first segment in the file, and runs in the direction of that segment.
 *
 * @param data text, or bytes in UTF-8
 * @param options `format`; by default it is recognised from the content
 * @throws SoapfilmError `bad-option`; `bad-file`, with `.line`, and with `.loop` and `.vertex` where they
 *   apply, for text that is not in the format, a coordinate that is not finite, an open polyline, a loop of
 *   fewer than 3 vertices, and a file without loops
 */
export function parseLoops(
  data: string | ArrayBuffer | Uint8Array,
  options: { readonly format?: LoopFormat } = {},
): LoopFile {
  const { format } = optionsOf(options, { format: true });
  const text = guarded('bad-file', 'data', () => textOf(data)).replace(/^\ufeff/, '');
  if (text.includes('\0')) fail('This is not a text file');
  const parsers = { curve: parseCurve, json: parseJson, obj: parseObj };
  return parsers[format === undefined ? recognise(text) : choiceOf('format', kFormats, format)](text);
}

const kFormats: readonly LoopFormat[] = ['curve', 'json', 'obj'];

function textOf(data: unknown): string {
  if (typeof data === 'string') return data;
  const isBuffer = Object.prototype.toString.call(data) === '[object ArrayBuffer]';
  // A copy of views, since decoders refuse shared memory.
  const bytes = isBuffer ? new Uint8Array(data as ArrayBuffer) : viewOf(['Uint8Array'], data)?.slice();
  if (!bytes) throw mustBe('bad-file', 'data', 'text, an ArrayBuffer or a Uint8Array', data);
  return new TextDecoder().decode(bytes);
}

/**
 * Writes loops as a file that `parseLoops` reads back exactly. A `name` that comes with the loops is kept,
 * except in `.curve`, which has no place for it.
 *
 * @throws SoapfilmError `bad-loops`, `bad-starts`, `not-finite` (`.loop`, `.vertex`), `bad-option`
 */
export function formatLoops(
  loops: LoopsLike | LoopFile,
  format: LoopFormat = 'curve',
): string {
  const chosen = choiceOf('format', kFormats, format);
  const { positions, starts } = flattenLoops(loops);
  const name = nameOf(loops);
  const written = Array.from(starts.subarray(1), (end, loop) =>
    Array.from({ length: end - starts[loop] }, (_, vertex) =>
      point(positions, starts[loop] + vertex, { loop, vertex }),
    ),
  );
  switch (chosen) {
    case 'curve': {
      const lines = written.flatMap((points) => [
        String(points.length),
        ...points.map((xyz) => xyz.join(' ')),
      ]);
      return [written.length, positions.length / 3, ...lines, ''].join('\n');
    }
    case 'json': {
      const head = name === undefined ? '' : `"name": ${JSON.stringify(name)},\n  `;
      const items = written.map((points) => points.map((xyz) => `[${xyz.join(', ')}]`).join(',\n      '));
      const body = items.map((item) => `    [${item === '' ? '' : `\n      ${item}\n    `}]`).join(',\n');
      return `{\n  ${head}"loops": [\n${body}\n  ]\n}\n`;
    }
    case 'obj': {
      const lines = written.map((_, loop) => {
        const first = starts[loop] + 1;
        return `l ${written[loop].map((_, i) => first + i).join(' ')} ${first}`;
      });
      const vertices = written.flatMap((points) => points.map((xyz) => `v ${xyz.join(' ')}`));
      return [...objHead(name), ...vertices, ...lines, ''].join('\n');
    }
  }
}

/** The name that comes with loops in flat arrays. */
function nameOf(loops: unknown): string | undefined {
  if (Array.isArray(loops)) return undefined;
  return textOption('bad-loops', 'loops.name', fieldsOf(loops, { name: true }, 'loops', 'bad-loops').name);
}

function textOption(code: ErrorCode, option: string, value: unknown): string | undefined {
  if (value === undefined || typeof value === 'string') return value;
  throw mustBe(code, option, 'a string', value);
}

/**
 * Writes a triangulated surface, such as a `Span`, as Wavefront OBJ. Its boundary loops, if given, are
 * written as closed polylines `l`, so that `parseLoops` reads them back.
 *
 * @param surface `positions` [3n] xyz; `triangles` [3m] vertex indices; `loopVertices` vertex
 *   indices of the boundary loops, `starts` [k + 1] offsets into them
 * @param options `name` of the object; `precision`: significant digits, 1 to 17, by default as many as
 *   are needed to read back the same numbers
 * @throws SoapfilmError `not-finite` (`.vertex`), `bad-starts`; `bad-option` for arrays of the wrong kind,
 *   indices that no vertex has, and options out of their range
 */
export function formatObj(
  surface: Surface,
  options: FormatObjOptions = {},
): string {
  const { name, precision } = optionsOf<FormatObjOptions>(options, { name: true, precision: true });
  const lines = objHead(textOption('bad-option', 'name', name));
  if (precision !== undefined && !isPrecision(precision)) {
    throw mustBe('bad-option', 'precision', 'a whole number from 1 to 17', precision);
  }
  const { positions, triangles, loopVertices, starts } = surfaceOf(surface);
  for (let vertex = 0; vertex < positions.length / 3; vertex++) {
    lines.push(`v ${point(positions, vertex, { vertex }, precision).join(' ')}`);
  }
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    lines.push(`f ${triangles[i] + 1} ${triangles[i + 1] + 1} ${triangles[i + 2] + 1}`);
  }
  if (loopVertices && starts) {
    starts.subarray(1).forEach((end, loop) => {
      if (end === starts[loop]) return;
      const closed = [...loopVertices.subarray(starts[loop], end), loopVertices[starts[loop]]];
      lines.push(`l ${closed.map((vertex) => vertex + 1).join(' ')}`);
    });
  }
  return [...lines, ''].join('\n');
}

type Surface = Pick<Span, 'positions' | 'triangles'> & Partial<Pick<Span, 'loopVertices' | 'starts'>>;

export interface FormatObjOptions {
  readonly name?: string;
  readonly precision?: number;
}

const isPrecision = (value: unknown): value is number =>
  typeof value === 'number' && Number.isInteger(value) && value >= 1 && value <= 17;

/** A surface whose arrays are of the right kind and fit each other. */
function surfaceOf(surface: unknown): Surface {
  const code = 'bad-option';
  const given = fieldsOf<Required<Surface>>(
    surface,
    { positions: true, triangles: true, loopVertices: true, starts: true },
    'surface',
    code,
  );
  const positions = flatPositions(given.positions, 3, false, code, 'surface.positions');
  const indices = (name: 'triangles' | 'loopVertices', what: string, size: number): Uint32Array => {
    const path = `surface.${name}`;
    const fits = (length: number): boolean => length % size === 0;
    const array = arrayOf('Uint32Array', given[name], false, code, path, what, fits);
    const at = array.findIndex((vertex) => vertex >= positions.length / 3);
    if (at < 0) return array;
    throw mustBe(code, `${path}[${at}]`, 'the index of a vertex', array[at]);
  };
  const triangles = indices('triangles', 'three indices for each triangle', 3);
  if (given.loopVertices === undefined || given.starts === undefined) return { positions, triangles };
  const loopVertices = indices('loopVertices', 'indices of vertices', 1);
  const starts = flatStarts(given.starts, loopVertices.length, code, 'surface.starts');
  return { positions, triangles, loopVertices, starts };
}

const objHead = (name: string | undefined): string[] =>
  name === undefined ? [] : [`o ${name.replace(/\s+/g, ' ').trim()}`];

/** The coordinates of a vertex in the fewest digits that read back the same, or in `precision` digits. */
function point(
  positions: Float64Array,
  index: number,
  place: ErrorPlace,
  precision?: number,
): string[] {
  return Array.from(positions.subarray(3 * index, 3 * index + 3), (value) => {
    if (!Number.isFinite(value)) {
      const where = place.loop === undefined ? 'Vertex' : `Loop ${place.loop}, vertex`;
      const text = `${where} ${place.vertex ?? 0} has a coordinate that is NaN or infinite`;
      throw new SoapfilmError('not-finite', text, place);
    }
    if (Object.is(value, -0)) return '-0';
    return String(precision === undefined ? value : Number(value.toPrecision(precision)));
  });
}

function fail(message: string, place: ErrorPlace = {}): never {
  const line = place.line === undefined ? '' : `Line ${place.line}: `;
  throw new SoapfilmError('bad-file', line + message, place);
}

function coordinate(word: string, place: ErrorPlace): number {
  const value = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(word) ? Number(word) : NaN;
  return Number.isFinite(value) ? value : fail(`${show(word)} is not a finite number`, place);
}

function recognise(text: string): LoopFormat {
  const first = /^[ \t]*([^\s#])/m.exec(text)?.[1] ?? '';
  if (first === '{' || first === '[') return 'json';
  return /[-+.\d]/.test(first) ? 'curve' : 'obj';
}

/** The words of each line that has any, without `#` comments. */
function* wordsByLine(text: string): Generator<{ line: number; words: string[] }> {
  const lines = text.split(/\r\n?|\n/);
  for (let i = 0; i < lines.length; i++) {
    const line = i + 1;
    let joined = lines[i];
    while (joined.endsWith('\\') && i + 1 < lines.length) joined = joined.slice(0, -1) + lines[++i];
    const words = joined.replace(/#.*/, '').trim().split(/\s+/);
    if (words[0] !== '') yield { line, words };
  }
}

function parseCurve(text: string): LoopSet {
  const lines = wordsByLine(text);
  let line = 1;
  let words: string[] = [];
  let used = 0;
  const next = (what: string, place: ErrorPlace = {}): string => {
    if (used === words.length) {
      const more = lines.next();
      if (more.done) return fail(`The file ends where ${what} should be`, { ...place, line });
      ({ line, words } = more.value);
      used = 0;
    }
    return words[used++];
  };
  const count = (what: string, place: ErrorPlace = {}): number => {
    const word = next(what, place);
    return /^\d{1,10}$/.test(word)
      ? Number(word)
      : fail(`${show(word)} is not ${what}`, { ...place, line });
  };
  const loopCount = count('the number of loops');
  if (loopCount === 0) fail('The file holds no loops', { line });
  const total = count('the number of all vertices');
  const totalLine = line;
  const coordinates: number[] = [];
  const starts = [0];
  for (let loop = 0; loop < loopCount; loop++) {
    const length = count(`the number of vertices of loop ${loop}`, { loop });
    if (length < 3) fail(`Loop ${loop} needs at least 3 vertices, not ${length}`, { line, loop });
    if (starts[loop] + length > total) {
      fail(`There are more vertices than the ${total} of line ${totalLine}`, { line, loop });
    }
    for (let i = 0; i < 3 * length; i++) {
      const vertex = Math.floor(i / 3);
      const word = next(`vertex ${vertex} of loop ${loop}`, { loop, vertex });
      coordinates.push(coordinate(word, { line, loop, vertex }));
    }
    starts.push(starts[loop] + length);
  }
  if (starts[loopCount] !== total) {
    fail(`The loops have ${starts[loopCount]} vertices, not ${total}`, { line: totalLine });
  }
  if (used < words.length) fail(`${show(words[used])} follows after the last vertex`, { line });
  const rest = lines.next();
  if (!rest.done) {
    const [word] = rest.value.words;
    fail(`${show(word)} follows after the last vertex`, { line: rest.value.line });
  }
  return { positions: new Float64Array(coordinates), starts: new Uint32Array(starts) };
}

function parseJson(text: string): LoopFile {
  const failAt = (message: string, path?: readonly (string | number)[], place?: ErrorPlace): never => {
    const line = jsonLine(text, path);
    return fail(message, { ...place, ...(line !== undefined && { line }) });
  };
  let content: unknown;
  try {
    content = JSON.parse(text);
  } catch {
    return failAt('This is not JSON');
  }
  const bare = Array.isArray(content);
  const file = bare ? { loops: content } : (content as { loops?: unknown; name?: unknown } | null);
  const path = bare ? [] : ['loops'];
  const loops = file?.loops;
  if (!Array.isArray(loops)) return failAt('There is no array `loops`', []);
  if (loops.length === 0) return failAt('The file holds no loops', path);
  const coordinates: number[] = [];
  const starts = [0];
  loops.forEach((points: unknown, loop) => {
    if (!Array.isArray(points)) {
      return failAt(`Loop ${loop} is not an array of points`, [...path, loop], { loop });
    }
    if (points.length < 3) {
      const message = `Loop ${loop} needs at least 3 vertices, not ${points.length}`;
      return failAt(message, [...path, loop], { loop });
    }
    points.forEach((xyz: unknown, vertex) => {
      if (!Array.isArray(xyz) || xyz.length !== 3 || !xyz.every(Number.isFinite)) {
        const message = `Loop ${loop}, vertex ${vertex} is not an array of three finite numbers`;
        return failAt(message, [...path, loop, vertex], { loop, vertex });
      }
      coordinates.push(...(xyz as number[]));
    });
    starts.push(coordinates.length / 3);
  });
  return {
    positions: new Float64Array(coordinates),
    starts: new Uint32Array(starts),
    ...(typeof file?.name === 'string' && { name: file.name }),
  };
}

/** A piece of a polyline between two vertices, and its line in the file. */
interface Segment {
  readonly from: number;
  readonly to: number;
  readonly line: number;
}

function parseObj(text: string): LoopFile {
  const coordinates: number[] = [];
  const segments: Segment[] = [];
  let name: string | undefined;
  for (const { line, words } of wordsByLine(text)) {
    const [keyword, ...values] = words;
    if (keyword === 'v') {
      if (values.length < 3) fail('A vertex needs three coordinates', { line });
      for (const word of values.slice(0, 3)) coordinates.push(coordinate(word, { line }));
    } else if (keyword === 'l') {
      if (values.length < 2) fail('A line needs at least two vertices', { line });
      const indices = values.map((word) => objIndex(word, coordinates.length / 3, line));
      for (let i = 1; i < indices.length; i++) {
        segments.push({ from: indices[i - 1], to: indices[i], line });
      }
    } else if (keyword === 'o') {
      name ??= values.join(' ');
    }
  }
  if (segments.length === 0) fail('The file holds no loops: no lines (`l`)');
  const loops = joinSegments(segments, coordinates.length / 3);
  const starts = [0];
  for (const loop of loops) starts.push(starts[starts.length - 1] + loop.length);
  const positions = loops.flatMap((loop) =>
    loop.flatMap((vertex) => coordinates.slice(3 * vertex, 3 * vertex + 3)),
  );
  return {
    positions: new Float64Array(positions),
    starts: new Uint32Array(starts),
    ...(name !== undefined && { name }),
  };
}

/** The index from 0 of an OBJ reference: `5`, `5/2`, or `-1` for the latest vertex. */
function objIndex(word: string, vertexCount: number, line: number): number {
  if (!/^-?\d{1,10}(\/\d*)?$/.test(word)) fail(`${show(word)} is not a vertex index`, { line });
  const index = Number.parseInt(word, 10);
  if (index === 0 || index < -vertexCount) fail(`There is no vertex ${index}`, { line });
  return index > 0 ? index - 1 : vertexCount + index;
}

/** The cycles that the segments form, each from its first segment in the file. */
function joinSegments(segments: readonly Segment[], vertexCount: number): number[][] {
  // [2 * vertexCount]: the two segments at each vertex, or -1.
  const at = new Int32Array(2 * vertexCount).fill(-1);
  segments.forEach(({ from, to, line }, i) => {
    if (from === to) fail(`The line runs from vertex ${from + 1} to itself`, { line });
    for (const vertex of [from, to]) {
      if (vertex >= vertexCount) fail(`There is no vertex ${vertex + 1}`, { line });
      const slot = [2 * vertex, 2 * vertex + 1].find((s) => at[s] < 0);
      if (slot === undefined) {
        return fail(`More than two segments meet in vertex ${vertex + 1}`, { line });
      }
      at[slot] = i;
    }
  });
  const done = new Uint8Array(segments.length);
  const loops: number[][] = [];
  segments.forEach((first, i) => {
    if (done[i]) return;
    const loop = [first.from];
    let vertex = first.to;
    for (let here = i; vertex !== first.from; ) {
      done[here] = 1;
      loop.push(vertex);
      const other = at[2 * vertex] === here ? at[2 * vertex + 1] : at[2 * vertex];
      if (other < 0) {
        const message = `The polyline is open: it ends in vertex ${vertex + 1}`;
        fail(message, { line: segments[here].line });
      }
      here = other;
      vertex = segments[here].from === vertex ? segments[here].to : segments[here].from;
      done[here] = 1;
    }
    if (loop.length < 3) {
      const message = `Loop ${loops.length} needs at least 3 vertices, not ${loop.length}`;
      fail(message, { line: first.line, loop: loops.length });
    }
    loops.push(loop);
  });
  return loops;
}

import {
  formatLoops,
  formatObj,
  parseLoops,
  SoapfilmError,
  type LoopFormat,
  type LoopSet,
} from 'soapfilm';
import { describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';

const kFormats: LoopFormat[] = ['curve', 'json', 'obj'];

/** mulberry32: small, seeded, the same everywhere. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

function randomLoops(next: () => number): LoopSet {
  const bits = new DataView(new ArrayBuffer(8));
  const coordinate = (): number => {
    bits.setUint32(0, next() * 2 ** 32);
    bits.setUint32(4, next() * 2 ** 32);
    const value = bits.getFloat64(0); // every exponent, subnormal numbers and -0 as well
    return next() < 0.1 ? -0 : Number.isFinite(value) ? value : next();
  };
  const starts = [0];
  for (let k = 1 + Math.floor(4 * next()); k > 0; k--) {
    starts.push(starts[starts.length - 1] + 3 + Math.floor(6 * next()));
  }
  const positions = Float64Array.from({ length: 3 * starts[starts.length - 1] }, coordinate);
  return { positions, starts: Uint32Array.from(starts) };
}

const kTriangle = '1\n3\n3\n0 0 0\n1 0 0\n0 1 0\n';
const kPoints = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\n';

describe('formatLoops and parseLoops', () => {
  test.each(kFormats)('%s: every finite coordinate comes back bit for bit (seed 1)', (format) => {
    const next = random(1);
    for (let i = 0; i < 300; i++) {
      const loops = randomLoops(next);
      const text = formatLoops(loops, format);
      const { positions, starts } = parseLoops(text); // also recognises the format
      expect(starts).toEqual(loops.starts);
      expect(new BigUint64Array(positions.buffer)).toEqual(
        new BigUint64Array(loops.positions.buffer),
      );
      expect(formatLoops({ positions, starts }, format)).toBe(text);
    }
  });

  test.each(['json', 'obj'] as const)('%s: keeps the name', (format) => {
    const loops = { ...parseLoops(kTriangle), name: 'two "rings"' };
    expect(parseLoops(formatLoops(loops, format)).name).toBe('two "rings"');
    expect(parseLoops(formatLoops(parseLoops(kTriangle), format))).not.toHaveProperty('name');
  });

  test.each(kFormats)('%s: bytes, a byte order mark, CRLF and blank lines are read alike', (format) => {
    const text = formatLoops([[[0, 0, 0], [1, 0, 0.25], [0, 1, 0]]], format);
    const loops = parseLoops(text);
    const odd = `\ufeff\r\n  ${text.replaceAll('\n', '\r\n\r\n  ')}\r\n`;
    expect(parseLoops(odd)).toEqual(loops);
    expect(parseLoops(new TextEncoder().encode(odd))).toEqual(loops);
    expect(parseLoops(new TextEncoder().encode(odd).buffer)).toEqual(loops);
    expect(parseLoops(text, { format })).toEqual(loops);
  });

  test('nested arrays: are written like flat ones', () => {
    const nested = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]] as const;
    expect(formatLoops(nested)).toBe(kTriangle);
    expect(parseLoops(kTriangle)).toEqual({
      positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
      starts: Uint32Array.of(0, 3),
    });
  });

  test('a coordinate that is not finite: not written, its place named', () => {
    const loops = parseLoops(kTriangle);
    loops.positions[7] = NaN;
    for (const format of kFormats) {
      expect(errorOf(() => formatLoops(loops, format))).toMatchObject({
        code: 'not-finite',
        loop: 0,
        vertex: 2,
      });
    }
  });

  test('an unknown format: bad-option', () => {
    const format = 'stl' as LoopFormat;
    expect(errorOf(() => parseLoops(kTriangle, { format })).code).toBe('bad-option');
    expect(errorOf(() => formatLoops(parseLoops(kTriangle), format)).code).toBe('bad-option');
  });
});

describe('.curve', () => {
  test('comments and free spacing: read', () => {
    expect(parseLoops('# a triangle\n1 3 3  0 0\t0 1 0 0 # two\n0 1 0')).toEqual(
      parseLoops(kTriangle),
    );
  });

  test.each([
    ['a word for a count', 'one\n3\n', { format: 'curve', line: 1 }],
    ['a fraction for a count', '1\n3.5\n', { line: 2 }],
    ['no loops', '0\n0\n', { line: 1 }],
    ['a loop of two', '1\n2\n2\n0 0 0\n1 0 0\n', { line: 3, loop: 0 }],
    ['NaN', '1\n3\n3\n0 0 0\n1 NaN 0\n0 1 0\n', { line: 5, loop: 0, vertex: 1 }],
    ['a number too large', '1\n3\n3\n0 0 0\n1 1e999 0\n0 1 0\n', { line: 5, loop: 0, vertex: 1 }],
    ['a hexadecimal number', '1\n3\n3\n0 0 0\n1 0x10 0\n0 1 0\n', { line: 5, loop: 0, vertex: 1 }],
    ['an early end', '1\n3\n3\n0 0 0\n1 0 0\n', { line: 5, loop: 0, vertex: 2 }],
    ['a loop that is missing', '2\n3\n3\n0 0 0\n1 0 0\n0 1 0\n', { line: 6, loop: 1 }],
    ['too many vertices in a loop', '1\n3\n4\n0 0 0\n1 0 0\n0 1 0\n2 2 2\n', { line: 3, loop: 0 }],
    ['a wrong total', '1\n4\n3\n0 0 0\n1 0 0\n0 1 0\n', { line: 2 }],
    ['more after the end', `${kTriangle}7 7 7\n`, { line: 7 }],
    ['more in the last line', `${kTriangle.trimEnd()} 7\n`, { line: 6 }],
    ['a huge loop count', '4294967295\n9\n3\n0 0 0\n1 0 0\n0 1 0\n', { line: 6, loop: 1 }],
    ['a huge vertex count', '1\n4294967295\n4294967295\n0 0 0\n', { line: 4, loop: 0, vertex: 1 }],
    ['a count beyond all bounds', '1\n99999999999999999999\n', { line: 2 }],
    ['a zero byte', '1\n3\n3\n0 0 0\0', { format: 'curve' }],
  ])('%s: bad-file, its place named', (_, text, { format, ...place }: Record<string, unknown>) => {
    const options = format === 'curve' ? { format: 'curve' as const } : {};
    const error = errorOf(() => parseLoops(text, options));
    expect(error).toMatchObject({ code: 'bad-file', ...place });
    if ('line' in place) expect(error.message).toContain(`Line ${String(place.line)}: `);
  });
});

describe('JSON', () => {
  test('an array of loops alone: read', () => {
    expect(parseLoops('[[[0,0,0],[1,0,0],[0,1,0]]]')).toEqual(parseLoops(kTriangle));
  });

  test.each([
    ['nothing', '', { line: 1 }],
    ['an early end', '{\n"loops": [\n[[0,0,0],\n', { line: 4 }],
    ['a word', '{\n"loops":\n oops}', { line: 3 }],
    ['NaN', '{"loops": [\n[[0,0,NaN],[1,0,0],[0,1,0]]]}', { line: 2 }],
    ['a comma missing', '[[\n[0,0,0]\n[1,0,0]]]', { line: 3 }],
    ['a comma too many', '[[[0,0,0],\n[1,0,0],[0,1,0],\n]]', { line: 3 }],
    ['a string without end', '{\n"loops: []}', { line: 2 }],
    ['more after the end', '{"loops":[]}\n\nx', { line: 3 }],
    ['a wrong bracket', '[[[0,0,0}\n]]', { line: 1 }],
    ['a leading zero', '[[[\n01,0,0]]]', { line: 2 }],
    ['null', 'null', { line: 1 }],
    ['no loops member', '\n{"curves": []}', { line: 2 }],
    ['no loops', '{\n"loops":\n[]}', { line: 3 }],
    ['a loop that is no array', '{"loops": [\n[[0,0,0],[1,0,0],[0,1,0]],\n7]}', { line: 3, loop: 1 }],
    ['a loop of two', '[\n[[0,0,0],[1,0,0]]]', { line: 2, loop: 0 }],
    ['a point of two', '[[[0,0,0],\n[1,0],[0,1,0]]]', { line: 2, loop: 0, vertex: 1 }],
    ['a string for a number', '[[[0,0,0],[1,0,0],\n[0,"1",0]]]', { line: 2, loop: 0, vertex: 2 }],
    ['a number too large', '[[\n[0,0,0],[1,0,0],\n[0,1e999,0]]]', { line: 3, loop: 0, vertex: 2 }],
  ])('%s: bad-file, its place named', (_, text, place) => {
    const error = errorOf(() => parseLoops(text, { format: 'json' }));
    expect(error).toMatchObject({ code: 'bad-file', ...place });
  });

  test('a hundred thousand brackets: bad-file, not a crash', () => {
    expect(errorOf(() => parseLoops('['.repeat(100_000))).code).toBe('bad-file');
  });

  test.each([
    ['a long string', `"${'a'.repeat(5e6)}"`, 2],
    ['a long string of escapes', `"${'\\"'.repeat(5e6)}"`, 2],
    ['a long string without end', `"${'\\n'.repeat(5e6)}`, 1],
    ['an unknown escape', '"\\x"', 1],
    ['a line break in a string', '"a\nb"', 1],
  ])('%s: the line is still found', (_, string, line) => {
    const error = errorOf(() => parseLoops(`{"name": ${string},\n"loops": 1, oops}`));
    expect(error).toMatchObject({ code: 'bad-file', line });
  });

  test('texts changed at random: the line found is that of the change (seed 2)', () => {
    const next = random(2);
    const text = formatLoops(randomLoops(next), 'json');
    for (let i = 0; i < 500; i++) {
      const at = Math.floor(next() * text.length);
      const line = text.slice(0, at).split('\n').length;
      const changed = `${text.slice(0, at)}\u0007${text.slice(at)}`;
      const error = errorOf(() => parseLoops(changed, { format: 'json' }));
      expect(error).toMatchObject({ code: 'bad-file', line });
    }
  });
});

describe('OBJ', () => {
  const square = [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]] as const;
  test.each([
    ['a polyline that ends where it begins', 'l 1 2 3 4 1\n'],
    ['two chains', 'l 1 2 3\nl 3 4 1\n'],
    ['chains of either direction', 'l 1 2 3\nl 1 4 3\n'],
    ['segments in any order', 'l 1 2\nl 3 4\nl 4 1\nl 2 3\n'],
    ['indices from the end', 'l -5 -4 -3 -2 -5\n'],
    ['indices with texture coordinates', 'vt 0 0\nl 1/1 2/1 3/1 4/1 1/1\n'],
    ['a line continued', 'l 1 2 3 \\\n4 1\n'],
    ['other statements', 'vn 0 0 1\ng x\nusemtl red\nf 1 2 3\nl 1 2 3 4 1 # closed\n'],
  ])('%s: one loop, along the first segment, unused vertices left out', (_, lines) => {
    expect(formatLoops(parseLoops(kPoints + lines))).toBe(formatLoops(square));
  });

  test('two loops: in the order of the file', () => {
    const text = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nl 5 6\nl 1 2 3 1\nl 6 4 5\n';
    const { positions, starts } = parseLoops(text);
    expect(starts).toEqual(Uint32Array.of(0, 3, 6));
    expect(Array.from(positions.subarray(0, 9))).toEqual([1, 0, 1, 0, 1, 1, 0, 0, 1]);
  });

  test.each([
    ['no lines', '', undefined],
    ['an open polyline', 'l 1 2 3\n', 6],
    ['an open chain', 'l 1 2 3\nl 3 4\n', 7],
    ['a lone segment', 'l 1 2 3 1\nl 4 5\n', 7],
    ['three lines in a vertex', 'l 1 2 3 1\nl 1 4 5 1\n', 7],
    ['a segment to itself', 'l 1 2 2 3 1\n', 6],
    ['the same segment twice', 'l 1 2\nl 2 1\n', 6],
    ['index 0', 'l 0 1 2 0\n', 6],
    ['an index out of range', 'l 1 2 6 1\n', 6],
    ['a negative index out of range', 'l 1 2 -6 1\n', 6],
    ['a huge index', 'l 1 2 9999999999 1\n', 6],
    ['a word for an index', 'l 1 2 x 1\n', 6],
    ['a single vertex', 'l 1\n', 6],
    ['a vertex of two coordinates', 'v 1 2\n', 6],
    ['an infinite coordinate', 'v 1 2 inf\n', 6],
  ])('%s: bad-file, its line named', (_, lines, line) => {
    const error = errorOf(() => parseLoops(kPoints + lines));
    expect(error.code).toBe('bad-file');
    expect(error.line).toBe(line);
  });
});

test('parseLoops: files spoilt at random are read or refused, nothing else (seed 3)', () => {
  const next = random(3);
  const pick = (text: string): string => text[Math.floor(next() * text.length)];
  let refused = 0;
  for (let i = 0; i < 3000; i++) {
    const format = kFormats[i % 3];
    let text = formatLoops(randomLoops(next), format);
    for (let edits = 1 + Math.floor(3 * next()); edits > 0; edits--) {
      const at = Math.floor(next() * text.length);
      const end = at + Math.floor(next() * next() * 40);
      text = text.slice(0, at) + (next() < 0.5 ? pick('0123456789-+.eE \n[]{},"lvf/#\\é') : '') + text.slice(end);
    }
    try {
      const { positions, starts } = parseLoops(text, next() < 0.5 ? { format } : {});
      expect(positions.every(Number.isFinite)).toBe(true);
      expect(positions.length).toBe(3 * starts[starts.length - 1]);
      starts.forEach((start, c) => {
        if (c > 0) expect(start - starts[c - 1]).toBeGreaterThanOrEqual(3);
      });
    } catch (error) {
      if (!(error instanceof SoapfilmError) || error.code !== 'bad-file') throw error;
      refused++;
    }
  }
  expect(refused).toBeGreaterThan(1000);
  expect(refused).toBeLessThan(3000);
});

describe('formatObj', () => {
  const surface = {
    positions: Float64Array.of(0, 0, 0, 1 / 3, 0, -0, 0, 1e-300, 2e20),
    triangles: Uint32Array.of(0, 1, 2),
  };

  test('a surface: vertices in full precision, faces from 1', () => {
    expect(formatObj(surface, { name: 'a\nfilm' })).toBe(
      'o a film\nv 0 0 0\nv 0.3333333333333333 0 -0\nv 0 1e-300 200000000000000000000\nf 1 2 3\n',
    );
  });

  test('a span: its loops, with an inserted vertex in its place, are read back', () => {
    const tent = {
      positions: Float64Array.of(0, 0, 0.1, 1, 0, 0, 1, 1, 0.1, 0, 1, 0, 5, 5, 5, 6, 5, 5, 5, 6, 5, 0.5, 0, 0.05),
      triangles: Uint32Array.of(0, 7, 3, 7, 1, 2, 7, 2, 3, 4, 5, 6),
      loopVertices: Uint32Array.of(0, 7, 1, 2, 3, 4, 5, 6),
      starts: Uint32Array.of(0, 5, 8),
    };
    const text = formatObj(tent, { name: 'tent' });
    expect(text).toContain('f 5 6 7\nl 1 8 2 3 4 1\nl 5 6 7 5\n');
    const loops = parseLoops(text);
    expect(loops.name).toBe('tent');
    expect(loops.starts).toEqual(tent.starts);
    expect(loops.positions).toEqual(
      Float64Array.from([...tent.loopVertices].flatMap((v) => [...tent.positions.subarray(3 * v, 3 * v + 3)])),
    );
  });

  test('precision: significant digits', () => {
    expect(formatObj(surface, { precision: 3 })).toContain('v 0.333 0 -0\n');
    for (const precision of [0, 18, 2.5, NaN]) {
      expect(errorOf(() => formatObj(surface, { precision })).code).toBe('bad-option');
    }
  });

  test('a coordinate that is not finite: its vertex named', () => {
    const positions = Float64Array.of(0, 0, 0, 0, 0, Infinity, 0, 0, 0);
    expect(errorOf(() => formatObj({ ...surface, positions }))).toMatchObject({
      code: 'not-finite',
      vertex: 1,
    });
  });
});

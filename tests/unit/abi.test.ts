// The C ABI in WebAssembly, where sizes have 32 bits: sums of counts do not begin again at 0.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { beforeAll, describe, expect, test } from 'vitest';

type Export = (...args: number[]) => number;

let memory: WebAssembly.Memory;
let core: Record<string, Export>;

async function start(name: string): Promise<void> {
  const file = createRequire(import.meta.url).resolve(`soapfilm/${name}.wasm`);
  const compiled = await WebAssembly.compile(await readFile(file));
  const imports: Record<string, Record<string, Export>> = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) {
    (imports[module] ??= {})[name] = () => 1;
  }
  const { exports } = await WebAssembly.instantiate(compiled, imports);
  memory = exports.memory as WebAssembly.Memory;
  core = exports as Record<string, Export>;
  core._initialize();
}

/** The address of a copy in the core. */
function copied(values: Float64Array | Uint32Array): number {
  const address = core.sf_alloc(values.byteLength + 8) >>> 0;
  new Uint8Array(memory.buffer, address).set(new Uint8Array(values.buffer));
  return address;
}

const kTooLarge = 11;
const kMost = 2 ** 32 - 1;

describe('polygons.wasm', () => {
  beforeAll(() => start('polygons'));

  test.each([
    [2 ** 29, 0],
    [1, 2 ** 29],
    [kMost, 1],
    [2 ** 31, 2 ** 31],
    [3, kMost],
  ])('%d vertices and %d more inside: too-large, before any is read', (n, points) => {
    const starts = copied(Uint32Array.of(0, n));
    const rings = copied(Uint32Array.of(0, 1));
    const out = copied(new Uint32Array(6));
    expect(core.sf_session_open(8, starts, 1, 8, points, 1e9, out, out + 16)).toBe(kTooLarge);
    // In the order of SF_POLYGON_SETTINGS.
    const settings = copied(Float64Array.of(2, 0, 0, 0, 0, 0, 0, 1e9));
    const status = core.sf_triangulate_polygons(8, starts, 1, rings, 1, 8, points, settings, out, out + 16);
    expect(status).toBe(kTooLarge);
  });
});

describe('loops.wasm', () => {
  beforeAll(() => start('loops'));

  test.each([
    [2 ** 30, 0, 0],
    [kMost, 0, 0],
    [3, 2 ** 30, 0],
    [3, kMost, 0],
    [3, 0, 2 ** 30],
    [3, 0, kMost],
  ])('%d vertices, %d candidates, %d triangles to start from: too-large', (n, candidates, begun) => {
    const positions = copied(Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0));
    const starts = copied(Uint32Array.of(0, n));
    const out = copied(new Uint32Array(6));
    // In the order of SF_SPAN_SETTINGS.
    const settings = copied(Float64Array.of(1, 0, 0, 0, 4, 1e9, 0));
    const list = candidates > 0 ? 8 : 0;
    const start = begun > 0 ? 8 : 0;
    const status = core.sf_span_loops(
      positions, starts, 1, 0, list, candidates, 0, start, begun, settings, out, out + 16,
    );
    expect(status).toBe(kTooLarge);
  });
});

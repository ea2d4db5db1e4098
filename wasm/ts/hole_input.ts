// Meshes and options of holes as callers give them, checked.
import { checkedAttributes } from './attributes.js';
import { amountOf, choiceOf, entriesOf, fieldsOf, flagOf, functionOf, guarded, isIndex, mustBe, optionsOf, viewOf, type Given } from './check.js';
import type { FlatMesh } from './compute_holes.js';
import { SoapfilmError } from './errors.js';
import { kHoleFillOptions, limitsOf } from './options.js';
import { weightsOf } from './span_input.js';
import type { FillOptions, HoleFillOptions, HoleOptions } from './types.js';

/**
 * The mesh as the core takes it, copied where it must be.
 * @param own whether arrays must be copies, not views of the caller's
 * @param argument its name, for messages; a `surface` has no attributes
 * @throws SoapfilmError `bad-mesh`, `bad-attributes`
 */
export function flattenMesh(mesh: unknown, own: boolean, argument: 'mesh' | 'surface' = 'mesh'): FlatMesh {
  const names = { positions: true, faces: true, triangles: true, attributes: true } as const;
  const { positions: points, faces, triangles, attributes: given } = fieldsOf<Record<keyof typeof names, unknown>>(mesh, names, argument, 'bad-mesh');
  const isTriples = (length: number): boolean => length % 3 === 0;
  const positions = guarded('bad-mesh', `${argument}.positions`, () => viewOf(['Float32Array', 'Float64Array'], points));
  if (!positions || !isTriples(positions.length)) {
    throw mustBe('bad-mesh', `${argument}.positions`, 'a Float64Array or Float32Array of three numbers for each vertex', points);
  }
  const name = faces === undefined && triangles !== undefined ? `${argument}.triangles` : `${argument}.faces`;
  const listed = faces ?? triangles;
  const corners = guarded('bad-mesh', name, () => viewOf(['Uint32Array'], listed));
  if (!corners || !isTriples(corners.length)) {
    throw mustBe('bad-mesh', name, 'a Uint32Array of three vertices for each face', listed);
  }
  const single = positions instanceof Float32Array;
  const attributes = argument === 'mesh' ? checkedAttributes(given, positions.length / 3, own) : undefined;
  return {
    positions: single || own ? Float64Array.from(positions) : positions,
    faces: own ? corners.slice() : corners,
    single,
    ...(attributes && { attributes }),
  };
}

/** Options of `fillHoles`, checked, without those that were left out. @throws SoapfilmError `bad-option`, `bad-weights` */
export function fillOptionsOf(given: Given<FillOptions>): FillOptions {
  const { holes, groups, perHole, fillOpenRims, maxVertices, maxLength, output, onProgress, maxSecondsPerHole } = given;
  const checked: { -readonly [K in keyof FillOptions]: unknown } = { ...openingOptionsOf(given), ...patchOptionsOf(given) };
  if (holes !== undefined && holes !== 'all') checked.holes = indicesOf('holes', holes);
  if (groups !== undefined) checked.groups = listOf('groups', groups, (group, name) => indicesOf(name, group, 1));
  if (perHole !== undefined) checked.perHole = perHoleOf(perHole);
  checked.fillOpenRims = flagOf('fillOpenRims', fillOpenRims);
  if (maxVertices !== undefined) checked.maxVertices = amountOf('maxVertices', maxVertices);
  if (maxLength !== undefined) checked.maxLength = amountOf('maxLength', maxLength);
  checked.output = choiceOf('output', ['mesh', 'patches'], output);
  if (maxSecondsPerHole !== undefined) checked.maxSecondsPerHole = amountOf('maxSecondsPerHole', maxSecondsPerHole);
  if (functionOf('onProgress', onProgress) !== undefined) checked.onProgress = onProgress;
  return checked as FillOptions;
}

/** Options of `findHoles` and of sessions, checked, without those that were left out. @throws SoapfilmError `bad-option` */
export function holeOptionsOf(given: Given<HoleOptions>): HoleOptions {
  return { ...openingOptionsOf(given), ...listenerOf(given) };
}

/** The listener among options, checked. @throws SoapfilmError `bad-option` */
export function listenerOf({ onProgress }: Given<Pick<HoleOptions, 'onProgress'>>): Pick<HoleOptions, 'onProgress'> {
  return functionOf('onProgress', onProgress) === undefined ? {} : { onProgress: onProgress as HoleOptions['onProgress'] & object };
}

/** Options that finding and filling have. @throws SoapfilmError `bad-option` */
function openingOptionsOf(given: Given<Omit<HoleOptions, 'onProgress'>>): HoleOptions {
  const { weld } = given;
  return { ...limitsOf(given), ...(weld !== undefined && { weld: amountOf('weld', weld, Number.MAX_VALUE) }) };
}

function patchOptionsOf(given: Given<HoleFillOptions>, path = ''): HoleFillOptions {
  const { weights, candidates, fairness, density, maxNewVertices, creases } = given;
  const checked: { -readonly [K in keyof HoleFillOptions]: unknown } = {};
  if (weights !== undefined) {
    const given = weightsOf(weights, `${path}weights`);
    if (!Object.values(given).some((weight) => weight > 0)) {
      throw new SoapfilmError('bad-weights', `At least one of \`${path}weights\` must be positive`);
    }
    checked.weights = given;
  }
  if (candidates !== undefined) checked.candidates = choiceOf(`${path}candidates`, ['auto', 'all', 'delaunay', 'near'], candidates);
  if (fairness !== undefined) checked.fairness = choiceOf(`${path}fairness`, ['auto', 0, 1, 2], fairness);
  if (density !== undefined) checked.density = amountOf(`${path}density`, density, 100);
  if (maxNewVertices !== undefined) checked.maxNewVertices = amountOf(`${path}maxNewVertices`, maxNewVertices);
  if (creases !== undefined) {
    checked.creases = typeof creases === 'number' ? amountOf(`${path}creases`, creases, 180) : flagOf(`${path}creases`, creases);
  }
  return checked as HoleFillOptions;
}

function perHoleOf(value: unknown): Readonly<Record<number, HoleFillOptions>> {
  return Object.fromEntries(
    entriesOf(value, 'perHole', 'bad-option').map(([key, options]) => {
      const name = `perHole[${key}]`;
      if (String(Number(key) >>> 0) !== key) throw new SoapfilmError('bad-option', `\`${name}\` is not the number of a hole`);
      return [key, patchOptionsOf(optionsOf(options, kHoleFillOptions, name), `${name}.`)];
    }),
  );
}

/** An array, each item read once and at once: one may be sparse, and have billions. */
function listOf<T>(name: string, value: unknown, read: (item: unknown, name: string) => T): T[] {
  const list = guarded('bad-option', name, () => {
    if (!Array.isArray(value)) return undefined;
    const items: T[] = [];
    for (let i = 0; i < value.length; i++) items.push(read(value[i], `${name}[${i}]`));
    return items;
  });
  if (list) return list;
  throw mustBe('bad-option', name, 'an array', value);
}

/** A list of at least `least` different numbers of things. @throws SoapfilmError `bad-option` */
export function indicesOf(name: string, value: unknown, least = 0): number[] {
  const list = listOf(name, value, (item, place) => {
    if (isIndex(item)) return item;
    throw mustBe('bad-option', place, 'a whole number and not negative', item);
  });
  if (list.length < least) throw mustBe('bad-option', name, 'an array of at least one number of a loop', value);
  if (new Set(list).size < list.length) throw new SoapfilmError('bad-option', `\`${name}\` has a number twice`);
  return list;
}

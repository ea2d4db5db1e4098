// Every public function, argument by argument, and every kind of value that may be put in its place.
import {
  formatLoops,
  formatObj,
  load,
  parseLoops,
  type ErrorCode,
  type fillHoles,
  type findHoles,
  type PolygonSession,
  type smoothSurface,
  type spanLoops,
  type triangulateGeoJSON,
  type triangulatePolygon,
  type triangulatePolygons,
} from 'soapfilm';
import { readMesh, writeMesh } from 'soapfilm/files';
import { fromGeomdl, fromOpenCascade, fromRhino, fromThree, parseTrimmedModel, type Face, type TrimmedModel } from 'soapfilm/surfaces';
import { createWorker, type Film, type PolygonSessionHandle, type TrimmedModelHandle } from 'soapfilm/worker';
import { box, plate } from './models.js';

function detached<T extends ArrayBufferView>(view: T): T {
  structuredClone(view.buffer, { transfer: [view.buffer as ArrayBuffer] });
  return view;
}

const throwing = (): never => {
  throw new Error('not for you');
};
/** Whatever one asks it for, it throws. */
function hostile(target: object): object {
  const traps = ['get', 'has', 'ownKeys', 'getOwnPropertyDescriptor', 'getPrototypeOf'];
  return new Proxy(target, Object.fromEntries(traps.map((trap) => [trap, throwing])));
}
function revoked(): object {
  const { proxy, revoke } = Proxy.revocable([], {});
  revoke();
  return proxy;
}
function outOfBounds(): Float64Array {
  const Resizable = ArrayBuffer as new (bytes: number, options: object) => ArrayBuffer & { resize?(bytes: number): void };
  const buffer = new Resizable(24, { maxByteLength: 48 });
  const view = new Float64Array(buffer, 0, 3);
  buffer.resize?.(8);
  return view;
}

/** Values of every kind, each made anew. Arrays have three entries, all 0, unless said otherwise. */
export const kValues = {
  missing: () => undefined,
  null: () => null,
  'empty string': () => '',
  string: () => 'text',
  digits: () => '3',
  NaN: () => NaN,
  infinity: () => Infinity,
  '-infinity': () => -Infinity,
  fraction: () => 0.5,
  negative: () => -1,
  '2^32 - 1': () => 2 ** 32 - 1,
  '2^32': () => 2 ** 32,
  '2^32 + 4': () => 2 ** 32 + 4,
  BigInt: () => 5n,
  true: () => true,
  false: () => false,
  symbol: () => Symbol('s'),
  function: () => () => 1,
  'empty object': () => ({}),
  'empty array': () => [],
  'short array': () => [1],
  'sparse array': () => new Array<unknown>(3),
  'huge sparse array': () => new Array<unknown>(2 ** 32 - 1),
  'array of BigInts': () => [1n, 2n, 3n],
  'array of itself': () => {
    const array: unknown[] = [];
    array.push(array, array, array);
    return array;
  },
  Int8Array: () => new Int8Array(3),
  Uint8Array: () => new Uint8Array(3),
  Uint8ClampedArray: () => new Uint8ClampedArray(3),
  Int16Array: () => new Int16Array(3),
  Uint16Array: () => new Uint16Array(3),
  Int32Array: () => new Int32Array(3),
  Uint32Array: () => new Uint32Array(3),
  Float32Array: () => new Float32Array(3),
  Float64Array: () => new Float64Array(3),
  BigInt64Array: () => new BigInt64Array(3),
  BigUint64Array: () => new BigUint64Array(3),
  DataView: () => new DataView(new ArrayBuffer(24)),
  ArrayBuffer: () => new ArrayBuffer(24),
  SharedArrayBuffer: () => new SharedArrayBuffer(24),
  'detached Float64Array': () => detached(new Float64Array(3)),
  'detached Uint32Array': () => detached(new Uint32Array(3)),
  'detached Uint8Array': () => detached(new Uint8Array(3)),
  'Float64Array out of bounds': outOfBounds,
  'heir of Float64Array': () => Object.create(Float64Array.prototype) as unknown,
  'throwing object': () => hostile({}),
  'throwing array': () => hostile([]),
  'revoked proxy': revoked,
} satisfies Record<string, () => unknown>;

export type Kind = keyof typeof kValues;

/** One place where a value may be put. */
export interface Slot {
  /** The function and the argument, as a caller would write it. */
  readonly title: string;
  /** Calls with the value in that place. */
  readonly call: (value: unknown) => unknown;
  /** The kinds that are right there. For all others there is an error. */
  readonly valid: readonly Kind[];
  /** What its message has to name. */
  readonly names: RegExp;
  readonly codes: readonly ErrorCode[];
}

const kFinite: readonly Kind[] = ['fraction', 'negative', '2^32 - 1', '2^32', '2^32 + 4'];
const kPositive: readonly Kind[] = ['fraction', '2^32 - 1', '2^32', '2^32 + 4'];
const kLimit: readonly Kind[] = ['missing', 'infinity', ...kPositive];
/** Half a byte is too little. */
const kBytesLimit = kLimit.filter((kind) => kind !== 'fraction');
const kFlag: readonly Kind[] = ['missing', 'true', 'false'];
const kCallback: readonly Kind[] = ['missing', 'function'];
const kText: readonly Kind[] = ['missing', 'empty string', 'string', 'digits'];
const kOptions: readonly Kind[] = ['missing', 'empty object', 'ArrayBuffer', 'SharedArrayBuffer', 'heir of Float64Array'];
/** Where bytes are expected that are looked at later, or never as those of before do. */
const kBytes: readonly Kind[] = [
  'Int8Array', 'Uint8Array', 'Uint8ClampedArray', 'Int16Array', 'Uint16Array', 'Int32Array', 'Uint32Array',
  'Float32Array', 'Float64Array', 'BigInt64Array', 'BigUint64Array', 'DataView', 'ArrayBuffer',
  'detached Float64Array', 'detached Uint32Array', 'detached Uint8Array', 'Float64Array out of bounds',
];

const kLoop = [[1, 1, 1], [3, 1, 1], [3, 3, 1], [1, 3, 2]];
const kRing = [[1, 1], [9, 1], [9, 9], [1, 9]];
const kHole = [[2, 2], [4, 2], [4, 4]];
const kLoops = { positions: Float64Array.from(kLoop.flat()), starts: Uint32Array.of(0, 4) };
const kFlat = { positions: Float64Array.from([...kRing, ...kHole].flat()), starts: Uint32Array.of(0, 4, 7) };
const kBatch = { positions: kFlat.positions, ringStarts: kFlat.starts, polygonStarts: Uint32Array.of(0, 2) };
const kEarcut = { coordinates: [...kRing, ...kHole].flat(), holeIndices: [4] };
const kGeometry = { type: 'Polygon', coordinates: [kRing, kHole] };
const kFeature = { type: 'Feature', geometry: kGeometry, properties: null };
const kSurface = {
  positions: kLoops.positions,
  triangles: Uint32Array.of(0, 1, 2, 0, 2, 3),
  loopVertices: Uint32Array.of(0, 1, 2, 3),
  starts: Uint32Array.of(0, 4),
};
const kCurve = formatLoops(kLoops);
/** Two tetrahedra far from each other, a face missing in each: two holes. */
export const kTwoHoles = {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 9, 0, 0, 10, 0, 0, 9, 1, 0, 9, 0, 1),
  faces: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 4, 7, 6),
};

const kArrays: readonly Kind[] = [
  'empty array', 'short array', 'sparse array', 'huge sparse array', 'array of BigInts', 'array of itself', 'throwing array',
];
const kTriangle = [[0.25, 0.25], [0.75, 0.25], [0.5, 0.75]];
const { edges: kPlateEdges = [], ...kPlateFace } = plate([kTriangle]);
/** A face with a hole. */
export const kPlate = { faces: [kPlateFace], edges: kPlateEdges };
const kCamera = { eye: [0, 0, 9], viewProjection: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.1, 0, 0, 0, 0, 1], width: 100, height: 100, pixels: 1 };

const kCameraValues: Readonly<Record<keyof typeof kCamera, readonly Kind[]>> = {
  eye: ['Float32Array', 'Float64Array'],
  viewProjection: [],
  width: kPositive,
  height: kPositive,
  pixels: ['missing', ...kPositive],
};

/** A list with one item replaced. */
const having = (list: readonly unknown[], index: number, value: unknown): unknown[] =>
  list.map((item, i) => (i === index ? value : item));

/** The functions that there are in both entries. */
export interface Functions {
  readonly spanLoops: typeof spanLoops | Film['spanLoops'];
  readonly triangulatePolygon: typeof triangulatePolygon | Film['triangulatePolygon'];
  readonly triangulatePolygons: typeof triangulatePolygons | Film['triangulatePolygons'];
  readonly triangulateGeoJSON: typeof triangulateGeoJSON | Film['triangulateGeoJSON'];
  readonly findHoles: typeof findHoles | Film['findHoles'];
  readonly fillHoles: typeof fillHoles | Film['fillHoles'];
  readonly smoothSurface: typeof smoothSurface | Film['smoothSurface'];
}

type Call = (...args: never[]) => unknown;
type Row = [path: string, call: (value: unknown) => unknown, valid?: readonly Kind[], names?: RegExp];

function slots(name: string, codes: readonly ErrorCode[], rows: readonly Row[]): Slot[] {
  return rows.map(([path, call, valid = [], names]) => {
    const last = /(\w+)(\[\d\])*$/.exec(path)?.[1] ?? path;
    return { title: `${name}: ${path}`, call, valid, names: names ?? new RegExp(`\\b${last}\\b`, 'i'), codes };
  });
}

/** Options of a function, each by itself. */
function optionSlots(
  name: string,
  call: (options: unknown) => unknown,
  options: Readonly<Record<string, readonly Kind[]>>,
): Slot[] {
  const rows = Object.entries(options).map(([option, valid]): Row => [
    option,
    (value) => call({ [option]: value }),
    valid,
  ]);
  const codes: ErrorCode[] = ['bad-option', 'bad-weights', 'bad-normals', 'bad-candidates', 'too-large', 'out-of-memory'];
  return slots(name, codes, [['options', call, kOptions, /\boptions\b|cannot be read/], ...rows]);
}

const kLimits = { maxMemoryBytes: kBytesLimit, maxSeconds: kLimit };
const kPolygonOptions = {
  ...kLimits,
  method: ['missing'],
  output: ['missing'],
  quality: ['missing'],
  repair: ['missing'],
  verify: kFlag,
  trace: kFlag,
  borrow: kFlag,
} as const;
const kWeld: readonly Kind[] = ['missing', ...kPositive];
const kPatchOptions = {
  weights: ['missing'],
  candidates: ['missing'],
  fairness: ['missing'],
  density: ['missing', 'fraction'],
  maxNewVertices: kLimit,
  creases: ['missing', 'fraction', 'true', 'false'],
} as const;
const kPolygonsOptions = { ...kPolygonOptions, skipInvalid: kFlag };

/** The places in the arguments of functions that both entries have; `more` are options that all take. */
export function functionSlots(functions: Functions, more: Readonly<Record<string, readonly Kind[]>> = {}): Slot[] {
  const span = functions.spanLoops as Call as (loops: unknown, options?: unknown) => unknown;
  const polygon = functions.triangulatePolygon as Call as typeof span;
  const polygons = functions.triangulatePolygons as Call as typeof span;
  const geojson = functions.triangulateGeoJSON as Call as typeof span;
  const find = functions.findHoles as Call as typeof span;
  const fill = functions.fillHoles as Call as typeof span;
  const smooth = functions.smoothSurface as Call as typeof span;
  const meshSlots = (name: string, call: typeof span) =>
    slots(name, ['bad-mesh', 'not-finite'], [
      ['mesh', call],
      ['mesh.positions', (v) => call({ ...kTwoHoles, positions: v }), [], /`mesh\.positions`|Face 0/],
      ['mesh.positions, alone', (v) => call({ positions: v, faces: new Uint32Array() }), floats, /`mesh\.positions`/],
      ['mesh.faces', (v) => call({ ...kTwoHoles, faces: v }), ['Uint32Array'], /`mesh\.faces`/],
      ['mesh.triangles', (v) => call({ positions: kTwoHoles.positions, triangles: v }), ['Uint32Array'], /`mesh\.(triangles|faces)`/],
    ]);
  const attributeSlots = (name: string, call: typeof span) =>
    slots(name, ['bad-attributes'], [
      ['mesh.attributes', (v) => call({ ...kTwoHoles, attributes: v }), kOptions],
      ['mesh.attributes.colour', (v) => call({ ...kTwoHoles, attributes: { colour: v } }), ['missing']],
      ['mesh.attributes.colour.data', (v) => call({ ...kTwoHoles, attributes: { colour: { data: v, size: 3 } } }), [], /attributes/],
      ['mesh.attributes.colour.size', (v) => call({ ...kTwoHoles, attributes: { colour: { data: new Float32Array(24), size: v } } }), [], /attributes/],
    ]);
  const weigh = (weights: object) => span([kLoop], { weights });
  const choose = (candidates: object) => span([kLoop], { candidates: { triangles: kSurface.triangles, ...candidates } });
  const floats: readonly Kind[] = ['Float32Array', 'Float64Array'];
  const loop = /\b[Ll]oop 0\b|`loops`/;
  const ring = /\b[Rr]ing 0\b|`polygons?\b|`geojson`/;
  return [
    ...slots('spanLoops', ['bad-loops', 'bad-starts', 'no-loops', 'not-finite', 'too-few-vertices', 'too-large'], [
      ['loops', span, [], /\bloops?\b/i],
      ['loops[0]', (v) => span([v]), [], loop],
      ['loops[0][1]', (v) => span([having(kLoop, 1, v)]), floats, loop],
      ['loops[0][1][2]', (v) => span([having(kLoop, 1, [3, 1, v])]), kFinite, loop],
      ['loops[0][1].x', (v) => span([having(kLoop, 1, { x: v, y: 1, z: 1 })]), kFinite, loop],
      ['loops.positions', (v) => span({ ...kLoops, positions: v }), [], /\bpositions\b|\bstarts\b/],
      ['loops.positions, alone', (v) => span({ positions: v }), [], /\bpositions\b|\b[Ll]oop 0\b/],
      ['loops.starts', (v) => span({ ...kLoops, starts: v }), ['missing']],
      ['loops.starts[1]', (v) => span({ ...kLoops, starts: [0, v] })],
    ]),
    ...optionSlots('spanLoops', (options) => span([kLoop], options), {
      ...kLimits,
      weights: ['missing'],
      objective: ['missing'],
      candidates: ['missing'],
      boundaryNormals: ['missing'],
      startFrom: ['missing', 'Uint32Array'],
      bestSoFar: kFlag,
      onBest: kCallback,
      onProgress: kCallback,
      ...more,
    }),
    ...slots('spanLoops, options', ['bad-weights', 'bad-candidates'], [
      // The others are 0, so missing ones leave no weight at all.
      ['weights.area', (v) => weigh({ area: v, dihedral: 1 }), ['missing', ...kPositive]],
      ['weights.perimeter', (v) => weigh({ perimeter: v, dihedral: 1 }), ['missing', ...kPositive]],
      ['weights.dihedral', (v) => weigh({ dihedral: v, area: 1 }), ['missing', ...kPositive]],
      ['candidates.triangles', (v) => choose({ triangles: v }), [], /\btriangles\b|Candidate 0/],
      ['candidates.weights', (v) => choose({ weights: v }), ['missing']],
    ]),
    ...slots('triangulatePolygon', ['bad-polygon', 'bad-starts', 'bad-option', 'not-finite', 'degenerate', 'self-intersecting', 'holes-overlap', 'too-large'], [
      ['polygon', polygon, ['empty array'], ring],
      ['polygon[0]', (v) => polygon([v, kHole]), [], ring],
      ['polygon[0][0]', (v) => polygon([having(kRing, 0, v), kHole]), [], ring],
      ['polygon[0][0], in space', (v) => polygon([having(kLoop.map(([x, y]) => [x, y, 0]), 0, v)]), floats, ring],
      ['polygon[0][0][1]', (v) => polygon([having(kRing, 0, [1, v]), kHole]), ['fraction', 'negative'], ring],
      ['polygon[0][0].y', (v) => polygon([having(kRing, 0, { x: 1, y: v }), kHole]), ['fraction', 'negative'], ring],
      ['polygon.positions', (v) => polygon({ ...kFlat, positions: v }), [], /\bpositions\b|\bstarts\b/],
      ['polygon.starts', (v) => polygon({ ...kFlat, starts: v }), [], /\bstarts\b|\b[Rr]ing 0\b/],
      ['polygon.starts[1]', (v) => polygon({ ...kFlat, starts: [0, v, 7] })],
      ['polygon.dim', (v) => polygon({ ...kFlat, dim: v }), ['missing']],
      ['polygon.points', (v) => polygon({ ...kFlat, points: v }), ['missing']],
      ['polygon.coordinates', (v) => polygon({ ...kEarcut, coordinates: v }), [], /\bcoordinates\b|\bpositions\b|holeIndices/],
      ['polygon.coordinates[0]', (v) => polygon({ ...kEarcut, coordinates: having(kEarcut.coordinates, 0, v) }), ['fraction', 'negative'], /\bcoordinates\b|\b[Rr]ing 0\b/],
      ['polygon.holeIndices', (v) => polygon({ ...kEarcut, holeIndices: v }), [], /\bholeIndices\b|\b[Rr]ing \d\b/],
      ['polygon.holeIndices[0]', (v) => polygon({ ...kEarcut, holeIndices: [v] }), []],
    ]),
    ...optionSlots('triangulatePolygon', (options) => polygon([kRing], options), { ...kPolygonOptions, ...more }),
    ...slots('triangulatePolygons', ['bad-polygon', 'bad-starts', 'bad-option', 'not-finite', 'degenerate', 'too-large'], [
      ['polygons', polygons, ['empty array'], /`polygons|[Pp]olygon 0|[Rr]ing 0/],
      ['polygons[0]', (v) => polygons([v]), ['empty array'], /[Pp]olygon 0|[Rr]ing 0|`polygons`/],
      ['polygons[0][0]', (v) => polygons([[v]]), [], ring],
      ['polygons[0][0][2]', (v) => polygons([[having(kRing, 2, v)]]), [], ring],
      ['polygons.positions', (v) => polygons({ ...kBatch, positions: v }), [], /\bpositions\b|\bringStarts\b/],
      ['polygons.ringStarts', (v) => polygons({ ...kBatch, ringStarts: v })],
      ['polygons.polygonStarts', (v) => polygons({ ...kBatch, polygonStarts: v })],
      ['polygons.polygonStarts[1]', (v) => polygons({ ...kBatch, polygonStarts: [0, v] })],
      ['polygons.dim', (v) => polygons({ ...kBatch, dim: v }), ['missing']],
    ]),
    ...optionSlots('triangulatePolygons', (options) => polygons([[kRing]], options), { ...kPolygonsOptions, ...more }),
    ...slots('triangulateGeoJSON', ['bad-polygon', 'not-finite', 'degenerate', 'self-intersecting', 'too-large'], [
      ['geojson', geojson, []],
      ['geojson.type', (v) => geojson({ ...kGeometry, type: v }), [], /\bgeojson\b/],
      ['geojson.coordinates', (v) => geojson({ ...kGeometry, coordinates: v }), ['empty array'], /\bgeojson\b/],
      ['geojson.coordinates, of several', (v) => geojson({ type: 'MultiPolygon', coordinates: v }), ['empty array'], /\bgeojson\b/],
      ['geojson.coordinates[0]', (v) => geojson({ ...kGeometry, coordinates: [v] }), [], ring],
      ['geojson.coordinates[0][0]', (v) => geojson({ ...kGeometry, coordinates: [having(kRing, 0, v)] }), ['Float32Array', 'Float64Array'], ring],
      ['geojson.coordinates[0][0][0]', (v) => geojson({ ...kGeometry, coordinates: [having(kRing, 0, [v, 1])] }), ['fraction', 'negative'], ring],
      ['geojson.geometry', (v) => geojson({ ...kFeature, geometry: v }), ['null'], /\bgeojson\b/],
      ['geojson.geometries', (v) => geojson({ type: 'GeometryCollection', geometries: v }), ['empty array'], /\bgeojson\b/],
      ['geojson.features', (v) => geojson({ type: 'FeatureCollection', features: v }), ['empty array'], /\bgeojson\b/],
      ['geojson.features[0]', (v) => geojson({ type: 'FeatureCollection', features: [v] }), [], /\bgeojson\b/],
    ]),
    ...optionSlots('triangulateGeoJSON', (options) => geojson(kFeature, options), { ...kPolygonsOptions, ...more }),
    ...meshSlots('findHoles', find),
    ...attributeSlots('findHoles', find),
    ...optionSlots('findHoles', (options) => find(kTwoHoles, options), { ...kLimits, weld: kWeld, ...more }),
    ...meshSlots('fillHoles', fill),
    ...attributeSlots('fillHoles', fill),
    ...optionSlots('fillHoles', (options) => fill(kTwoHoles, options), {
      ...kLimits,
      ...kPatchOptions,
      weld: kWeld,
      holes: ['missing', 'empty array', 'short array'],
      groups: ['missing', 'empty array'],
      perHole: kOptions,
      fillOpenRims: kFlag,
      maxVertices: kLimit,
      maxLength: kLimit,
      output: ['missing'],
      onProgress: kCallback,
      ...more,
    }),
    ...slots('smoothSurface', ['bad-mesh', 'not-finite'], [
      ['surface', smooth],
      ['surface.positions', (v) => smooth({ ...kTwoHoles, positions: v }), [], /`surface\.positions`|Face 0/],
      ['surface.positions, alone', (v) => smooth({ positions: v, faces: new Uint32Array() }), floats, /`surface\.positions`/],
      // A face with one vertex three times is no surface.
      ['surface.faces', (v) => smooth({ ...kTwoHoles, faces: v }), [], /`surface\.faces`|Face 0/],
      ['surface.triangles', (v) => smooth({ positions: kTwoHoles.positions, triangles: v }), [], /`surface\.(triangles|faces)`|Face 0/],
    ]),
    ...optionSlots('smoothSurface', (options) => smooth(kTwoHoles, options), {
      ...kLimits,
      kind: ['missing'],
      density: ['missing', 'fraction'],
      maxNewVertices: kLimit,
      fixed: ['missing', 'empty array', 'short array'],
      boundaryNormals: ['missing'],
      ...more,
    }),
    ...slots('smoothSurface, options', ['bad-option', 'bad-normals'], [
      ['fixed[1]', (v) => smooth(kTwoHoles, { fixed: [0, v] })],
      ['boundaryNormals, of a plate', (v) => smooth(kTwoHoles, { kind: 'thin-plate', boundaryNormals: v }), ['missing'], /`boundaryNormals`/],
    ]),
    ...slots('fillHoles, options', ['bad-option', 'bad-weights'], [
      ['holes[0]', (v) => fill(kTwoHoles, { holes: [v] })],
      ['groups[0]', (v) => fill(kTwoHoles, { groups: [v] }), ['short array']],
      ['groups[0][1]', (v) => fill(kTwoHoles, { groups: [[0, v]] })],
      ['perHole[0]', (v) => fill(kTwoHoles, { perHole: { 0: v } }), kOptions],
      ['weights.area', (v) => fill(kTwoHoles, { weights: { area: v, dihedral: 1 } }), ['missing', ...kPositive]],
      ...Object.entries(kPatchOptions).map(
        ([option, valid]): Row => [`perHole[1].${option}`, (v) => fill(kTwoHoles, { perHole: { 1: { [option]: v } } }), valid],
      ),
    ]),
  ];
}

type AnySession = PolygonSession | PolygonSessionHandle;

/**
 * The places in the arguments of a session's methods, each called on a session of its own; `more` are further
 * options of `open`.
 */
export function sessionSlots(
  open: (polygon: unknown, options?: unknown) => AnySession | Promise<AnySession>,
  more: Readonly<Record<string, readonly Kind[]>> = {},
): Slot[] {
  const on = (edit: (session: AnySession, value: never) => unknown) => async (value: unknown) => {
    const session = await open([kRing]);
    try {
      return await edit(session, value as never);
    } finally {
      session.dispose();
    }
  };
  const codes: ErrorCode[] = ['bad-option', 'not-finite', 'self-intersecting', 'hole-outside'];
  const point = /`point`|[Vv]ertex \d/;
  const ring = /\b[Rr]ing 0\b|`polygon|`starts`/;
  const p = [5, 0] as const;
  return [
    ...slots('PolygonSession', ['bad-polygon', 'bad-starts', 'not-finite', 'degenerate', 'too-large'], [
      ['polygon', open, [], ring],
      ['polygon[0]', (v) => open([v]), [], ring],
      ['polygon[0][3]', (v) => open([having(kRing, 3, v)]), [], ring],
      ['polygon.points', (v) => open({ ...kFlat, points: v }), ['missing']],
    ]),
    ...optionSlots('PolygonSession', (options) => open([kRing], options), { maxMemoryBytes: kBytesLimit, ...more }),
    ...slots('PolygonSession.insert', codes, [
      ['before', on((session, v) => session.insert(v, p))],
      ['point', on((session, v) => session.insert(0, v)), [], point],
      ['point[0]', on((session, v) => session.insert(0, [v, 0])), kFinite, point],
      ['point.x', on((session, v) => session.insert(0, { x: v, y: 0 })), kFinite, point],
    ]),
    ...slots('PolygonSession.insertPoint', codes, [
      ['point', on((session, v) => session.insertPoint(v)), [], point],
      // None of the numbers is inside.
      ['point[1]', on((session, v) => session.insertPoint([5, v])), [], /`point`|inside/],
      ['point.y', on((session, v) => session.insertPoint({ x: 5, y: v })), [], /`point`|inside/],
    ]),
    ...slots('PolygonSession.delete', codes, [['vertex', on((session, v) => session.delete(v))]]),
    ...slots('PolygonSession.move', codes, [
      ['vertex', on((session, v) => session.move(v, p))],
      ['point', on((session, v) => session.move(0, v)), [], point],
      ['point[0]', on((session, v) => session.move(0, [v, 0])), ['fraction', 'negative'], point],
      ['point.y', on((session, v) => session.move(0, { x: 1, y: v })), ['fraction', 'negative'], point],
    ]),
  ];
}

type AnyModel = TrimmedModel | TrimmedModelHandle;

/** The places in a model, in its options, and in the arguments of its methods; `more` are further options of `open`. */
export function modelSlots(
  open: (model: unknown, options?: unknown) => AnyModel | Promise<AnyModel>,
  more: Readonly<Record<string, readonly Kind[]>> = {},
): Slot[] {
  const on = (use: (model: AnyModel, value: never) => unknown) => async (value: unknown) => {
    const model = await open(kPlate);
    try {
      return await use(model, value as never);
    } finally {
      model.dispose();
    }
  };
  const field = (change: (face: Face, value: unknown) => object) => (value: unknown) => {
    const { edges, ...face } = change(plate([kTriangle]), value) as Face;
    return open({ faces: [face], edges });
  };
  const surface = (name: string) => field((face, value) => ({ ...face, surface: { ...face.surface, [name]: value } }));
  const use = (name: string) =>
    field((face, value) => {
      const [around, hole] = face.loops ?? [];
      return { ...face, loops: [around, { uses: [{ ...hole.uses[0], [name]: value }] }] };
    });
  const curve = (name: string) =>
    field((face, value) => {
      const [around, hole] = face.loops ?? [];
      return { ...face, loops: [around, { uses: [{ ...hole.uses[0], pcurve: { ...hole.uses[0].pcurve, [name]: value } }] }] };
    });
  const edge = (name: string) =>
    field((face, value) => ({ ...face, edges: (face.edges ?? []).map((given, e) => (e === 2 ? { ...given, [name]: value } : given)) }));
  const { poles } = kPlate.faces[0].surface;
  const codes: ErrorCode[] = [
    'bad-model', 'bad-knots', 'bad-weights', 'not-finite', 'bad-edge', 'bad-domain', 'degenerate', 'edge-apart', 'trims-cross', 'trim-open', 'trim-outside',
  ];
  const face = /`model\.faces|[Ff]ace 0/;
  const optional: readonly Kind[] = ['missing', 'null'];
  const instance = (value: object) => open({ instances: [{ part: box(), ...value }] });
  return [
    ...slots('TrimmedModel', codes, [
      ['model', open],
      ['model.faces', (v) => open({ faces: v, edges: [] }), ['empty array'], /faces/],
      ['model.edges', (v) => open({ ...kPlate, edges: v }), [], /edges?/],
      ['model.faces[0]', (v) => open({ ...kPlate, faces: [v] }), [], face],
      ['model.faces[0].surface', field((given, surface) => ({ ...given, surface }))],
      ['surface.degreeU', surface('degreeU'), [], face],
      ['surface.knotsV', surface('knotsV'), [], face],
      ['surface.knotsU[3]', (v) => surface('knotsU')([0, 0, 1, v]), ['2^32 - 1', '2^32', '2^32 + 4'], face],
      ['surface.countV', surface('countV'), [], face],
      ['surface.poles', surface('poles'), [], face],
      ['surface.poles[3]', (v) => surface('poles')([...poles.slice(0, 3), v]), ['Float32Array', 'Float64Array'], face],
      ['surface.poles[3][2]', (v) => surface('poles')([...poles.slice(0, 3), [1, 1, v]]), kFinite, face],
      ['surface.weights', surface('weights'), optional, face],
      ['surface.weights[0]', (v) => surface('weights')([v, 1, 1, 1]), kPositive, face],
      ['surface.domain', surface('domain'), ['missing'], face],
      ['face.reversed', field((given, reversed) => ({ ...given, reversed })), kFlag],
      // Without an outer loop, the one given is a hole, along the border of the domain.
      ['face.outer', field((given, outer) => ({ ...given, outer })), ['missing'], face],
      ['face.loops', field((given, loops) => ({ ...given, loops })), ['missing', 'empty array'], face],
      ['face.loops[1]', field((given, loop) => ({ ...given, loops: [(given.loops ?? [])[0], loop] })), [], face],
      ['loop.uses', field((given, uses) => ({ ...given, loops: [(given.loops ?? [])[0], { uses }] })), [], face],
      ['use.edge', use('edge')],
      ['use.reversed', use('reversed'), kFlag],
      ['use.seam', use('seam'), kFlag],
      ['use.pcurve', use('pcurve'), [], face],
      ['pcurve.degree', curve('degree'), [], face],
      ['pcurve.knots', curve('knots'), [], face],
      ['pcurve.poles', curve('poles'), [], face],
      ['pcurve.weights', curve('weights'), optional, face],
      ['pcurve.domain', curve('domain'), ['missing'], face],
      ['edge.degenerate', edge('degenerate'), ['missing', 'false'], /degenerate|[Ff]ace 0/],
      ['edge.tolerance', edge('tolerance'), ['missing', ...kPositive], /tolerance|[Ff]ace 0/],
      ['edge.range', edge('range'), [], /range|[Ff]ace 0/],
      ['edge.curve3d', edge('curve3d'), optional],
      ['model.instances', (v) => open({ ...kPlate, instances: v }), ['missing', 'empty array']],
      ['instances[0]', (v) => open({ instances: [v] })],
      ['instances[0].part', (v) => instance({ part: v }), [], /part/],
      ['instances[0].matrix', (v) => instance({ matrix: v }), ['missing']],
      ['instances[0].matrix[5]', (v) => instance({ matrix: [1, 0, 0, 0, 0, v, 0, 0, 0, 0, 1, 0] }), kFinite, /matrix/],
      ['model.parts', (v) => open({ instances: [{ part: 'a' }], parts: v })],
    ]),
    ...optionSlots('TrimmedModel', (options) => open(kPlate, options), { skipInvalid: kFlag, maxMemoryBytes: kBytesLimit, ...more }),
    ...optionSlots('tessellate', (v) => on((model, value) => model.tessellate(value))(v), {
      ...kLimits,
      tolerance: ['missing', ...kPositive],
      relative: ['missing', ...kPositive],
      angle: ['missing', 'infinity', ...kPositive],
      aspect: ['missing', 'infinity', '2^32 - 1', '2^32', '2^32 + 4'],
      maxTriangles: kLimit,
      camera: ['missing'],
      onProgress: kCallback,
      ...more,
    }),
    ...slots('update, camera', ['bad-option'], [
      ...Object.entries(kCameraValues).map(
        ([name, valid]): Row => [`camera.${name}`, (v) => on((model) => model.update({ camera: { ...kCamera, [name]: v } }))(undefined), valid],
      ),
    ]),
    ...slots('movePole', ['bad-option'], [
      ['face', on((model, v) => model.movePole(v, 0, [0, 0, 0])), [], /`face`|pole/],
      ['pole', on((model, v) => model.movePole(0, v, [0, 0, 0])), [], /pole/],
      ['at', on((model, v) => model.movePole(0, 0, v)), ['Float32Array', 'Float64Array']],
      ['at[2]', on((model, v) => model.movePole(0, 0, [0, 0, v])), kFinite],
      ['weight', on((model, v) => model.movePole(0, 0, [0, 0, 0], v)), ['missing', ...kPositive]],
    ]),
    ...slots('moveTrim', ['bad-option', 'trim-outside', 'trims-cross', 'trim-self-intersects'], [
      ['loop', on((model, v) => model.moveTrim(0, v, 0, 1, [0.75, 0.25])), [], /`loop`|pole/],
      ['use', on((model, v) => model.moveTrim(0, 1, v, 1, [0.75, 0.25])), [], /`use`|pole/],
      ['pole', on((model, v) => model.moveTrim(0, 1, 0, v, [0.75, 0.25])), [], /pole/],
      ['at', on((model, v) => model.moveTrim(0, 1, 0, 1, v))],
      ['at[0]', on((model, v) => model.moveTrim(0, 1, 0, 1, [v, 0.25])), ['fraction'], /`at`|[Ff]ace 0/],
    ]),
  ];
}

/** Those of models from files and from other libraries. */
export function modelFileSlots(): Slot[] {
  const parse = parseTrimmedModel as (json: unknown) => unknown;
  const codes: ErrorCode[] = ['bad-file', 'bad-model'];
  const rhino = fromRhino as (brep: unknown, rhino: unknown, options?: unknown) => unknown;
  const none = { count: 0, get: () => undefined };
  const brep = { faces: () => none, edges: () => none };
  const types = { BrepLoopType: { Outer: 1, Inner: 2 } };
  return [
    ...slots('parseTrimmedModel', codes, [
      ['json', parse, [], /`model`|JSON|schema|`model\.schema`/],
      // What is in it is looked at later.
      ['model.faces', (v) => parse({ ...kPlate, schema: 'trimmed-nurbs/1', faces: v }), kArrays, /faces/],
    ]),
    ...slots('fromGeomdl', codes, [
      ['json', fromGeomdl, [], /`file|JSON/],
      ['file.shape', (v) => fromGeomdl({ shape: v }), [], /`file\.shape|surfaces/],
      ['file.shape.data', (v) => fromGeomdl({ shape: { type: 'surface', data: v } }), ['empty array'], /`file\.shape\.data`/],
    ]),
    ...slots('fromThree', codes, [['nurbsSurface', fromThree as (value: unknown) => unknown]]),
    ...slots('fromRhino', codes, [
      ['brep', (v) => rhino(v, types)],
    ]),
    ...optionSlots('fromRhino', (options) => rhino(brep, types, options), { tolerance: ['missing', ...kPositive] }),
    ...slots('fromOpenCascade', codes, [['shape', (v) => fromOpenCascade(v, v as never)]]),
  ];
}

/** Those of reading and writing files. */
export function fileSlots(): Slot[] {
  const format = formatLoops as (loops: unknown, format?: unknown) => string;
  const obj = formatObj as (surface: unknown, options?: unknown) => string;
  const parse = parseLoops as (data: unknown, options?: unknown) => unknown;
  return [
    ...slots('parseLoops', ['bad-file'], [['data', parse, [], /`data`|file|Line 1/]]),
    ...optionSlots('parseLoops', (options) => parse(kCurve, options), { format: ['missing'] }),
    ...slots('formatLoops', ['bad-loops', 'bad-starts', 'bad-option', 'not-finite', 'too-large'], [
      ['loops', format, ['empty array'], /`loops\b|Loop 0/],
      ['loops[0]', (v) => format([v]), ['empty array', 'Float32Array', 'Float64Array'], /`loops\b|Loop 0/],
      ['loops[0][0]', (v) => format([having(kLoop, 0, v)]), ['Float32Array', 'Float64Array'], /`loops`|Loop 0/],
      ['loops.positions', (v) => format({ ...kLoops, positions: v }), [], /\bpositions\b|\bstarts\b/],
      ['loops.starts', (v) => format({ ...kLoops, starts: v }), ['missing']],
      ['loops.name', (v) => format({ ...kLoops, name: v }, 'obj'), kText],
      ['format', (v) => format(kLoops, v), ['missing']],
    ]),
    ...slots('formatObj', ['bad-option', 'bad-starts', 'not-finite'], [
      ['surface', obj, []],
      ['surface.positions', (v) => obj({ ...kSurface, positions: v }), [], /\bpositions\b|\bsurface\.triangles\b/],
      ['surface.triangles', (v) => obj({ ...kSurface, triangles: v }), ['Uint32Array']],
      ['surface.loopVertices', (v) => obj({ ...kSurface, loopVertices: v }), ['missing'], /\bloopVertices\b|\bsurface\.starts\b/],
      ['surface.starts', (v) => obj({ ...kSurface, starts: v }), ['missing']],
    ]),
    ...optionSlots('formatObj', (options) => obj(kSurface, options), { name: kText, precision: ['missing'] }),
    ...meshFileSlots(),
  ];
}

function meshFileSlots(): Slot[] {
  const read = readMesh as (bytes: unknown, name?: unknown, options?: unknown) => Promise<unknown>;
  const write = writeMesh as (mesh: unknown, format: unknown, options?: unknown) => Promise<unknown>;
  const obj = new TextEncoder().encode('v 0 0 0\nf 1 1 1\n');
  const positions = new Float64Array(9);
  const faces = Uint32Array.of(0, 1, 2);
  const attribute = { data: new Float32Array(9), size: 3 };
  return [
    ...slots('readMesh', ['bad-file'], [['bytes', (v) => read(v), [], /`bytes`|file/]]),
    ...slots('readMesh', ['bad-option'], [['name', (v) => read(obj, v), kText]]),
    ...optionSlots('readMesh', (options) => read(obj, '', options), { seams: ['missing'] }),
    ...slots('writeMesh', ['bad-mesh', 'bad-attributes', 'bad-option', 'not-finite'], [
      ['mesh', (v) => write(v, 'ply')],
      ['mesh.positions', (v) => write({ positions: v, faces }, 'ply'), [], /\bpositions\b|Face 0 of `mesh`/],
      ['mesh.faces', (v) => write({ positions, faces: v }, 'ply'), ['Uint32Array']],
      ['mesh.attributes', (v) => write({ positions, faces, attributes: v }, 'ply'), kOptions],
      ['mesh.attributes.color', (v) => write({ positions, faces, attributes: { color: v } }, 'ply'), ['missing']],
      ['mesh.attributes.color.size', (v) => write({ positions, faces, attributes: { color: { ...attribute, size: v } } }, 'ply'), [], /\bcolor\b/],
      ['format', (v) => write({ positions, faces }, v)],
    ]),
    ...optionSlots('writeMesh', (options) => write({ positions, faces }, 'obj', options), { name: kText }),
  ];
}

/** Those of what loads the core, all of which has been loaded before: sources are not looked at again. */
export function loadSlots(): Slot[] {
  const sources: readonly Kind[] = ['missing', 'empty string', 'string', 'digits', ...kBytes];
  return (['load', 'createWorker'] as const).flatMap((name) => {
    const call = (name === 'load' ? load : createWorker) as (options: unknown) => Promise<unknown>;
    return [
      ...optionSlots(name, call, {
        parts: ['missing'],
        // What is no source may still be an object without fields.
        wasm: [...sources, 'empty object', 'SharedArrayBuffer', 'heir of Float64Array'],
        checks: kFlag,
        ...(name === 'createWorker' && { size: ['missing', '2^32 - 1', '2^32', '2^32 + 4'] as const }),
      }),
      ...slots(name, ['bad-option'], [
        ['parts[0]', (v) => call({ parts: [v] })],
        ['wasm.loops', (v) => call({ wasm: { loops: v } }), sources],
      ]),
    ];
  });
}

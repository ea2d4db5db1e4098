// Models as callers give them, in the two flat arrays that the core takes. Parts of a model are read once, and copied to the
// places of all their instances.
import { fieldsOf, guarded, isIndex, mustBe, show, viewOf, type Given, type Names } from './check.js';
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';
import { Growing } from './growing.js';
import { affineOf, type AffineMap } from './surface_map.js';
import type { EdgeUse, Face, FaceLoop, Model, ModelEdge, ModelFace, ModelInstance, NurbsCurve, NurbsSurface } from './surface_types.js';

/** A model as the core takes it: `wasm/src/surface/model.h` tells the order. */
export interface FlatModel {
  readonly shape: Uint32Array;
  readonly numbers: Float64Array;
  /**
   * Faces that cannot even be put into arrays, in order: the core gets stand-ins, which it leaves out. Last, those of edges
   * that no face uses, without a face.
   */
  readonly faults: readonly SoapfilmError[];
}

const kFaceFields: Names<ModelFace> = { id: true, surface: true, reversed: true, outer: true, loops: true };
const kSurfaceFields: Names<NurbsSurface> = {
  degreeU: true,
  degreeV: true,
  knotsU: true,
  knotsV: true,
  countU: true,
  countV: true,
  poles: true,
  weights: true,
  domain: true,
  closedU: true,
  closedV: true,
};
const kLoopFields: Names<FaceLoop> = { uses: true };
const kUseFields: Names<EdgeUse> = { edge: true, reversed: true, seam: true, pcurve: true };
const kEdgeFields: Names<ModelEdge> = { id: true, degenerate: true, tolerance: true, range: true, faces: true, curve3d: true };
const kCurveFields: Names<NurbsCurve> = { degree: true, knots: true, poles: true, weights: true, domain: true };
const kModelFields: Names<Pick<Model, 'faces' | 'edges' | 'instances' | 'parts'>> = { faces: true, edges: true, instances: true, parts: true };

/** How far a domain may be from what the knots say, of its length. */
const kDomainSlack = 1e-9;
/** Instances within instances multiply. */
const kMostPlaces = 1e6;

// Flags of edges, of faces and of uses.
const [kDegenerate, kWithCurve] = [1, 2];
const [kReversed, kUnusable] = [1, 2];
const [kSeam, kWithTrim] = [2, 4];

/**
 * @throws SoapfilmError `bad-model` if there are no lists of faces and edges to go through, or an instance is at fault;
 *   `out-of-memory`
 */
export function flattenModel(model: unknown): FlatModel {
  const places: Places = { all: [], parts: new Map(), path: [] };
  place(model, 'model', undefined, undefined, places);
  return assemble(places.all);
}

/** @throws SoapfilmError as `flattenModel` */
export function flattenFace(face: unknown): FlatModel {
  const { edges } = fieldsOf<Pick<Face, 'edges'>>(face, { edges: true }, 'face', 'bad-model');
  return assemble([{ part: new Part([face], listOf(edges ?? [], 'face.edges'), () => 'face', 'face.edges'), map: undefined, instance: undefined }]);
}

/** A part at one of its places. */
interface Placed {
  readonly part: Part;
  readonly map: AffineMap | undefined;
  /** Which instance of the model it belongs to, if to any. */
  readonly instance: number | undefined;
}

/** The places found so far. */
interface Places {
  readonly all: Placed[];
  /** The parts of models that have been read. */
  readonly parts: Map<unknown, Part>;
  /** The models that the one being read is an instance in. */
  readonly path: unknown[];
}

/** Appends the places of a model's own faces, then those of its instances. */
function place(model: unknown, title: string, map: AffineMap | undefined, instance: number | undefined, places: Places): void {
  const { all, parts: known, path } = places;
  if (path.includes(model)) throw bad(`\`${title}\` has itself among its instances`);
  if (all.length >= kMostPlaces) throw bad(`\`model\` has more than ${kMostPlaces} instances`, {}, undefined, 'too-large');
  const { faces, edges, instances, parts } = fieldsOf(model, kModelFields, title, 'bad-model');
  let part = known.get(model);
  if (!part) {
    // Models of instances alone have nothing of their own.
    const own = (list: unknown): unknown => (list === undefined && instances !== undefined ? [] : list);
    part = new Part(listOf(own(faces), `${title}.faces`), listOf(own(edges), `${title}.edges`), (face) => `${title}.faces[${face}]`, `${title}.edges`);
    known.set(model, part);
  }
  all.push({ part, map, instance });
  const list = instances === undefined ? [] : listOf(instances, `${title}.instances`);
  path.push(model);
  for (let i = 0; i < list.length; i++) {
    const name = `${title}.instances[${i}]`;
    const given = fieldsOf<ModelInstance>(list[i], { part: true, matrix: true }, name, 'bad-model');
    const own = given.matrix === undefined ? undefined : affineOf(given.matrix, `${name}.matrix`);
    const [inner, innerTitle] = partOf(given.part, parts, name, title);
    place(inner, innerTitle, own && map ? map.after(own) : (own ?? map), instance ?? i, places);
  }
  path.pop();
}

/** The model of an instance, and its name in messages. */
function partOf(part: unknown, parts: unknown, name: string, title: string): readonly [model: unknown, title: string] {
  if (typeof part !== 'string' && typeof part !== 'number') return [part, `${name}.part`];
  let found: unknown;
  try {
    if (typeof parts === 'object' && parts !== null && Object.hasOwn(parts, part)) found = (parts as Record<string, unknown>)[part];
  } catch (cause) {
    throw bad(`\`${title}.parts\` cannot be read`, {}, cause);
  }
  if (found === undefined) throw bad(`\`${name}.part\` is ${show(part)}, and \`${title}.parts\` has no such model`);
  return [found, `${title}.parts[${show(part)}]`];
}

function bad(message: string, place: ErrorPlace = {}, cause?: unknown, code: ErrorCode = 'bad-model'): SoapfilmError {
  return new SoapfilmError(code, message, place, cause === undefined ? undefined : { cause });
}

/**
 * The fields of a part of a model, to be read once each. Most are of plain objects, of which there are many: these are handed on
 * as they are, and what their getters throw is caught where the face or the edge is read.
 */
function fieldsIn<T extends object>(value: unknown, names: Names<T>, name: string): Given<T> {
  const isPlain = guarded('bad-model', name, () => typeof value === 'object' && value !== null && Object.getPrototypeOf(value) === Object.prototype);
  return isPlain ? (value as Given<T>) : fieldsOf<T>(value, names, name, 'bad-model');
}

/** The items of an array, each read once and at once; an array with gaps has none after the first. */
function listOf(value: unknown, name: string): readonly unknown[] {
  let items: unknown[] | undefined;
  try {
    if (Array.isArray(value)) {
      items = [];
      const { length } = value;
      for (let i = 0; i < length; i++) {
        const item: unknown = value[i];
        items.push(item);
        if (item === undefined) break;
      }
    }
  } catch (cause) {
    throw bad(`\`${name}\` cannot be read`, {}, cause);
  }
  if (items) return items;
  throw mustBe('bad-model', name, 'an array', value);
}

/** The arrays of a part, apart from the places that it gets in a model. */
class Part {
  readonly edges: number;
  readonly faces: number;
  readonly edgeShape = new Growing(new Uint32Array(64));
  readonly edgeNumbers = new Growing(new Float64Array(256));
  readonly faceShape = new Growing(new Uint32Array(64));
  readonly faceNumbers = new Growing(new Float64Array(256));
  /** Where poles in space begin and end in the numbers of edges, and of faces. */
  readonly edgePoles: number[] = [];
  readonly facePoles: number[] = [];
  /** Where the numbers have tolerances. */
  readonly tolerances: number[] = [];
  /** Where the shape of faces has flags of faces, and numbers of edges. */
  readonly flags: number[] = [];
  readonly edgeIndices: number[] = [];
  readonly faults: SoapfilmError[] = [];
  /** Faults of edges that no face uses. */
  readonly unusedFaults: SoapfilmError[] = [];
  /** The index of an edge, if its `id` is another. */
  readonly #byId: Map<unknown, number> | undefined;
  readonly #edgeFaults = new Map<number, SoapfilmError>();

  constructor(faces: readonly unknown[], edges: readonly unknown[], faceName: (face: number) => string, edgesName: string) {
    this.faces = faces.length;
    this.edges = edges.length;
    const ids: unknown[] = [];
    edges.forEach((edge, e) => {
      ids.push(this.#edge(edge, e, `${edgesName}[${e}]`));
    });
    if (ids.some((id, e) => id !== undefined && id !== e)) {
      this.#byId = new Map(ids.map((id, e) => [id, e]));
      if (this.#byId.size < ids.length || this.#byId.has(undefined)) throw bad(`\`${edgesName}\` must all have an \`id\` of their own, or none`);
    }
    const used = new Set<number>();
    faces.forEach((face, f) => {
      this.#face(face, f, faceName(f), used);
    });
    for (const [edge, error] of this.#edgeFaults) if (!used.has(edge)) this.unusedFaults.push(error);
  }

  /** Appends an edge; one at fault is kept by its error, and a stand-in appended. Returns its `id`. */
  #edge(edge: unknown, number: number, name: string): unknown {
    const { edgeShape: shape, edgeNumbers: numbers, edgePoles, tolerances } = this;
    const kept = [shape.length, numbers.length, edgePoles.length] as const;
    tolerances.push(numbers.length);
    let id: unknown;
    try {
      const given = fieldsIn<ModelEdge>(edge, kEdgeFields, name);
      const { degenerate, tolerance = 0, range, curve3d } = given;
      id = given.id;
      const curve = curve3d ?? undefined;
      const isDegenerate = flagIn(degenerate, `${name}.degenerate`);
      if (isDegenerate && curve !== undefined) throw bad(`\`${name}\` is degenerate, so its \`curve3d\` must be null`);
      shape.push((isDegenerate ? kDegenerate : 0) | (curve === undefined ? 0 : kWithCurve));
      numbers.push(numberIn(tolerance, `${name}.tolerance`));
      const [from, to] = pairIn(range, `${name}.range`);
      numbers.push(from);
      numbers.push(to);
      if (curve !== undefined) appendCurve(curve, `${name}.curve3d`, 3, shape, numbers, edgePoles);
    } catch (error) {
      this.#edgeFaults.set(number, faultOf(error, name, { edge: number }));
      [shape.length, numbers.length, edgePoles.length] = kept;
      shape.push(0);
      for (const x of [0, 0, 1]) numbers.push(x);
    }
    return id;
  }

  #face(face: unknown, number: number, name: string, used: Set<number>): void {
    const { faceShape: shape, faceNumbers: numbers, facePoles, edgeIndices } = this;
    const kept = [shape.length, numbers.length, facePoles.length, edgeIndices.length] as const;
    this.flags.push(shape.length);
    let at: ErrorPlace = { face: number };
    try {
      const { surface, reversed, outer, loops } = fieldsIn<ModelFace>(face, kFaceFields, name);
      const list = loops === undefined ? [] : listOf(loops, `${name}.loops`);
      shape.push(flagIn(reversed, `${name}.reversed`) ? kReversed : 0);
      this.#surface(surface, `${name}.surface`);
      if (outer !== undefined && !Number.isInteger(outer)) throw mustBe('bad-model', `${name}.outer`, 'the index of a loop, or -1', outer);
      const around = list.length === 0 ? -1 : outer === undefined ? 0 : (outer as number);
      // One that is not there is the core's to name.
      shape.push(around >= -1 && around < list.length ? around + 1 : list.length + 1);
      shape.push(list.length);
      for (let l = 0; l < list.length; l++) {
        at = { face: number, loop: l };
        const loopName = `${name}.loops[${l}]`;
        const { uses } = fieldsIn<FaceLoop>(list[l], kLoopFields, loopName);
        const usesIn = listOf(uses, `${loopName}.uses`);
        shape.push(usesIn.length);
        for (let u = 0; u < usesIn.length; u++) {
          at = { face: number, loop: l, use: u };
          this.#use(usesIn[u], `${loopName}.uses[${u}]`, at, used);
        }
      }
    } catch (error) {
      this.faults.push(faultOf(error, name, at));
      [shape.length, numbers.length, facePoles.length, edgeIndices.length] = kept;
      // Nothing but its flags: no poles, no knots, no loops.
      shape.push(kUnusable);
      for (let i = 0; i < 9; i++) shape.push(0);
    }
  }

  #surface(surface: unknown, name: string): void {
    const { faceShape: shape, faceNumbers: numbers, facePoles } = this;
    const given = fieldsIn<NurbsSurface>(surface, kSurfaceFields, name);
    const counts = (['U', 'V'] as const).map((side) => {
      const degree = countIn(given[`degree${side}`], `${name}.degree${side}`);
      const count = countIn(given[`count${side}`], `${name}.count${side}`);
      shape.push(degree);
      shape.push(count);
      const begin = numbers.length;
      const knots = appendNumbers(given[`knots${side}`], `${name}.knots${side}`, numbers);
      shape.push(knots);
      // The core says what is wrong with knots that do not reach as far.
      const at = (i: number): number => (i < knots ? numbers.at(begin + i) : NaN);
      return { count, from: at(degree), to: at(count) };
    });
    const [u, v] = counts;
    const poles = u.count * v.count;
    facePoles.push(numbers.length);
    appendPoles(given.poles, `${name}.poles`, 3, poles, `${u.count} · ${v.count}`, numbers);
    facePoles.push(numbers.length);
    shape.push(appendWeights(given.weights, `${name}.weights`, poles, numbers));
    if (given.domain !== undefined) checkDomain(given.domain, `${name}.domain`, [u.from, u.to, v.from, v.to]);
  }

  #use(use: unknown, name: string, place: ErrorPlace, used: Set<number>): void {
    const { faceShape: shape, faceNumbers: numbers } = this;
    const { edge, reversed, seam, pcurve } = fieldsIn<EdgeUse>(use, kUseFields, name);
    const index = this.#byId ? this.#byId.get(edge) : isIndex(edge) && edge < this.edges ? edge : undefined;
    if (index === undefined) {
      const named = typeof edge === 'number' ? { edge } : {};
      throw bad(`\`${name}.edge\` must be the number of an edge, and ${show(edge)} is none`, { ...place, ...named }, undefined, 'bad-edge');
    }
    used.add(index);
    const fault = this.#edgeFaults.get(index);
    if (fault) throw bad(fault.message, { ...place, edge: index }, fault.cause, fault.code);
    const curve = pcurve ?? undefined;
    this.edgeIndices.push(shape.length);
    shape.push(index);
    const flags = (flagIn(reversed, `${name}.reversed`) ? kReversed : 0) | (flagIn(seam, `${name}.seam`) ? kSeam : 0);
    shape.push(flags | (curve === undefined ? 0 : kWithTrim));
    if (curve !== undefined) appendCurve(curve, `${name}.pcurve`, 2, shape, numbers);
  }
}

/** What was thrown while a thing was read, with its place. */
function faultOf(error: unknown, name: string, place: ErrorPlace): SoapfilmError {
  if (!(error instanceof SoapfilmError)) return bad(`\`${name}\` cannot be read`, place, error);
  const { code, message, cause, edge } = error;
  return bad(message, { ...(edge !== undefined && { edge }), ...place }, cause, code);
}

/** Appends a curve. @param poles where its poles begin and end is appended to these, if given */
function appendCurve(curve: unknown, name: string, size: 2 | 3, shape: Growing<Uint32Array>, numbers: Growing<Float64Array>, poles?: number[]): void {
  const { degree, knots, poles: given, weights, domain } = fieldsIn<NurbsCurve>(curve, kCurveFields, name);
  const p = countIn(degree, `${name}.degree`);
  const list = listOf(given, `${name}.poles`);
  shape.push(p);
  shape.push(list.length);
  // That of a trimming curve comes before its knots, and may be left out.
  const domainAt = numbers.length;
  if (size === 2) for (let i = 0; i < 2; i++) numbers.push(0);
  const begin = numbers.length;
  const count = appendNumbers(knots, `${name}.knots`, numbers);
  shape.push(count);
  const at = (i: number): number => (i < count ? numbers.at(begin + i) : NaN);
  const ends = [at(p), at(list.length)] as const;
  if (size === 2) {
    const [from, to] = domain === undefined ? ends : pairIn(domain, `${name}.domain`);
    numbers.set(domainAt, from);
    numbers.set(domainAt + 1, to);
  } else if (domain !== undefined) {
    checkDomain(domain, `${name}.domain`, ends);
  }
  poles?.push(numbers.length);
  appendPoles(list, `${name}.poles`, size, list.length, '', numbers);
  poles?.push(numbers.length);
  shape.push(appendWeights(weights, `${name}.weights`, list.length, numbers));
}

/** Appends numbers, null as NaN. Returns how many. */
function appendNumbers(list: unknown, name: string, numbers: Growing<Float64Array>): number {
  const begin = numbers.length;
  try {
    const floats = viewOf(['Float64Array', 'Float32Array'], list);
    if (floats) for (const x of floats) numbers.push(x);
    else if (!Array.isArray(list)) throw mustBe('bad-model', name, 'an array of numbers', list);
    else for (let i = 0; i < list.length; i++) numbers.push(numberIn(list[i], name, i));
  } catch (cause) {
    if (cause instanceof SoapfilmError) throw cause;
    throw bad(`\`${name}\` cannot be read`, {}, cause);
  }
  return numbers.length - begin;
}

/** @param more says in messages where their count comes from */
function appendPoles(list: unknown, name: string, size: 2 | 3, count: number, more: string, numbers: Growing<Float64Array>): void {
  const poles = listOf(list, name);
  if (poles.length !== count) throw bad(`\`${name}\` must be ${count} = ${more} poles, not ${poles.length}`);
  for (let i = 0; i < count; i++) {
    const pole = poles[i];
    // Most are plain, and for them this is quicker.
    if (Array.isArray(pole) && pole.length === size) {
      for (let k = 0; k < size; k++) {
        const x: unknown = pole[k];
        numbers.push(typeof x === 'number' ? x : numberIn(x, `${name}[${i}]`, k));
      }
      continue;
    }
    if (appendNumbers(pole, `${name}[${i}]`, numbers) === size) continue;
    throw mustBe('bad-model', `${name}[${i}]`, size === 2 ? '[u, v]' : '[x, y, z]', pole);
  }
}

/** Appends weights, if there are any. Returns whether there are. */
function appendWeights(list: unknown, name: string, count: number, numbers: Growing<Float64Array>): 0 | 1 {
  if (list === undefined || list === null) return 0;
  const found = appendNumbers(list, name, numbers);
  if (found === count) return 1;
  throw bad(`\`${name}\` must be as many as there are poles, ${count}, not ${found}`, {}, undefined, 'bad-weights');
}

function checkDomain(given: unknown, name: string, ends: readonly number[]): void {
  const domain = new Growing(new Float64Array(ends.length));
  const count = appendNumbers(given, name, domain);
  if (count !== ends.length) throw bad(`\`${name}\` must be ${ends.length} numbers, not ${count}`);
  for (let i = 0; i < count; i++) {
    const slack = kDomainSlack * Math.abs(ends[i - (i % 2) + 1] - ends[i - (i % 2)]);
    // Where knots do not reach as far, or are none, the core says so.
    if (!(Math.abs(domain.at(i) - ends[i]) > slack)) continue;
    throw bad(`\`${name}\` must be what the knots say, ${ends.join(', ')}`, {}, undefined, 'bad-domain');
  }
}

function pairIn(value: unknown, name: string): readonly [from: number, to: number] {
  const pair = new Growing(new Float64Array(2));
  if (appendNumbers(value, name, pair) === 2) return [pair.at(0), pair.at(1)];
  throw mustBe('bad-model', name, 'two numbers', value);
}

/** @param index if the number is one of a list of that name */
function numberIn(value: unknown, name: string, index?: number): number {
  if (typeof value === 'number') return value;
  if (value === null) return NaN;
  throw mustBe('bad-model', index === undefined ? name : `${name}[${index}]`, 'a number', value);
}

function countIn(value: unknown, name: string): number {
  if (isIndex(value)) return value;
  throw mustBe('bad-model', name, 'a whole number and not negative', value);
}

function flagIn(value: unknown, name: string): boolean {
  if (value === undefined || typeof value === 'boolean') return value === true;
  throw mustBe('bad-model', name, 'true or false', value);
}

/** All parts at their places, one after the other. */
function assemble(all: readonly Placed[]): FlatModel {
  const sum = (count: (part: Part) => number): number => all.reduce((total, { part }) => total + count(part), 0);
  const faces = sum((part) => part.faces);
  const edges = sum((part) => part.edges);
  const { shape, numbers } = allocate(
    2 + sum((part) => part.edgeShape.length + part.faceShape.length),
    sum((part) => part.edgeNumbers.length + part.faceNumbers.length),
  );
  shape[0] = faces;
  shape[1] = edges;
  let [shapeAt, numberAt, firstEdge, firstFace] = [2, 0, 0, 0];
  for (const { part, map } of all) {
    part.edgeShape.copyTo(shape, shapeAt);
    part.edgeNumbers.copyTo(numbers, numberAt);
    if (map) {
      for (const at of part.tolerances) numbers[numberAt + at] *= map.stretch;
      map.move(numbers, numberAt, part.edgePoles);
    }
    shapeAt += part.edgeShape.length;
    numberAt += part.edgeNumbers.length;
  }
  const faults: SoapfilmError[] = [];
  const unused: SoapfilmError[] = [];
  for (const { part, map, instance } of all) {
    part.faceShape.copyTo(shape, shapeAt);
    part.faceNumbers.copyTo(numbers, numberAt);
    for (const at of part.edgeIndices) shape[shapeAt + at] += firstEdge;
    if (map) map.move(numbers, numberAt, part.facePoles);
    if (map?.mirrors) for (const at of part.flags) shape[shapeAt + at] ^= kReversed;
    for (const error of part.faults) faults.push(moved(error, firstFace, firstEdge, instance));
    for (const error of part.unusedFaults) unused.push(moved(error, firstFace, firstEdge, instance));
    shapeAt += part.faceShape.length;
    numberAt += part.faceNumbers.length;
    firstEdge += part.edges;
    firstFace += part.faces;
  }
  return { shape, numbers, faults: [...faults, ...unused] };
}

/** An error of a part at one of its places. */
function moved(error: SoapfilmError, firstFace: number, firstEdge: number, instance: number | undefined): SoapfilmError {
  const { face, loop, use, edge } = error;
  const place: ErrorPlace = {
    ...(face !== undefined && { face: firstFace + face }),
    ...(loop !== undefined && { loop }),
    ...(use !== undefined && { use }),
    ...(edge !== undefined && { edge: firstEdge + edge }),
  };
  return bad(instance === undefined ? error.message : `Instance ${instance}: ${error.message}`, place, error.cause, error.code);
}

function allocate(shapes: number, numbers: number): { shape: Uint32Array; numbers: Float64Array } {
  try {
    return { shape: new Uint32Array(shapes), numbers: new Float64Array(numbers) };
  } catch (cause) {
    throw new SoapfilmError('out-of-memory', 'The model does not fit into memory', undefined, { cause });
  }
}


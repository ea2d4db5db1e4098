// Meshes by formulas, with regions cut out of them, and what a filled mesh has to be.
import type { FillResult, MeshLike, Point } from 'soapfilm';
import { expect } from 'vitest';
import { cross, dot, subtract, type Random } from './generators.ts';

export interface Mesh {
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
}

/** A point of three numbers in a list. */
export const toPoint = ([x, y, z]: readonly number[]): Point => [x, y, z];

const triples = (list: ArrayLike<number>): [number, number, number][] =>
  Array.from({ length: list.length / 3 }, (_, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]]);

export const pointOf = ({ positions }: MeshLike, vertex: number): Point => triples(positions.subarray(3 * vertex, 3 * vertex + 3))[0];

/** Points of a map over a grid of nu × nv cells; `closed` joins the ends of each direction. */
function grid(nu: number, nv: number, [closedU, closedV]: readonly [boolean, boolean], at: (u: number, v: number) => Point): Mesh {
  const [columns, rows] = [closedU ? nu : nu + 1, closedV ? nv : nv + 1];
  const positions: Point[] = [];
  for (let j = 0; j < rows; j++) for (let i = 0; i < columns; i++) positions.push(at(i / nu, j / nv));
  const faces: number[] = [];
  for (let j = 0; j < nv; j++) {
    for (let i = 0; i < nu; i++) {
      const vertex = (du: number, dv: number) => ((j + dv) % rows) * columns + ((i + du) % columns);
      const [a, b, c, d] = [vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)];
      // Diagonals take turns, so that no direction is preferred.
      faces.push(...((i + j) % 2 === 0 ? [a, b, c, a, c, d] : [a, b, d, b, c, d]));
    }
  }
  return { positions: Float64Array.from(positions.flat()), faces: Uint32Array.from(faces) };
}

const kTurn = 2 * Math.PI;

/** A torus about the z axis. */
export const torus = (nu: number, nv: number, R = 1, r = 0.4): Mesh =>
  grid(nu, nv, [true, true], (u, v) => {
    const across = R + r * Math.cos(kTurn * v);
    return [across * Math.cos(kTurn * u), across * Math.sin(kTurn * u), r * Math.sin(kTurn * v)];
  });

/** An open tube about the z axis, of radius 1. */
export const tube = (nu: number, nv: number, height = 4): Mesh =>
  grid(nu, nv, [true, false], (u, v) => [Math.cos(kTurn * u), Math.sin(kTurn * u), height * (v - 0.5)]);

/** A sheet z = f(x, y) over the square from -1 to 1. */
export const sheet = (n: number, f: (x: number, y: number) => number): Mesh =>
  grid(n, n, [false, false], (u, v) => [2 * u - 1, 2 * v - 1, f(2 * u - 1, 2 * v - 1)]);

export const saddle = (n: number): Mesh => sheet(n, (x, y) => 0.4 * (x * x - y * y));

/** A Möbius band. */
export function moebius(n: number): Mesh {
  const { positions, faces } = grid(n, 2, [false, false], (u, v) => {
    const [s, t] = [kTurn * u, 0.6 * (v - 0.5)];
    const across = 1 + t * Math.cos(s / 2);
    return [across * Math.cos(s), across * Math.sin(s), t * Math.sin(s / 2)];
  });
  // The last column is the first, upside down.
  return compact({ positions, faces: faces.map((v) => (v % (n + 1) === n ? (n + 1) * (2 - Math.floor(v / (n + 1))) : v)) });
}

/** A sphere of radius 1: an icosahedron, each face parted into n². */
export function sphere(n: number): Mesh {
  const g = (1 + Math.sqrt(5)) / 2;
  const corners: Point[] = [-1, 1].flatMap((s) => [-g, g].flatMap((t): Point[] => [[0, s, t], [s, t, 0], [t, 0, s]]));
  const near = (a: Point, b: Point) => Math.abs(dot(subtract(a, b), subtract(a, b)) - 4) < 1e-9;
  const parts: [Point, Point, Point][] = [];
  corners.forEach((a, i) => {
    for (let j = i + 1; j < 12; j++) {
      for (let k = j + 1; k < 12; k++) {
        const [b, c] = [corners[j], corners[k]];
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        parts.push(dot(cross(subtract(b, a), subtract(c, a)), a) > 0 ? [a, b, c] : [a, c, b]);
      }
    }
  });
  return welded(
    parts.flatMap((corner) =>
      subdivided(n).map((triangle) =>
        triangle.map((share): Point => {
          const p = mix(corner, share);
          return toPoint(p.map((x) => x / Math.hypot(...p)));
        }),
      ),
    ),
  );
}

const mix = (corners: readonly Point[], share: readonly number[]): Point =>
  toPoint([0, 1, 2].map((axis) => corners.reduce((sum, corner, i) => sum + share[i] * corner[axis], 0)));

/** Barycentric corners of the n² parts of a triangle. */
function subdivided(n: number): number[][][] {
  const at = (i: number, j: number) => [(n - i - j) / n, i / n, j / n];
  const found: number[][][] = [];
  for (let j = 0; j < n; j++) {
    for (let i = 0; i + j < n; i++) {
      found.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
      if (i + j + 1 < n) found.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  }
  return found;
}

/** The cube from -1 to 1, each side of n × n squares. */
export function box(n: number): Mesh {
  const sides = [-1, 1].flatMap((side) =>
    [0, 1, 2].map((axis) =>
      grid(n, n, [false, false], (u, v) => {
        const p = [0, 0, 0];
        p[axis] = side;
        p[(axis + 1) % 3] = (2 * u - 1) * side;
        p[(axis + 2) % 3] = 2 * v - 1;
        return toPoint(p);
      }),
    ),
  );
  return welded(sides.flatMap((side) => triples(side.faces).map((face) => face.map((v) => pointOf(side, v)))));
}

/** A mesh of single triangles, vertices that agree to ten digits made one. */
export function welded(triangles: readonly (readonly Point[])[]): Mesh {
  const numbers = new Map<string, number>();
  const positions: number[] = [];
  const faces = triangles.flatMap((corners) =>
    corners.map((p) => {
      const key = p.map((x) => (x + 0).toFixed(10).replace(/^-(0\.0+)$/, '$1')).join();
      const known = numbers.get(key);
      if (known !== undefined) return known;
      numbers.set(key, positions.push(...p) / 3 - 1);
      return numbers.size - 1;
    }),
  );
  return { positions: Float64Array.from(positions), faces: Uint32Array.from(faces) };
}

/** Without the vertices that no face has. */
export function compact({ positions, faces }: Mesh): Mesh {
  const used = [...new Set(faces)].sort((a, b) => a - b);
  const number = new Map(used.map((v, i) => [v, i]));
  return {
    positions: Float64Array.from(used.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)])),
    faces: faces.map((v) => number.get(v) as number),
  };
}

/** The mesh without the faces whose middle is in a region. */
export function cut(mesh: Mesh, isGone: (middle: Point, face: number) => boolean): Mesh {
  const kept = triples(mesh.faces).filter((face, f) => !isGone(mix(face.map((v) => pointOf(mesh, v)), [1 / 3, 1 / 3, 1 / 3]), f));
  return compact({ positions: mesh.positions, faces: Uint32Array.from(kept.flat()) });
}

/** Both meshes in one. */
export const together = (...meshes: readonly Mesh[]): Mesh => ({
  positions: Float64Array.from(meshes.flatMap(({ positions }) => [...positions])),
  faces: Uint32Array.from(
    meshes.flatMap(({ faces }, i) => {
      const first = meshes.slice(0, i).reduce((sum, { positions }) => sum + positions.length / 3, 0);
      return [...faces].map((v) => v + first);
    }),
  ),
});

/** The other way out. */
export const turned = ({ positions, faces }: Mesh): Mesh => ({
  positions,
  faces: Uint32Array.from(triples(faces).flatMap(([a, b, c]) => [a, c, b])),
});

export function shaken({ positions, faces }: Mesh, amount: number, random: Random): Mesh {
  return { positions: positions.map((x) => x + random.range(-amount, amount)), faces };
}

export const near = (middle: Point, point: Point, radius: number): boolean =>
  Math.hypot(...subtract(middle, point)) < radius;

/** How many triangles have each directed edge. */
export function directedEdges(faces: Uint32Array): Map<string, number> {
  const found = new Map<string, number>();
  faces.forEach((a, h) => {
    const edge = `${a} ${faces[h - (h % 3) + ((h + 1) % 3)]}`;
    found.set(edge, (found.get(edge) ?? 0) + 1);
  });
  return found;
}

/** Directed edges that are there more than once, or lack their opposite. */
export function openEdges(faces: Uint32Array): string[] {
  const edges = directedEdges(faces);
  return [...edges].filter(([edge, count]) => count > 1 || !edges.has(edge.split(' ').reverse().join(' '))).map(([edge]) => edge);
}

/** V - E + F, of vertices that faces have. */
export function euler(faces: Uint32Array): number {
  const edges = new Set<string>();
  for (const edge of directedEdges(faces).keys()) {
    const [a, b] = edge.split(' ').map(Number);
    edges.add(a < b ? `${a} ${b}` : `${b} ${a}`);
  }
  return new Set(faces).size - edges.size + faces.length / 3;
}

/** Expects every vertex that was given, and every face, to be there as before. */
export function expectKeeps(given: MeshLike, { mesh, oldVertices, oldFaces }: FillResult): void {
  expect(oldVertices).toBe(given.positions.length / 3);
  expect(oldFaces).toBe(given.faces.length / 3);
  const bytes = (array: ArrayBufferView, length = array.byteLength) => Buffer.from(array.buffer, array.byteOffset, length);
  expect(bytes(mesh.positions, given.positions.byteLength).equals(bytes(given.positions))).toBe(true);
  expect(bytes(mesh.faces, given.faces.byteLength).equals(bytes(given.faces))).toBe(true);
}

/** Expects a filled mesh to be closed and of one orientation, with that Euler number, its holes as they are told. */
export function expectClosed(given: MeshLike, result: FillResult, eulerNumber: number): void {
  expectKeeps(given, result);
  expect(result.holes.map(({ status }) => status)).toEqual(result.holes.map(() => 'filled'));
  expect(result.closed).toBe(true);
  expect(openEdges(result.mesh.faces)).toEqual([]);
  expect(euler(result.mesh.faces)).toBe(eulerNumber);
  expectRanges(result);
}

/** Expects the holes' faces to follow each other from the old ones to the end, with vertices of the old or their own. */
export function expectRanges({ mesh, oldVertices, oldFaces, holes }: FillResult): void {
  const ranges = holes.map(({ faces }) => faces).filter(([from, to]) => to > from);
  let at = oldFaces;
  for (const [from, to] of ranges) {
    expect(from).toBe(at);
    at = to;
  }
  expect(mesh.faces.length / 3).toBe(at);
  const count = mesh.positions.length / 3;
  expect(mesh.faces.every((v) => v < count)).toBe(true);
  const added = new Set(mesh.faces.subarray(3 * oldFaces));
  for (let v = oldVertices; v < count; v++) expect(added.has(v)).toBe(true);
  expect(mesh.positions.every(Number.isFinite)).toBe(true);
}

/** Whether the segment pq passes through the triangle's inside, by more than rounding. */
function pierces(p: Point, q: Point, [a, b, c]: readonly Point[]): boolean {
  const kLeast = 1e-9;
  const normal = cross(subtract(b, a), subtract(c, a));
  const size = Math.hypot(...normal);
  if (size === 0) return false;
  const [above, below] = [dot(subtract(p, a), normal) / size, dot(subtract(q, a), normal) / size];
  if (!(above > kLeast && below < -kLeast) && !(above < -kLeast && below > kLeast)) return false;
  const t = above / (above - below);
  const x = toPoint(p.map((v, i) => v + t * (q[i] - v)));
  const inside = (s: Point, e: Point) => dot(cross(subtract(e, s), subtract(x, s)), normal) / (size * Math.hypot(...subtract(e, s)));
  return Math.min(inside(a, b), inside(b, c), inside(c, a)) > kLeast;
}

/** All pairs of faces, one of them new, that pass through each other; by brute force. */
export function crossings({ mesh, oldFaces }: Pick<FillResult, 'mesh' | 'oldFaces'>): [number, number][] {
  const faces = triples(mesh.faces);
  const corners = faces.map((face) => face.map((v) => pointOf(mesh, v)));
  const boxes = corners.map((points) => [0, 1, 2].map((axis) => points.map((p) => p[axis])).map((x) => [Math.min(...x), Math.max(...x)]));
  const found: [number, number][] = [];
  for (let f = oldFaces; f < faces.length; f++) {
    for (let g = 0; g < f; g++) {
      if (boxes[f].some(([low, high], axis) => low > boxes[g][axis][1] || high < boxes[g][axis][0])) continue;
      // An edge that has a vertex of the other triangle cannot pass through its inside but in that plane.
      const edges = (of: number, other: number) =>
        faces[of].some((v, k) => {
          const w = faces[of][(k + 1) % 3];
          if (faces[other].includes(v) || faces[other].includes(w)) return false;
          return pierces(corners[of][k], corners[of][(k + 1) % 3], corners[other]);
        });
      if (edges(f, g) || edges(g, f)) found.push([g, f]);
    }
  }
  return found;
}

const areaOf = ([a, b, c]: readonly Point[]): number => Math.hypot(...cross(subtract(b, a), subtract(c, a))) / 2;

/** Root mean square of a distance over the new faces: their corners and middles, weighted by area. */
export function rmsOfNew({ mesh, oldFaces }: FillResult, distance: (p: Point) => number): number {
  let [sum, weight] = [0, 0];
  for (const face of triples(mesh.faces.subarray(3 * oldFaces))) {
    const corners = face.map((v) => pointOf(mesh, v));
    const area = areaOf(corners);
    const all = [...corners, mix(corners, [1 / 3, 1 / 3, 1 / 3])];
    sum += (area * all.reduce((s, p) => s + distance(p) ** 2, 0)) / all.length;
    weight += area;
  }
  return Math.sqrt(sum / weight);
}

export const areaOfNew = ({ mesh, oldFaces }: FillResult): number =>
  triples(mesh.faces.subarray(3 * oldFaces)).reduce((sum, face) => sum + areaOf(face.map((v) => pointOf(mesh, v))), 0);

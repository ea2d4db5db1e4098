// Faces of more than three vertices as triangles: fans, but ears where a fan would leave the face. Not by earcut, which
// leaves out vertices on straight edges: the mesh would have cracks there.
import type { Growing } from './growing.js';

/** Puts a polygon's vertices as a fan, one by one; notes those that may have to be cut in another way. */
export class FaceBuilder {
  /** Pairs: where a polygon of more than three vertices begins in `faces`, and how many it has. */
  private readonly polygons: number[] = [];
  private first = 0;
  private before = 0;
  private count = 0;

  constructor(private readonly faces: Growing<Uint32Array>) {}

  add(vertex: number): void {
    this.count++;
    if (this.count === 1) this.first = vertex;
    if (this.count > 2) {
      this.faces.push(this.first);
      this.faces.push(this.before);
      this.faces.push(vertex);
    }
    this.before = vertex;
  }

  /** Ends the polygon. Returns how many vertices it has. */
  end(): number {
    const { count } = this;
    if (count > 3) this.polygons.push(this.faces.length - 3 * (count - 2), count);
    this.count = 0;
    return count;
  }

  /** Cuts anew what is not convex. The vertices must be there. */
  cut(faces: Uint32Array, positions: Float32Array | Float64Array): void {
    for (let i = 0; i < this.polygons.length; i += 2) cutPolygon(faces, this.polygons[i], this.polygons[i + 1], positions);
  }
}

/** A polygon in a plane that it is seen in counter-clockwise. */
interface Flat {
  readonly x: Float64Array;
  readonly y: Float64Array;
}

/** Twice the area of a triangle, positive if it runs counter-clockwise. */
const areaOf = ({ x, y }: Flat, a: number, b: number, c: number): number =>
  (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]);

function cutPolygon(faces: Uint32Array, from: number, n: number, positions: Float32Array | Float64Array): void {
  const vertices = Uint32Array.from({ length: n }, (_, i) => (i < 2 ? faces[from + i] : faces[from + 3 * (i - 2) + 2]));
  const flat = flattened(vertices, positions);
  let isConvex = true;
  for (let i = 0; i < n && isConvex; i++) isConvex = areaOf(flat, i, (i + 1) % n, (i + 2) % n) > 0;
  if (isConvex) return;
  const triangles = earsOf(flat);
  for (let i = 0; i < triangles.length; i++) faces[from + i] = vertices[triangles[i]];
}

/** The vertices without the axis along which the polygon has the most area, by Newell's normal. */
function flattened(vertices: Uint32Array, positions: Float32Array | Float64Array): Flat {
  const n = vertices.length;
  const along = (axis: number): Float64Array => Float64Array.from(vertices, (v) => positions[3 * v + axis] - positions[3 * vertices[0] + axis]);
  const axes = [along(0), along(1), along(2)];
  const normal = axes.map((_, axis) => {
    const [u, v] = [axes[(axis + 1) % 3], axes[(axis + 2) % 3]];
    let sum = 0;
    for (let i = 0; i < n; i++) sum += u[i] * v[(i + 1) % n] - u[(i + 1) % n] * v[i];
    return sum;
  });
  const sizes = normal.map(Math.abs);
  const axis = sizes.indexOf(Math.max(...sizes));
  const [x, y] = [axes[(axis + 1) % 3], axes[(axis + 2) % 3]];
  return normal[axis] < 0 ? { x: y, y: x } : { x, y };
}

/** `[3(n - 2)]` the polygon as triangles, whatever it is: where no vertex is an ear, the one that turns most is taken for one. */
function earsOf(flat: Flat): number[] {
  const n = flat.x.length;
  const next = Uint32Array.from({ length: n }, (_, i) => (i + 1) % n);
  const before = Uint32Array.from({ length: n }, (_, i) => (i + n - 1) % n);
  const triangles: number[] = [];
  const areaAt = (i: number): number => areaOf(flat, before[i], i, next[i]);
  /** What does not bend to the left may lie in an ear. */
  const isEar = (i: number): boolean => {
    const [a, c] = [before[i], next[i]];
    for (let k = next[c]; k !== a; k = next[k]) {
      if (areaAt(k) <= 0 && isInside(flat, k, a, i, c)) return false;
    }
    return true;
  };
  let at = 0;
  for (let left = n; left > 2; left--) {
    let [ear, most] = [at, -Infinity];
    let i = at;
    for (let tried = 0; tried < left; tried++, i = next[i]) {
      const area = areaAt(i);
      if (area > 0 && isEar(i)) {
        ear = i;
        break;
      }
      if (area > most) [ear, most] = [i, area];
    }
    triangles.push(before[ear], ear, next[ear]);
    next[before[ear]] = next[ear];
    before[next[ear]] = before[ear];
    // Not the next one: ears all round are better triangles than a fan.
    at = next[next[ear]];
  }
  return triangles;
}

/** Whether a vertex is in a triangle or at its edge; not where it is at the place of a corner. */
function isInside(flat: Flat, k: number, a: number, b: number, c: number): boolean {
  const isAt = (i: number): boolean => flat.x[i] === flat.x[k] && flat.y[i] === flat.y[k];
  if (isAt(a) || isAt(b) || isAt(c)) return false;
  return areaOf(flat, a, b, k) >= 0 && areaOf(flat, b, c, k) >= 0 && areaOf(flat, c, a, k) >= 0;
}

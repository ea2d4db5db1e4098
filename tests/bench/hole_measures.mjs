// What patches are measured by: distances to another surface, pairs of faces that cross, angles along rims.

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export const cornersOf = ({ positions, faces }, f) =>
  [0, 1, 2].map((k) => [0, 1, 2].map((axis) => positions[3 * faces[3 * f + k] + axis]));

/** The square of the distance from a point to a triangle (Ericson 2005, sec. 5.1.5). */
function squareTo(p, [a, b, c]) {
  const [ab, ac, ap] = [minus(b, a), minus(c, a), minus(p, a)];
  const square = (s, t) => {
    const d = [0, 1, 2].map((i) => ap[i] - s * ab[i] - t * ac[i]);
    return dot(d, d);
  };
  const [d1, d2] = [dot(ab, ap), dot(ac, ap)];
  if (d1 <= 0 && d2 <= 0) return square(0, 0);
  const bp = minus(p, b);
  const [d3, d4] = [dot(ab, bp), dot(ac, bp)];
  if (d3 >= 0 && d4 <= d3) return square(1, 0);
  const vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return square(d1 / (d1 - d3), 0);
  const cp = minus(p, c);
  const [d5, d6] = [dot(ab, cp), dot(ac, cp)];
  if (d6 >= 0 && d5 <= d6) return square(0, 1);
  const vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return square(0, d2 / (d2 - d6));
  const va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const t = (d4 - d3) / (d4 - d3 + d5 - d6);
    return square(1 - t, t);
  }
  const sum = va + vb + vc;
  return sum === 0 ? square(0, 0) : square(vb / sum, vc / sum);
}

/** A tree of boxes over some faces of a mesh. */
export class Tree {
  constructor(mesh, from = 0, to = mesh.faces.length / 3) {
    this.corners = Array.from({ length: to - from }, (_, i) => cornersOf(mesh, from + i));
    this.boxes = this.corners.map((points) => {
      const [x, y, z] = [0, 1, 2].map((axis) => points.map((p) => p[axis]));
      return [Math.min(...x), Math.min(...y), Math.min(...z), Math.max(...x), Math.max(...y), Math.max(...z)];
    });
    this.from = from;
    this.root = to > from ? this.#build(Array.from(this.corners.keys())) : undefined;
  }

  #build(items) {
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const i of items) {
      for (let k = 0; k < 3; k++) {
        box[k] = Math.min(box[k], this.boxes[i][k]);
        box[k + 3] = Math.max(box[k + 3], this.boxes[i][k + 3]);
      }
    }
    if (items.length <= 4) return { box, items };
    const sizes = [0, 1, 2].map((k) => box[k + 3] - box[k]);
    const axis = sizes.indexOf(Math.max(...sizes));
    items.sort((a, b) => this.boxes[a][axis] + this.boxes[a][axis + 3] - this.boxes[b][axis] - this.boxes[b][axis + 3]);
    const half = items.length >> 1;
    return { box, children: [this.#build(items.slice(0, half)), this.#build(items.slice(half))] };
  }

  squareTo(p) {
    const away = ({ box }) =>
      [0, 1, 2].reduce((sum, k) => sum + Math.max(box[k] - p[k], 0, p[k] - box[k + 3]) ** 2, 0);
    let best = Infinity;
    const visit = (node) => {
      if (node.items) {
        for (const i of node.items) best = Math.min(best, squareTo(p, this.corners[i]));
        return;
      }
      const [first, second] = node.children.map((child) => [away(child), child]).sort((a, b) => a[0] - b[0]);
      if (first[0] < best) visit(first[1]);
      if (second[0] < best) visit(second[1]);
    };
    if (this.root) visit(this.root);
    return best;
  }

  /** Calls `found` with each face whose box meets that one. */
  overlapping(box, found) {
    const meets = (other) => [0, 1, 2].every((k) => other[k] <= box[k + 3] && box[k] <= other[k + 3]);
    const visit = (node) => {
      if (!meets(node.box)) return;
      if (node.children) return node.children.forEach(visit);
      for (const i of node.items) if (meets(this.boxes[i])) found(this.from + i);
    };
    if (this.root) visit(this.root);
  }
}

/** Points on some faces, uniform by area; the same ones each time. */
export function samples(mesh, from, to, count) {
  const areas = [];
  let total = 0;
  for (let f = from; f < to; f++) {
    const [a, b, c] = cornersOf(mesh, f);
    areas.push((total += Math.hypot(...cross(minus(b, a), minus(c, a))) / 2));
  }
  if (!(total > 0)) return [];
  const points = [];
  let f = 0;
  for (let i = 0; i < count; i++) {
    while (f < areas.length - 1 && areas[f] < ((i + 0.5) / count) * total) f++;
    // Two irrational steps: even in a face.
    let [s, t] = [(i * 0.7548776662466927) % 1, (i * 0.5698402909980532) % 1];
    if (s + t > 1) [s, t] = [1 - s, 1 - t];
    const [a, b, c] = cornersOf(mesh, from + f);
    points.push([0, 1, 2].map((k) => a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k])));
  }
  return points;
}

const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;

/** Root mean square of the distance, both ways, between the faces of a patch and others. */
export function rmsBetween(filled, from, reference, count = 6000) {
  const to = filled.faces.length / 3;
  const last = reference.faces.length / 3;
  if (to === from) return Infinity;
  const [patch, other] = [new Tree(filled, from, to), new Tree(reference)];
  const there = samples(filled, from, to, count).map((p) => other.squareTo(p));
  const back = samples(reference, 0, last, count).map((p) => patch.squareTo(p));
  return Math.sqrt(mean([...there, ...back]));
}

/** Whether the segment pq passes through the triangle's inside, by more than rounding. */
function pierces(p, q, [a, b, c]) {
  const normal = cross(minus(b, a), minus(c, a));
  const size = Math.hypot(...normal);
  if (size === 0) return false;
  const least = 1e-9 * Math.sqrt(size);
  const [above, below] = [dot(minus(p, a), normal) / size, dot(minus(q, a), normal) / size];
  if (!(above > least && below < -least) && !(above < -least && below > least)) return false;
  const t = above / (above - below);
  const x = p.map((v, i) => v + t * (q[i] - v));
  const inside = (s, e) => dot(cross(minus(e, s), minus(x, s)), normal) / (size * Math.hypot(...minus(e, s)));
  return Math.min(inside(a, b), inside(b, c), inside(c, a)) > least;
}

/** How many pairs of faces, one from `from` on, pass through each other. */
export function countCrossings(mesh, from) {
  const tree = new Tree(mesh);
  const face = (f) => [...mesh.faces.subarray(3 * f, 3 * f + 3)];
  let count = 0;
  for (let f = from; f < mesh.faces.length / 3; f++) {
    tree.overlapping(tree.boxes[f], (g) => {
      if (g >= f) return;
      const meets = (of, other) =>
        face(of).some((v, k, all) => {
          if (face(other).includes(v) || face(other).includes(all[(k + 1) % 3])) return false;
          return pierces(tree.corners[of][k], tree.corners[of][(k + 1) % 3], tree.corners[other]);
        });
      if (meets(f, g) || meets(g, f)) count++;
    });
  }
  return count;
}

/** Mean angle in degrees between new and old faces along edges that both have. */
export function rimAngle(mesh, oldFaces) {
  const n = mesh.positions.length / 3;
  const normal = (f) => {
    const [a, b, c] = cornersOf(mesh, f);
    return cross(minus(b, a), minus(c, a));
  };
  const old = new Map();
  const angles = [];
  for (let h = 0; h < mesh.faces.length; h++) {
    const [f, a, b] = [Math.floor(h / 3), mesh.faces[h], mesh.faces[h - (h % 3) + ((h + 1) % 3)]];
    if (f < oldFaces) old.set(a * n + b, f);
    else if (old.has(b * n + a)) {
      const [p, q] = [normal(f), normal(old.get(b * n + a))];
      angles.push((Math.atan2(Math.hypot(...cross(p, q)), dot(p, q)) * 180) / Math.PI);
    }
  }
  return mean(angles);
}

/** Directed edges without an opposite, and V - E + F over vertices that faces have. */
export function topology({ positions, faces }) {
  const n = positions.length / 3;
  const edges = new Set();
  let repeated = 0;
  for (let h = 0; h < faces.length; h++) {
    const key = faces[h] * n + faces[h - (h % 3) + ((h + 1) % 3)];
    if (edges.has(key)) repeated++;
    edges.add(key);
  }
  let open = 0;
  for (const key of edges) if (!edges.has((key % n) * n + Math.floor(key / n))) open++;
  const pairs = (edges.size - open) / 2 + open;
  return { open, repeated, euler: new Set(faces).size - pairs + faces.length / 3 };
}

// Loops to test and to measure with. Down to noisyCircle the same generators, fed by the same random
// numbers, as in tests/cpp/support/generators.h.
import type { LoopSet, Point } from 'soapfilm';

export type Loop = Point[];

/** Uniform numbers from a 32-bit xorshift (Marsaglia 2003), alike on every machine. */
export class Random {
  private state: number;

  constructor(seed: number) {
    this.state = (Math.imul(seed, 2654435769) + 0x6d2b79f5) | 0 || 1;
    for (let i = 0; i < 8; i++) this.bits();
  }
  bits(): number {
    this.state ^= this.state << 13;
    this.state ^= this.state >>> 17;
    this.state ^= this.state << 5;
    return this.state >>> 0;
  }
  below(n: number): number {
    return Math.floor((this.bits() * n) / 2 ** 32);
  }
  unit(): number {
    return this.bits() / 2 ** 32;
  }
  range(low: number, high: number): number {
    return low + (high - low) * this.unit();
  }
  chance(p: number): boolean {
    return this.unit() < p;
  }
  inCube(half: number): Point {
    return [this.range(-half, half), this.range(-half, half), this.range(-half, half)];
  }
  direction(): Point {
    for (;;) {
      const p = this.inCube(1);
      const r = Math.hypot(...p);
      if (r > 0.1 && r <= 1) return scale(1 / r, p);
    }
  }
}

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (s: number, a: Point): Point => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Nested loops as flat arrays. */
export function loopSet(loops: readonly Loop[]): LoopSet {
  const starts = [0];
  for (const loop of loops) starts.push(starts[starts.length - 1] + loop.length);
  return {
    positions: Float64Array.from(loops.flat(2)),
    starts: Uint32Array.from(starts),
  };
}

const steps = (n: number, phase = 0): number[] =>
  Array.from({ length: n }, (_, i) => (2 * Math.PI * (i + phase)) / n);

export interface CircleOptions {
  r?: number;
  centre?: Point;
  /** Unit vector across the circle's plane. */
  axis?: Point;
}

/** n points at equal angles on a circle. */
export function circle(
  n: number,
  { r = 1, centre = [0, 0, 0], axis = [0, 0, 1] }: CircleOptions = {},
): Loop {
  const side: Point = Math.abs(axis[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const across = subtract(side, scale(dot(side, axis), axis));
  const u = scale(1 / Math.hypot(...across), across);
  const v = cross(axis, u);
  return steps(n).map((t) =>
    add(centre, scale(r, add(scale(Math.cos(t), u), scale(Math.sin(t), v)))),
  );
}

/** (cos t, sin t, cos(3t) / 2) at n equal steps. */
export const monkeySaddle = (n: number): Loop =>
  steps(n).map((t): Point => [Math.cos(t), Math.sin(t), Math.cos(3 * t) / 2]);

/** Rotation of p by an angle about a unit axis. */
export function rotate(p: Point, axis: Point, angle: number): Point {
  const along = scale(dot(axis, p), axis);
  const turned = add(
    scale(Math.cos(angle), subtract(p, along)),
    scale(Math.sin(angle), cross(axis, p)),
  );
  return add(along, turned);
}

const kOctahedron: readonly Point[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
  [-1, 0, 0],
  [0, -1, 0],
  [0, 0, -1],
];

/** The saddle curve (r cos t, r sin t, h cos 2t) about `axis`, its crests along `crest` (both unit,
 * perpendicular), at distance 1 from the origin, turned and moved a little. */
function saddleAt(axis: Point, crest: Point, r: number, n: number, random: Random): Loop {
  const v = cross(axis, crest);
  const tilt = random.direction();
  const angle = random.range(-0.2, 0.2);
  const centre = add(axis, random.inCube(0.05));
  return steps(n, 0.5).map((t) => {
    const inPlane = scale(r, add(scale(Math.cos(t), crest), scale(Math.sin(t), v)));
    const p = add(inPlane, scale(0.3 * r * Math.cos(2 * t), axis));
    return add(centre, rotate(p, tilt, angle));
  });
}

/** k (at most 6) saddle curves facing outward at the corners of a regular octahedron, each turned
 * and moved a little. The poses depend on `random` alone: not on n, nor on how many there are. */
export const regularSaddles = (k: number, n: number, random: Random): Loop[] =>
  kOctahedron
    .slice(0, k)
    .map((axis, c) => saddleAt(axis, kOctahedron[(c + 1) % 3], 0.5, n, random));

/** Loops of random points in unit cubes, each moved by `apart` along a direction of its own. */
export const randomLoops = (sizes: readonly number[], apart: number, random: Random): Loop[] =>
  sizes.map((size) => {
    const centre = scale(apart, random.direction());
    return Array.from({ length: size }, () => add(centre, random.inCube(0.5)));
  });

/** A circle whose points are moved by up to `noise`. */
export const noisyCircle = (n: number, noise: number, random: Random): Loop =>
  circle(n).map((p) => add(p, random.inCube(noise)));

/** Each point moved by up to `noise` mean edge lengths. */
export function withNoise(loop: Loop, noise: number, random: Random): Loop {
  const length = (p: Point, i: number): number =>
    Math.hypot(...subtract(loop[(i + 1) % loop.length], p));
  const mean = loop.reduce((sum, p, i) => sum + length(p, i), 0) / loop.length;
  return loop.map((p) => add(p, random.inCube(noise * mean)));
}

/** A smooth closed curve: a sum of `harmonics` random waves, the higher ones the smaller. */
export function harmonicLoop(n: number, harmonics: number, random: Random): Loop {
  const waves = Array.from({ length: harmonics }, (_, h): [Point, Point] => [
    scale(1 / (h + 1), random.inCube(1)),
    scale(1 / (h + 1), random.inCube(1)),
  ]);
  return Array.from({ length: n }, (_, i) => {
    const t = (2 * Math.PI * i) / n;
    return waves.reduce<Point>(
      (p, [a, b], h) =>
        add(p, add(scale(Math.cos((h + 1) * t), a), scale(Math.sin((h + 1) * t), b))),
      [0, 0, 0],
    );
  });
}

/** A random walk of unit steps that ends where it began. */
export function closedWalk(n: number, random: Random): Loop {
  const steps = Array.from({ length: n }, () => random.direction());
  const drift = scale(1 / n, steps.reduce(add));
  let p: Point = [0, 0, 0];
  return steps.map((step) => (p = add(p, subtract(step, drift))));
}

const unit = (a: Point): Point => scale(1 / Math.hypot(...a), a);

/** k saddle curves facing outward at the corners of a cube (k ≤ 8) or an icosahedron (k ≤ 12), as
 * far apart for their size as those of `regularSaddles`. */
export function manySaddles(k: number, n: number, random: Random): Loop[] {
  const cube = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z): Point => [x, y, z])));
  const corners = (k <= 8 ? cube : icosahedron().positions).map(unit);
  const others = corners.slice(1).map((p) => Math.hypot(...subtract(p, corners[0])));
  const r = 0.5 * (Math.min(...others) / Math.SQRT2);
  return corners.slice(0, k).map((axis) => {
    const side: Point = Math.abs(axis[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0];
    return saddleAt(axis, unit(cross(axis, side)), r, n, random);
  });
}

/** A closed triangle mesh. */
export interface Mesh {
  readonly positions: readonly Point[];
  /** `[3f]` vertex indices, wound outward. */
  readonly faces: readonly number[];
}

function icosahedron(): Mesh {
  const g = (1 + Math.sqrt(5)) / 2;
  const positions = [-1, 1].flatMap((s) =>
    [-g, g].flatMap((t): Point[] => [unit([0, s, t]), unit([s, t, 0]), unit([t, 0, s])]),
  );
  const edge = (2 / Math.hypot(1, g)) * 1.01;
  const near = (a: number, b: number): boolean =>
    Math.hypot(...subtract(positions[a], positions[b])) < edge;
  const faces: number[] = [];
  // The faces are the triples of mutually nearest corners.
  for (let a = 0; a < 12; a++) {
    for (let b = a + 1; b < 12; b++) {
      for (let c = b + 1; c < 12; c++) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const [p, q, r] = [positions[a], positions[b], positions[c]];
        const outward = dot(cross(subtract(q, p), subtract(r, p)), p) > 0;
        faces.push(a, outward ? b : c, outward ? c : b);
      }
    }
  }
  return { positions, faces };
}

/** Each face in four, the new vertices on the unit sphere. */
function refined(mesh: Mesh): Mesh {
  const positions = [...mesh.positions];
  const middles = new Map<number, number>();
  const middle = (a: number, b: number): number => {
    const key = Math.min(a, b) * mesh.positions.length + Math.max(a, b);
    let index = middles.get(key);
    if (index === undefined) {
      index = positions.push(unit(add(positions[a], positions[b]))) - 1;
      middles.set(key, index);
    }
    return index;
  };
  const faces: number[] = [];
  for (let i = 0; i < mesh.faces.length; i += 3) {
    const [a, b, c] = mesh.faces.slice(i, i + 3);
    const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    faces.push(a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca);
  }
  return { positions, faces };
}

/** A bumpy closed surface: an icosahedron divided `levels` times, 20·4^levels faces, its radius
 * waved at random and its vertices moved by up to 0.3 of an edge along each axis. */
export function closedSurface(levels: number, random: Random): Mesh {
  let mesh = icosahedron();
  for (let i = 0; i < levels; i++) mesh = refined(mesh);
  const waves = Array.from({ length: 12 }, () => ({
    along: scale(random.range(1.5, 5), random.direction()),
    phase: random.range(0, 2 * Math.PI),
  }));
  const jitter = 0.3 * (1.05 / 2 ** levels);
  const positions = mesh.positions.map((p) => {
    const height = waves.reduce((sum, w) => sum + Math.cos(dot(w.along, p) + w.phase), 0);
    return add(scale(1 + 0.07 * height, p), random.inCube(jitter));
  });
  return { positions, faces: mesh.faces };
}

/** A disc of a mesh's faces that grows over its rim, and stays a disc with a simple rim. */
class Disc {
  readonly rim: number[];
  private readonly taken: Set<number>;
  private readonly inside: Set<number>;

  /** Begins as one face. `taken`: vertices that are not to be used. */
  constructor(
    private readonly apexOf: ReadonlyMap<number, readonly [face: number, apex: number]>,
    private readonly stride: number,
    corners: readonly number[],
    face: number,
    taken: ReadonlySet<number>,
  ) {
    this.rim = [...corners];
    this.taken = new Set([...taken, ...corners]);
    this.inside = new Set([face]);
  }

  /** Adds the face across rim edge i, unless the rim would touch itself. */
  grow(i: number): void {
    const { rim } = this;
    const n = rim.length;
    const across = this.apexOf.get(rim[(i + 1) % n] * this.stride + rim[i]);
    if (!across || this.inside.has(across[0])) return;
    const [face, apex] = across;
    if (!this.taken.has(apex)) {
      rim.splice(i + 1, 0, apex);
      this.taken.add(apex);
    } else if (n > 3 && rim[(i + 2) % n] === apex) {
      rim.splice((i + 1) % n, 1);
    } else if (n > 3 && rim[(i + n - 1) % n] === apex) {
      rim.splice(i, 1);
    } else {
      return;
    }
    this.inside.add(face);
  }
}

/** Disjoint simple loops along the mesh's edges, of the numbers of vertices asked for: the rims of
 * discs that grew at random. */
export function meshLoops(mesh: Mesh, sizes: readonly number[], random: Random): Loop[] {
  const stride = mesh.positions.length;
  const apexOf = new Map<number, readonly [number, number]>();
  mesh.faces.forEach((a, i) => {
    const first = i - (i % 3);
    const b = mesh.faces[first + ((i + 1) % 3)];
    apexOf.set(a * stride + b, [first, mesh.faces[first + ((i + 2) % 3)]]);
  });
  const used = new Set<number>();
  return sizes.map((size) => {
    for (let attempt = 0; attempt < 1000; attempt++) {
      const face = 3 * random.below(mesh.faces.length / 3);
      const corners = mesh.faces.slice(face, face + 3);
      if (corners.some((v) => used.has(v))) continue;
      const disc = new Disc(apexOf, stride, corners, face, used);
      for (let tries = 0; tries < 40 * size && disc.rim.length !== size; tries++) {
        disc.grow(random.below(disc.rim.length));
      }
      if (disc.rim.length !== size) continue;
      disc.rim.forEach((v) => used.add(v));
      return disc.rim.map((v) => mesh.positions[v]);
    }
    throw new Error(`no room for a loop of ${size} vertices`);
  });
}

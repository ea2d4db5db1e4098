// Minimal surfaces that are known by formulas, for soap films on their boundaries: what films are tested and measured
// against. Each has its boundary as `loops` of points that are on it exactly, a `radius`, `options` by which films have
// about 5 000 triangles, and `distance(x, y, z)` of a point from it, to first order.
const kTurn = 2 * Math.PI;

const around = (n, point) => Array.from({ length: n }, (_, i) => point((kTurn * i) / n));

/** r = c cosh(z / c) between two rings of radius 1; of the two values of c the larger. */
function catenoid(height = 0.8, n = 256) {
  let [low, high] = [0.6, 1];
  for (let i = 0; i < 60; i++) {
    const c = (low + high) / 2;
    if (c * Math.cosh(height / 2 / c) < 1) low = c;
    else high = c;
  }
  const ring = (z) => around(n, (t) => [Math.cos(t), Math.sin(t), z]);
  const slope = (z) => Math.sinh(z / low);
  return {
    name: 'catenoid',
    loops: [ring(-height / 2), ring(height / 2)],
    radius: 1,
    options: { maxNewVertices: 2450 },
    distance: (x, y, z) => Math.abs(Math.hypot(x, y) - low * Math.cosh(z / low)) / Math.hypot(1, slope(z)),
  };
}

/** Scherk's first surface, e^z cos y = cos x, over a square of nine tenths of the one where it ends. */
function scherk(half = (0.9 * Math.PI) / 2, side = 64) {
  const height = (x, y) => Math.log(Math.cos(x) / Math.cos(y));
  // Evenly along the curve, whose length from the middle is the inverse of this function of Gudermann's.
  const end = Math.asinh(Math.tan(half));
  const along = Array.from({ length: side }, (_, i) => 2 * Math.atan(Math.tanh((end * ((2 * i) / side - 1)) / 2)));
  const square = [
    ...along.map((s) => [s, -half]),
    ...along.map((s) => [half, s]),
    ...along.map((s) => [-s, half]),
    ...along.map((s) => [-half, -s]),
  ];
  return {
    name: 'Scherk',
    loops: [square.map(([x, y]) => [x, y, height(x, y)])],
    radius: half,
    options: { density: 0.8 },
    distance: (x, y, z) => {
      const [cx, cy, ez] = [Math.cos(x), Math.cos(y), Math.exp(z)];
      return Math.abs(ez * cy - cx) / Math.hypot(Math.sin(x), ez * Math.sin(y), ez * cy);
    },
  };
}

/** Enneper's surface up to a radius of its parameters u, v. */
function enneper(radius = 0.8, n = 256) {
  const at = (u, v) => [u - u ** 3 / 3 + u * v * v, -v + v ** 3 / 3 - v * u * u, u * u - v * v];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return {
    name: 'Enneper',
    loops: [around(n, (t) => at(radius * Math.cos(t), radius * Math.sin(t)))],
    radius,
    options: { density: 0.7 },
    // The nearest point by Newton's method; the parameters are conformal.
    distance: (x, y, z) => {
      let [u, v] = [x, -y];
      const off = () => at(u, v).map((c, k) => c - [x, y, z][k]);
      for (let i = 0; i < 30; i++) {
        const [d, du, dv] = [off(), [1 - u * u + v * v, -2 * u * v, 2 * u], [2 * u * v, -1 + v * v - u * u, -2 * v]];
        const l = dot(du, du);
        u -= dot(d, du) / l;
        v -= dot(d, dv) / l;
      }
      return Math.hypot(...off());
    },
  };
}

export const minimalSurfaces = [catenoid(), scherk(), enneper()];

/** The largest distance of a smoothed surface's free vertices from what they should be on, in radii. */
export function farthest({ positions, boundary }, { distance, radius }) {
  let most = 0;
  for (let i = 3 * boundary.length; i < positions.length; i += 3) {
    most = Math.max(most, distance(positions[i], positions[i + 1], positions[i + 2]));
  }
  return most / radius;
}

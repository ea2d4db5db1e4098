// Angles, degrees and strips of triangulations.

/** Mean over all triangles of the smallest angle, in degrees; triangles without area count as 0. */
export function angles(positions, triangles) {
  let sum = 0;
  const m = triangles.length / 3;
  for (let t = 0; t < m; t++) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const v = triangles[3 * t + k];
      return [positions[2 * v], positions[2 * v + 1]];
    });
    sum += Math.min(angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b));
  }
  return { angle: ((sum / m) * 180) / Math.PI };
}

function angleAt(a, b, c) {
  const [ux, uy, vx, vy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
  return Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy));
}

/** The largest number of triangles at a vertex. */
export function maximumDegree(triangles) {
  const counts = new Map();
  for (const v of triangles) counts.set(v, (counts.get(v) ?? 0) + 1);
  return Math.max(...counts.values());
}

/** The mean smallest angle of the triangles that the strips are made of. */
export function degrees(positions, points, triangles) {
  const all = points ? Float64Array.from([...positions, ...points.flat()]) : positions;
  return angles(all, triangles);
}

/**
 * How many strips a greedy stripifier makes: each begins at a triangle with the fewest free neighbours
 * and goes on both ways, left and right in turn, as long as it can; the longest of the three
 * beginnings is taken.
 */
export function greedyStrips(triangles) {
  const m = triangles.length / 3;
  const byEdge = new Map();
  const key = (u, v) => u * 2 ** 26 + v;
  for (let h = 0; h < 3 * m; h++) {
    byEdge.set(key(triangles[h], triangles[h - (h % 3) + ((h + 1) % 3)]), h);
  }
  const twins = Array.from(triangles, (u, h) => byEdge.get(key(triangles[h - (h % 3) + ((h + 1) % 3)], u)));
  const taken = new Uint8Array(m);
  const freeNeighbours = (t) =>
    [0, 1, 2].filter((k) => twins[3 * t + k] !== undefined && !taken[Math.floor(twins[3 * t + k] / 3)]).length;
  const next = (h) => h - (h % 3) + ((h + 1) % 3);
  const previous = (h) => h - (h % 3) + ((h + 2) % 3);
  /** Adds the triangles passed from half-edge h on, left and right in turn. */
  const walk = (strip, h, turnsLeft) => {
    for (let twin = twins[h]; twin !== undefined; twin = twins[h], turnsLeft = !turnsLeft) {
      const t = Math.floor(twin / 3);
      if (taken[t] || strip.has(t)) return;
      strip.add(t);
      h = turnsLeft ? next(twin) : previous(twin);
    }
  };
  let strips = 0;
  let left = m;
  while (left > 0) {
    let start = -1;
    let fewest = 4;
    for (let t = 0; t < m && fewest > 0; t++) {
      if (taken[t]) continue;
      const free = freeNeighbours(t);
      if (free < fewest) [start, fewest] = [t, free];
    }
    let best = new Set();
    for (const h of [3 * start, 3 * start + 1, 3 * start + 2]) {
      for (const turnsLeft of [true, false]) {
        const strip = new Set([start]);
        walk(strip, h, turnsLeft);
        walk(strip, turnsLeft ? next(h) : previous(h), !turnsLeft);
        if (strip.size > best.size) best = strip;
      }
    }
    for (const t of best) taken[t] = 1;
    left -= best.size;
    strips++;
  }
  return strips;
}

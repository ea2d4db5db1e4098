/** Where points are. */
export interface Places {
  /** `[3k]` the places, each as the first point there has it, in the order of these points. */
  readonly positions: Float32Array;
  /** `[n]` the place of each point. */
  readonly placeOf: Uint32Array;
}

/** Points at the same place have one; zeros of either sign are the same. @param points `[3n]` */
export function placesOf(points: Float32Array): Places {
  const n = points.length / 3;
  const bits = new Uint32Array(points.buffer, points.byteOffset, points.length);
  const kMinusZero = 0x80000000;
  let size = 1;
  while (size < 2 * n) size *= 2;
  // A table of places: 1 more than the number, 0 for none.
  const table = new Uint32Array(size);
  const firsts = new Uint32Array(n);
  const placeOf = new Uint32Array(n);
  let count = 0;
  const bitsAt = (i: number): number => (bits[i] === kMinusZero ? 0 : bits[i]);
  for (let i = 0; i < n; i++) {
    const [x, y, z] = [bitsAt(3 * i), bitsAt(3 * i + 1), bitsAt(3 * i + 2)];
    let slot = (Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35)) >>> 0;
    slot = (slot ^ (slot >>> 15)) & (size - 1);
    for (; table[slot] !== 0; slot = (slot + 1) & (size - 1)) {
      const first = 3 * firsts[table[slot] - 1];
      if (bitsAt(first) === x && bitsAt(first + 1) === y && bitsAt(first + 2) === z) break;
    }
    if (table[slot] === 0) {
      firsts[count] = i;
      table[slot] = ++count;
    }
    placeOf[i] = table[slot] - 1;
  }
  const positions = new Float32Array(3 * count);
  for (let k = 0; k < count; k++) {
    for (let axis = 0; axis < 3; axis++) positions[3 * k + axis] = points[3 * firsts[k] + axis];
  }
  return { positions, placeOf };
}

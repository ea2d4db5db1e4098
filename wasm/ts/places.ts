/** Where points are. */
export interface Places {
  /** `[size k]` the places, each as the first point there has it, in the order of these points. */
  readonly positions: Float32Array;
  /** `[n]` the place of each point. */
  readonly placeOf: Uint32Array;
}

const kMinusZero = 0x80000000;

/** Points at the same place have one; zeros of either sign are the same. @param points `[size n]` */
export function placesOf(points: Float32Array, size: number): Places {
  const n = points.length / size;
  const bits = new Uint32Array(points.buffer, points.byteOffset, points.length);
  let slots = 1;
  while (slots < 2 * n) slots *= 2;
  // A table of places: 1 more than the number, 0 for none.
  const table = new Uint32Array(slots);
  const firsts = new Uint32Array(n);
  const placeOf = new Uint32Array(n);
  let count = 0;
  const bitsAt = (i: number): number => (bits[i] === kMinusZero ? 0 : bits[i]);
  const isSame = (a: number, b: number): boolean => {
    for (let k = 0; k < size; k++) if (bitsAt(size * a + k) !== bitsAt(size * b + k)) return false;
    return true;
  };
  for (let i = 0; i < n; i++) {
    let hash = 0;
    for (let k = 0; k < size; k++) {
      hash = Math.imul(hash ^ bitsAt(size * i + k), 0x9e3779b1);
      hash ^= hash >>> 15;
    }
    let slot = hash & (slots - 1);
    while (table[slot] !== 0 && !isSame(i, firsts[table[slot] - 1])) slot = (slot + 1) & (slots - 1);
    if (table[slot] === 0) {
      firsts[count] = i;
      table[slot] = ++count;
    }
    placeOf[i] = table[slot] - 1;
  }
  const positions = new Float32Array(size * count);
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < size; k++) positions[size * i + k] = points[size * firsts[i] + k];
  }
  return { positions, placeOf };
}

// Weights as the core's settings have them, for loops and for holes.
import type { Weights } from './types.js';

export function coreWeights(weights: Weights | undefined) {
  // NaN: the core sets the default, which depends on the size of the loops or of the hole.
  const { area = 0, perimeter = 0, dihedral = 0 } = weights ?? { area: NaN, dihedral: 1 };
  return { areaWeight: area, perimeterWeight: perimeter, dihedralWeight: dihedral };
}

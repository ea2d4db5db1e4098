// smoothSurface: its options, checked, and its result. The caller's half: threads do without.
import { kSurfaceKindChoices, readSmoothNumbers, type SmoothArrays } from './border.js';
import { amountOf, choiceOf, type Given } from './check.js';
import type { SmoothWork } from './compute_smooth.js';
import { limitsOf } from './options.js';
import type { SmoothOptions, SmoothSurface } from './types.js';

/** The options, checked, as the core takes them. @throws SoapfilmError `bad-option` */
export function smoothWorkOf(given: Given<SmoothOptions>): SmoothWork {
  const { kind, density = Math.SQRT2, maxNewVertices = Infinity } = given;
  return {
    ...limitsOf(given),
    settings: {
      kind: kSurfaceKindChoices.indexOf(choiceOf('kind', kSurfaceKindChoices, kind)),
      density: amountOf('density', density, 100),
      maxNewVertices: amountOf('maxNewVertices', maxNewVertices),
    },
  };
}

/** The surface from the core's arrays. */
export function smoothOf({ positions, triangles, boundary, collapsed, numbers }: SmoothArrays): SmoothSurface {
  const { area, isMinimal } = readSmoothNumbers(numbers);
  return { positions, triangles, boundary, collapsed, area, isMinimal: isMinimal === 1 };
}

// smoothSurface: its options, checked, and its result. The caller's half: threads do without.
import { kSurfaceKindChoices, readSmoothNumbers, type SmoothArrays } from './border.js';
import { amountOf, arrayOf, choiceOf, guarded, viewOf, type Given } from './check.js';
import type { FlatMesh } from './compute_holes.js';
import type { SmoothWork } from './compute_smooth.js';
import { SoapfilmError } from './errors.js';
import { indicesOf, listenerOf } from './hole_input.js';
import { limitsOf } from './options.js';
import type { SmoothOptions, SmoothSurface } from './types.js';

/**
 * The options, checked, as the core takes them.
 * @param surface the one that they are for
 * @param own whether arrays must be copies, not views of the caller's
 * @throws SoapfilmError `bad-option`, `bad-normals`
 */
export function smoothWorkOf(given: Given<SmoothOptions>, { positions }: FlatMesh, own: boolean): SmoothWork {
  const { kind: name, density = Math.SQRT2, maxNewVertices = Infinity, fixed, boundaryNormals } = given;
  const kind = choiceOf('kind', kSurfaceKindChoices, name);
  if (boundaryNormals !== undefined && kind === 'soap-film') {
    const text = "`boundaryNormals` are for the kinds 'thin-plate' and 'curvature': a soap film leaves its boundary as it will";
    throw new SoapfilmError('bad-option', text);
  }
  return {
    ...limitsOf(given),
    settings: {
      kind: kSurfaceKindChoices.indexOf(kind),
      density: amountOf('density', density, 100),
      maxNewVertices: amountOf('maxNewVertices', maxNewVertices),
    },
    fixed: fixed === undefined ? new Uint32Array() : fixedOf(fixed, positions.length / 3),
    boundaryNormals: boundaryNormals === undefined ? undefined : normalsOf(boundaryNormals, own),
    ...listenerOf(given),
  };
}

function normalsOf(value: unknown, own: boolean): Float64Array {
  const what = 'three numbers for each edge of the boundary';
  return arrayOf('Float64Array', value, own, 'bad-normals', 'boundaryNormals', what, (length) => length % 3 === 0);
}

/** Different numbers of vertices, of which there are `count`, as a copy. */
function fixedOf(value: unknown, count: number): Uint32Array {
  const view = guarded('bad-option', 'fixed', () => viewOf(['Uint32Array'], value));
  const list = Uint32Array.from(indicesOf('fixed', view ? Array.from(view) : value));
  const wrong = list.findIndex((vertex) => vertex >= count);
  if (wrong < 0) return list;
  throw new SoapfilmError('bad-option', `\`fixed[${wrong}]\` is vertex ${list[wrong]}, and there are ${count}`);
}

/** The surface from the core's arrays. */
export function smoothOf({ positions, triangles, boundary, fixed, collapsed, numbers }: SmoothArrays): SmoothSurface {
  const { area, isMinimal } = readSmoothNumbers(numbers);
  return { positions, triangles, boundary, fixed, collapsed, area, isMinimal: isMinimal === 1 };
}

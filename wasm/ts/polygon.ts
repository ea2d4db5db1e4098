// triangulatePolygon and triangulatePolygons: polygons in one of their forms, made flat for the core.
import {
  kFloodActionChoices,
  kFloodStepLength,
  packPolygonSettings,
  readFloodStep,
  readPolygonArrays,
  readPolygonFault,
  kPolygonFaultLength,
} from './border.js';
import { optionsOf } from './check.js';
import type { SoapfilmError } from './errors.js';
import { ringError } from './messages.js';
import { kDefaultMemoryBytes, kPolygonOptions, kPolygonsOptions } from './options.js';
import { checkTogether, type FlatPolygons, flattenBatch, flattenPolygon, kChoices, polygonOptionsOf } from './polygon_input.js';
import { callCore, shared } from './runtime.js';
import type {
  FloodStep,
  PolygonLike,
  PolygonOptions,
  PolygonsLike,
  PolygonsOptions,
  PolygonsTriangulation,
  PolygonTriangulation,
} from './types.js';


/**
 * Triangulates a polygon with holes, in the plane or in space: the triangles lie inside it and cover
 * it exactly, with all its vertices and no others. O(n log n).
 *
 * @throws SoapfilmError `not-loaded`; `bad-polygon`, `bad-starts`, `bad-option`; `not-finite`,
 *   `degenerate`, `self-intersecting`, `holes-overlap`, `hole-outside`, `nested-hole` with the rings,
 *   vertices and the point at fault, unless `repair` is set; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
 */
export function triangulatePolygon(
  polygon: PolygonLike,
  options: PolygonOptions = {},
): PolygonTriangulation {
  const { triangles, strips, stripStarts, added, addedOn, trace } = triangulate(
    flattenPolygon(polygon),
    polygonOptionsOf(optionsOf<PolygonOptions>(options, kPolygonOptions)),
    false,
  );
  return { triangles, strips, stripStarts, added, addedOn, trace };
}

/**
 * Triangulates many polygons in one call of the core, which is far quicker for small ones.
 *
 * @param polygons flat arrays, or an array of polygons, each an array of rings
 * @throws SoapfilmError as `triangulatePolygon`, for the first invalid polygon, with its number as
 *   `polygon`; nothing for invalid polygons with `skipInvalid`
 */
export function triangulatePolygons(
  polygons: PolygonsLike,
  options: PolygonsOptions = {},
): PolygonsTriangulation {
  const flat = flattenBatch(polygons);
  return triangulate(flat, polygonOptionsOf(optionsOf(options, kPolygonsOptions)), true);
}

/**
 * Triangulates what has been checked; the error of the first invalid polygon is thrown unless these are
 * skipped.
 */
export function triangulate(
  polygons: FlatPolygons,
  options: PolygonsOptions,
  several: boolean,
): PolygonsTriangulation {
  checkTogether(polygons, options);
  const { verify = false, trace = false, borrow, maxSeconds, skipInvalid } = options;
  const { positions, ringStarts, polygonStarts, points, dim } = polygons;
  const chosen = (name: keyof typeof kChoices): number =>
    Math.max(0, (kChoices[name] as readonly unknown[]).indexOf(options[name]));
  const settings = packPolygonSettings({
    dimension: dim,
    method: chosen('method'),
    repair: chosen('repair'),
    delaunay: chosen('quality'),
    strips: chosen('output'),
    verify: Number(verify),
    trace: Number(trace),
    maxBytes: options.maxMemoryBytes ?? kDefaultMemoryBytes,
  });
  const { arrays } = callCore(
    shared.polygons,
    'sf_triangulate_polygons',
    [
      positions,
      ringStarts,
      ringStarts.length - 1,
      polygonStarts,
      polygonStarts.length - 1,
      points ?? null,
      points ? points.length / dim : 0,
      settings,
    ],
    readPolygonArrays,
    { maxSeconds, borrows: borrow, explain: ringError },
  );
  const { triangles, triangleStarts, strips, stripStarts, polygonStrips, added, addedOn } = arrays;
  const { faults, faultPoints } = arrays;
  const errors: SoapfilmError[] = [];
  for (let i = 0; kPolygonFaultLength * i < faults.length; i++) {
    const fault = readPolygonFault(faults, kPolygonFaultLength * i);
    const point = Array.from(faultPoints.subarray(dim * i, dim * i + dim));
    const error = ringError(fault.status, fault, {
      ...(several && { polygon: fault.polygon }),
      ...(!Number.isNaN(point[0]) && { point }),
    });
    if (!skipInvalid) throw error;
    errors.push(error);
  }
  return {
    triangles,
    strips,
    stripStarts,
    added,
    addedOn,
    trace: readTrace(arrays.trace),
    triangleStarts,
    polygonStrips,
    errors,
  };
}

function readTrace(steps: Uint32Array): FloodStep[] {
  return Array.from({ length: steps.length / kFloodStepLength }, (_, i) => {
    const { action, ...step } = readFloodStep(steps, kFloodStepLength * i);
    return { action: kFloodActionChoices[action], ...step };
  });
}

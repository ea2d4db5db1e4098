// Triangulations, once the arguments are checked: makes the core's settings from them, and results from the
// core's arrays. Threads need only this half.
import {
  kFloodActionChoices,
  kFloodStepLength,
  kPolygonFaultLength,
  packPolygonSettings,
  readFloodStep,
  readPolygonArrays,
  readPolygonFault,
} from './border.js';
import type { SoapfilmError } from './errors.js';
import { kChoices, type FlatPolygons } from './flat_polygons.js';
import { ringError } from './messages.js';
import { callCore, kDefaultMemoryBytes, shared } from './runtime.js';
import type { FloodStep, PolygonsOptions, PolygonsTriangulation, PolygonTriangulation } from './types.js';

/**
 * Triangulates checked polygons. Throws the error of the first invalid one, unless these are skipped.
 * @param several whether errors say which polygon they are about
 */
export function computePolygons(
  polygons: FlatPolygons,
  options: PolygonsOptions,
  several: boolean,
): PolygonsTriangulation {
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

/** The part of a result that a single polygon has. */
export function triangulationOfOne(all: PolygonsTriangulation): PolygonTriangulation {
  const { triangles, strips, stripStarts, added, addedOn, trace } = all;
  return { triangles, strips, stripStarts, added, addedOn, trace };
}

function readTrace(steps: Uint32Array): FloodStep[] {
  return Array.from({ length: steps.length / kFloodStepLength }, (_, i) => {
    const { action, ...step } = readFloodStep(steps, kFloodStepLength * i);
    return { action: kFloodActionChoices[action], ...step };
  });
}

// spanLoops: checks its arguments, makes them flat, and computes the span.
import { optionsOf } from './check.js';
import { computeSpan } from './compute_span.js';
import { flattenLoops } from './flatten.js';
import { kSpanOptions } from './options.js';
import { tellEnd } from './report.js';
import { spanOptionsOf } from './span_input.js';
import type { LoopsLike, NoSpan, Span, SpanOptions } from './types.js';

/**
 * Spans one or more closed 3D loops with a triangulated surface of least cost. The surface is made of
 * candidate triangles; it is manifold, connected and orientable, and has the topology of a sphere with
 * k holes (Zou, Ju, Carr 2013). Synchronous; the worker of `soapfilm/worker` offers the same without
 * blocking.
 *
 * @param loops flat arrays, or one list of points for each loop. Their directions matter only with
 *   `boundaryNormals`. They are read when the call begins, and are not changed
 * @returns the surface, of m = n' + 2k - 4 triangles; or `found: false` if the candidate space holds
 *   none, which is an ordinary outcome for Delaunay candidates of contorted loops
 * @throws SoapfilmError `not-loaded`; `no-loops`, `bad-loops`, `bad-starts`, `not-finite`,
 *   `too-few-vertices`, `repeated-vertex`, `loops-intersect` with the loop and vertex at fault;
 *   `bad-weights`, `bad-normals`, `bad-candidates`, `bad-option`; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
 */
export function spanLoops(loops: LoopsLike, options: SpanOptions = {}): Span | NoSpan {
  const input = flattenLoops(loops);
  const checked = spanOptionsOf(optionsOf(options, kSpanOptions), input, false);
  const span = computeSpan(input, checked);
  tellEnd(span, checked.onProgress);
  return span;
}

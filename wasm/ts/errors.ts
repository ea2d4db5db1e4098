/** Every way in which a call of soapfilm can fail. Codes are stable; messages are not. */
export type ErrorCode =
  | 'not-loaded'
  | 'load-failed'
  | 'no-loops'
  | 'bad-loops'
  | 'bad-starts'
  | 'bad-polygon'
  | 'not-finite'
  | 'too-few-vertices'
  | 'repeated-vertex'
  | 'loops-intersect'
  | 'bad-mesh'
  | 'bad-attributes'
  | 'bad-normals'
  | 'bad-weights'
  | 'bad-candidates'
  | 'bad-option'
  | 'self-intersecting'
  | 'hole-outside'
  | 'holes-overlap'
  | 'nested-hole'
  | 'degenerate'
  | 'bad-model'
  | 'bad-knots'
  | 'bad-edge'
  | 'bad-domain'
  | 'trim-outside'
  | 'trim-open'
  | 'trim-self-intersects'
  | 'trims-cross'
  | 'edge-apart'
  | 'bad-file'
  | 'too-large'
  | 'out-of-memory'
  | 'time-limit'
  | 'cancelled'
  | 'disposed'
  | 'crashed';

/** Where in the input an error lies; a field is absent where it does not apply. */
export interface ErrorPlace {
  /** Index of the loop. */
  readonly loop?: number;
  /**
   * Index of the vertex within that loop. Of a mesh, for `not-finite` and `bad-attributes`, its vertex, and of edits in
   * a session the session's. For `bad-candidates`, index of the candidate triangle.
   */
  readonly vertex?: number;
  /** The second loop and vertex, for errors about a pair, such as `loops-intersect`. */
  readonly otherLoop?: number;
  readonly otherVertex?: number;
  /** Index of the polygon among many; `loop` is then the index of a ring in it, 0 for the outer one. */
  readonly polygon?: number;
  /** Where a fault of a polygon lies, such as the place where two edges cross; rounded. */
  readonly point?: readonly number[];
  /** Index of a face of a mesh or of a model; in a model `loop` is counted in its face. */
  readonly face?: number;
  /** Index of an edge's use in a loop of a model. */
  readonly use?: number;
  /** Index in a list of edges, such as `boundaryNormals` of `smoothSurface` and those of a model. */
  readonly edge?: number;
  /** The two vertices of an edge of a mesh. */
  readonly edgeVertices?: readonly [number, number];
  /** Line of a text file, counted from 1. */
  readonly line?: number;
}

/** The one error class of soapfilm: a stable `code`, a message in words, and the place at fault. */
export class SoapfilmError extends Error implements ErrorPlace {
  override readonly name = 'SoapfilmError';
  readonly code: ErrorCode;
  readonly loop?: number;
  readonly vertex?: number;
  readonly otherLoop?: number;
  readonly otherVertex?: number;
  readonly polygon?: number;
  readonly point?: readonly number[];
  readonly face?: number;
  readonly use?: number;
  readonly edge?: number;
  readonly edgeVertices?: readonly [number, number];
  readonly line?: number;

  constructor(code: ErrorCode, message: string, place: ErrorPlace = {}, options?: ErrorOptions) {
    super(message, options);
    this.code = code;
    Object.assign(this, place);
  }
}

/** That a part is missing which a call needs. */
export function notLoaded(part: string): SoapfilmError {
  const text = `The part '${part}' is not loaded: name it in \`parts\` of \`load\` or \`createWorker\``;
  return new SoapfilmError('not-loaded', text);
}

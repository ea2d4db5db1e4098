// The thread's side of the pool: runs the calls that it receives, one after the other, and keeps sessions.
import { PolygonEditor } from './compute_edits.js';
import { computeCarry, computeCrossings, computeHoles, computeOpen, computePatches, computeWeld, forgetMesh } from './compute_holes.js';
import { computeSmooth } from './compute_smooth.js';
import { computePolygons, triangulationOfOne } from './compute_polygons.js';
import { computeSpan } from './compute_span.js';
import { computeMove, computeOpenModel, computeTessellation, computeUpdate } from './compute_surfaces.js';
import {
  buffersOf,
  packError,
  packErrors,
  type Calls,
  type Reply,
  type Request,
  type Resident,
  type SessionKinds,
  type SessionRequest,
} from './protocol.js';
import { startCore } from './runtime.js';
import type { Part, PolygonOptions, SpanOptions } from './types.js';

/** The thread's end of the channel, the same in browsers and Node. */
export interface Port {
  onmessage: ((event: { readonly data: unknown }) => void) | null;
  postMessage(message: unknown, transfer: ArrayBuffer[]): void;
}

/** The last call of `onProgress` is left to the caller's side, once it has the span. */
const calls: Calls = {
  spanLoops: computeSpan,
  triangulatePolygon: (polygon, options) => triangulationOfOne(computePolygons(polygon, options, false)),
  triangulatePolygons: (polygons, options) => computePolygons(polygons, options, true),
  weldMesh: computeWeld,
  findHoles: computeHoles,
  openMesh: computeOpen,
  fillHoles: computePatches,
  findCrossings: computeCrossings,
  carryOn: computeCarry,
  smoothSurface: computeSmooth,
  openModel: computeOpenModel,
  tessellateModel: computeTessellation,
  updateModel: computeUpdate,
  moveInModel: computeMove,
};

const kinds: SessionKinds = { polygon: PolygonEditor };

const sessions = new Map<number, Resident>();

function useSession({ id, opens, method, input }: SessionRequest): unknown {
  if (opens) {
    sessions.set(id, new kinds[opens](input[0] as never, id));
    return;
  }
  // None if it could not be opened.
  const session = sessions.get(id) as unknown as Record<string, (...args: unknown[]) => unknown> | undefined;
  if (method === 'dispose') sessions.delete(id);
  return session?.[method as string](...input);
}

/** Answers the requests that come through `port`, as long as the thread lives. */
export function serve(port: Port): void {
  const reply = (message: Reply, transfer: ArrayBuffer[] = []): void => {
    port.postMessage(message, transfer);
  };
  const answer = async (request: Request): Promise<void> => {
    if (request.kind === 'start') {
      const parts = Object.entries(request.modules) as [Part, WebAssembly.Module][];
      await Promise.all(parts.map(([part, module]) => startCore(part, module)));
      reply({ kind: 'ready' });
      return;
    }
    if (request.kind === 'forget') {
      forgetMesh(request.name);
      return;
    }
    if (request.kind === 'session') {
      const value = packErrors(useSession(request) ?? {});
      reply({ kind: 'done', value, call: request.call }, buffersOf(value));
      return;
    }
    const [input, options = {}] = request.input;
    const call = calls[request.name] as (input: unknown, options: object) => object;
    const listeners: Pick<SpanOptions, 'onProgress' | 'onBest'> = {
      ...(request.progress && {
        onProgress: (...values) => {
          reply({ kind: 'progress', values });
        },
      }),
      ...(request.results && {
        onBest: (value) => {
          reply({ kind: 'best', value }, buffersOf(value));
        },
      }),
    };
    // Views of the core's memory cannot be sent.
    const owned = (options as PolygonOptions).borrow === true && { borrow: false };
    const value = packErrors(call(input, { ...options, ...listeners, ...owned }));
    reply({ kind: 'done', value }, buffersOf(value));
  };
  port.onmessage = ({ data }) => {
    answer(data as Request).catch((error: unknown) => {
      reply({ kind: 'error', error: packError(error), call: (data as SessionRequest).call });
    });
  };
}

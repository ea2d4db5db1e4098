// Dragging a vertex: its polygon stays in the library as a session while the gesture lasts, so that a move costs what
// changes around the vertex.
import { SoapfilmError, type PolygonEdit } from 'soapfilm';
import type { Film, PolygonSessionHandle } from 'soapfilm/worker';
import type { Lines } from '../../shapes/lines.ts';
import type { Id, Item } from '../../state/document.ts';
import { flatten, type PolygonGroup } from './polygons.ts';
import { withPolygon, type OfOnePolygon, type Triangulation, type Triangulator } from './triangulation.ts';

/** What of the library this needs. */
export type Sessions = Triangulator & {
  createPolygonSession(...args: Parameters<Film['createPolygonSession']>): Promise<SessionHandle>;
};
type SessionHandle = Pick<PolygonSessionHandle, 'triangles' | 'move' | 'dispose'>;

interface OpenSession {
  readonly handle: SessionHandle;
  /** What was there before the gesture, and the number in it of the polygon that the session holds. */
  readonly before: Triangulation;
  readonly polygon: number;
  /** The polygon and its triangles as the session has them: `count` triangles, and room for more. */
  held: Lines;
  triangles: Uint32Array;
  count: number;
}

/** The session of the gesture under way. */
export class DragSession {
  private open: OpenSession | null = null;
  /** A polygon that no session takes: its rings touch, say. */
  private refused: Id | null = null;
  private gestures = 0;
  private last: Promise<unknown> = Promise.resolve();

  /**
   * The triangulation of polygons of which one has a vertex elsewhere than before the gesture; one after the other,
   * in order. Null: they differ by more, or no session takes that polygon.
   *
   * @param before the latest triangulation
   */
  triangulate(
    film: Sessions,
    before: Triangulation | null,
    of: PolygonGroup,
    signal: AbortSignal,
  ): Promise<Triangulation | null> {
    const next = this.last.then(() => this.next(film, before, of, signal));
    this.last = next.catch(() => null);
    return next;
  }

  /** The gesture has ended. */
  end(): void {
    this.gestures++;
    this.refused = null;
    this.close();
  }

  private close(): void {
    this.open?.handle.dispose();
    this.open = null;
  }

  private async next(
    film: Sessions,
    latest: Triangulation | null,
    of: PolygonGroup,
    signal: AbortSignal,
  ): Promise<Triangulation | null> {
    const { output, repair } = of.settings;
    if (latest === null || output !== 'triangles' || repair !== 'none') return null;
    const before = this.open?.before ?? latest;
    const polygon = changedItem(before.of, of);
    if (polygon === null || (this.open && this.open.polygon !== polygon)) return null;
    const since = performance.now();
    this.open ??= await this.begin(film, before, of.items[polygon], polygon, signal);
    if (this.open === null) return null;
    const one = await this.move(film, this.open, of, signal);
    return one && withPolygon(before, of, polygon, one, (performance.now() - since) / 1000);
  }

  /** Opens a session on a polygon as it was before; null where that cannot be or is too late. */
  private async begin(
    film: Sessions,
    before: Triangulation,
    item: Item,
    polygon: number,
    signal: AbortSignal,
  ): Promise<OpenSession | null> {
    const isInvalid = before.errors.some((error) => error.polygon === polygon);
    const held = before.of.items[polygon].shape as Lines;
    if (isInvalid || item.id === this.refused || movedVertex(held, item.shape as Lines) === null) return null;
    const gesture = this.gestures;
    try {
      const handle = await film.createPolygonSession({ positions: held.positions, starts: held.starts }, { signal });
      if (gesture === this.gestures) {
        const triangles = await handle.triangles;
        if (gesture === this.gestures) return { handle, before, polygon, held, triangles, count: triangles.length / 3 };
      }
      handle.dispose();
    } catch (error) {
      if (signal.aborted) throw error;
      if (gesture === this.gestures) this.refused = item.id;
    }
    return null;
  }

  /** Moves the vertex that is elsewhere now; null where more has changed or the session is lost. */
  private async move(film: Triangulator, open: OpenSession, of: PolygonGroup, signal: AbortSignal): Promise<OfOnePolygon | null> {
    const item = of.items[open.polygon];
    const shape = item.shape as Lines;
    const vertex = movedVertex(open.held, shape);
    if (vertex === null) return null;
    if (vertex >= 0) {
      try {
        takeEdit(open, await open.handle.move(vertex, [shape.positions[2 * vertex], shape.positions[2 * vertex + 1]]));
        open.held = shape;
      } catch (error) {
        if (!(error instanceof SoapfilmError) || error.code === 'crashed' || error.code === 'disposed') {
          if (this.open === open) {
            this.close();
            this.refused = item.id;
          }
          return null;
        }
        // The session stays as it was. What is wrong with the polygon, the library says best of the polygon itself; it
        // may be nothing, since sessions are stricter.
        return triangulateOne(film, of, open.polygon, signal);
      }
    }
    return { triangles: open.triangles.subarray(0, 3 * open.count), errors: [] };
  }
}

async function triangulateOne(film: Triangulator, { items, settings }: PolygonGroup, polygon: number, signal: AbortSignal): Promise<OfOnePolygon> {
  const { triangles, errors } = await film.triangulatePolygons(flatten([items[polygon]]), { ...settings, skipInvalid: true, signal });
  return { triangles, errors: errors.map((error) => Object.assign(error, { polygon })) };
}

function takeEdit(open: OpenSession, { triangleCount, changed, triangles }: PolygonEdit): void {
  if (open.triangles.length < 3 * triangleCount) {
    const larger = new Uint32Array(6 * triangleCount);
    larger.set(open.triangles);
    open.triangles = larger;
  }
  for (let i = 0; i < changed.length; i++) {
    for (let k = 0; k < 3; k++) open.triangles[3 * changed[i] + k] = triangles[3 * i + k];
  }
  open.count = triangleCount;
}

/** The number of the only object that is not as before; null if other things have changed, or nothing. */
function changedItem(before: PolygonGroup, now: PolygonGroup): number | null {
  if (before.settings !== now.settings || before.items.length !== now.items.length) return null;
  let found: number | null = null;
  for (let i = 0; i < now.items.length; i++) {
    const [a, b] = [before.items[i], now.items[i]];
    if (a.id !== b.id) return null;
    if (a.shape === b.shape) continue;
    if (found !== null) return null;
    found = i;
  }
  return found;
}

/** The only vertex that is elsewhere; -1: none is; null: more has changed. */
function movedVertex(before: Lines, now: Lines): number | null {
  if (before.positions.length !== now.positions.length || before.starts.length !== now.starts.length) return null;
  if (before.starts !== now.starts && before.starts.some((start, i) => start !== now.starts[i])) return null;
  let found = -1;
  for (let at = 0; at < now.positions.length; at++) {
    if (before.positions[at] === now.positions[at]) continue;
    const vertex = at >> 1;
    if (found >= 0 && found !== vertex) return null;
    found = vertex;
  }
  return found;
}

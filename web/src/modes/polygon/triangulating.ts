// Triangulating the polygons as they change, in the worker.
import { computed, effect, signal } from '@preact/signals';
import { isLive } from '../../state/store.ts';
import { createWork, plainFailure, type Failure } from '../../state/work.ts';
import { DragSession } from './drag_session.ts';
import { kMode, polygonGroup, type PolygonGroup } from './polygons.ts';
import { nothingOf, triangulateAll, type Triangulation } from './triangulation.ts';
import { failureOf } from './wording.ts';

const latest = signal<Triangulation | null>(null);

/** What is shown: of the polygons as they are, or as they were a moment ago; null: nothing yet. */
export const triangulated = computed<Triangulation | null>(() => {
  const group = polygonGroup.value;
  return group.items.length === 0 ? nothingOf(group) : latest.value;
});

export const failures = computed<readonly Failure[]>(() => {
  const found = triangulated.value;
  return found === null ? [] : found.errors.map((error) => failureOf(error, found.of.items));
});

const session = new DragSession();
effect(() => {
  if (!isLive.value) session.end();
});

export const work = createWork<PolygonGroup, Triangulation>({
  mode: kMode,
  verb: 'Triangulating',
  input: computed(() => (polygonGroup.value.items.length > 0 ? polygonGroup.value : null)),
  part: 'polygons',
  // A session answers at once, of however many polygons.
  alwaysLive: true,
  async compute(film, of, watch) {
    if (watch.live) {
      const passing = await session.triangulate(film, latest.peek(), of, watch.signal);
      if (passing) {
        watch.onlyForNow();
        return passing;
      }
    }
    return triangulateAll(film, of, watch.signal);
  },
  show: (found) => {
    latest.value = found;
  },
  explain: plainFailure,
  begin: (of) => {
    const shown = latest.peek();
    if (shown && !haveCommon(shown.of, of)) latest.value = null;
  },
});

/** Whether any polygon is in both groups, so that the triangles of one can stand in for the other's for a moment. */
function haveCommon(a: PolygonGroup, b: PolygonGroup): boolean {
  const ids = new Set(a.items.map(({ id }) => id));
  return b.items.some(({ id }) => ids.has(id));
}

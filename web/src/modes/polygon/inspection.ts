// `window.__polygons`: the mode's state, read-only, for the page's tests and for a look from the console.
import { computed } from '@preact/signals';
import { inWindow, valuesOf } from '../../app/inspection.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import type { Stage } from '../../scene/stage.ts';
import { lineCount, type Lines } from '../../shapes/lines.ts';
import type { Point2 } from '../../shapes/plane.ts';
import { chosen, mode } from '../../state/store.ts';
import { flooding, type Flooding } from './flooding.ts';
import { kMode, polygonGroup } from './polygons.ts';
import { triangulated } from './triangulating.ts';
import type { Triangulation } from './triangulation.ts';

export interface PolygonInspection {
  /** Each polygon as a list of rings, each ring as a list of points. */
  readonly document: { readonly name: string; readonly polygons: readonly (readonly (readonly Point2[])[])[] };
  readonly triangulated: Triangulation | null;
  /** Whether `triangulated` is what the document as it is comes to, for good. */
  readonly isSettled: boolean;
  readonly flooding: Flooding | null;
  /** By numbers; the vertex is one of its ring. */
  readonly selection: { readonly polygon: number; readonly ring: number; readonly vertex: number | null } | null;
  /** Where a point of the plane appears, in CSS pixels of the window. */
  whereIs(point: Point2): { x: number; y: number };
}

declare global {
  interface Window {
    __polygons?: PolygonInspection;
  }
}

const document = computed(() => ({
  name: polygonGroup.value.name,
  polygons: polygonGroup.value.items.map(({ shape }) => ringsOf(shape as Lines)),
}));

const selection = computed(() => {
  const [place, items] = [chosen.value, polygonGroup.value.items];
  const polygon = items.findIndex(({ id }) => id === place?.item);
  if (place === null || polygon < 0 || mode.value !== kMode) return null;
  const { part: ring, handle } = place;
  const { starts } = items[polygon].shape as Lines;
  return { polygon, ring, vertex: handle === null ? null : handle - starts[ring] };
});

const isSettled = computed(() => {
  const found = triangulated.value;
  return found !== null && found.of === polygonGroup.value && !found.isPassing;
});

function ringsOf(lines: Lines): Point2[][] {
  const { positions, starts } = lines;
  return Array.from({ length: lineCount(lines) }, (_, ring) =>
    Array.from({ length: starts[ring + 1] - starts[ring] }, (_, i): Point2 => {
      const at = 2 * (starts[ring] + i);
      return [positions[at], positions[at + 1]];
    }),
  );
}

export function exposeForInspection({ view }: Stage, { viewpoint }: ModeScene): void {
  window.__polygons = Object.assign(valuesOf({ document, triangulated, isSettled, flooding, selection }), {
    whereIs: ([x, y]: Point2) => {
      const at = viewpoint.project([x, y, 0]);
      return inWindow(view.canvas, at.x, at.y);
    },
  });
}

// `window.__soapfilm`: the state of the page and of the film, read-only, for tests and for a look from the console.
import { computed } from '@preact/signals';
import type { Span } from 'soapfilm';
import { inWindow, valuesOf } from '../../app/inspection.ts';
import type { Viewpoint } from '../../scene/viewpoint.ts';
import { pointAt, type Lines } from '../../shapes/lines.ts';
import type { Place } from '../../state/document.ts';
import { notice, type Notice } from '../../state/notice.ts';
import { canRedo, canUndo, chosen, mode, selection, tool, type Tool } from '../../state/store.ts';
import type { Failure } from '../../state/work.ts';
import { film } from './film.ts';
import { isGrowing } from './film_scene.ts';
import { curvesOf, listOf } from './settings.ts';
import { isStale, none, spanning, surface } from './spanning.ts';

/** `window.__soapfilm`: the page, and the mode of films. */
export interface Inspection {
  readonly document: {
    readonly name: string;
    readonly curves: readonly (readonly (readonly number[])[])[];
    readonly settings: {
      readonly weights: { readonly area: number; readonly perimeter: number; readonly dihedral: number };
      readonly candidates: unknown;
    };
  };
  readonly solve: { readonly phase: string } | ({ readonly phase: 'failed' } & Failure);
  readonly surface: { readonly span: Span } | null;
  readonly isStale: boolean;
  readonly isGrowing: boolean;
  /** What was chosen last. */
  readonly selection: { readonly curve: number; readonly vertex: number | null } | null;
  readonly places: readonly Place[];
  readonly mode: string;
  readonly tool: Tool;
  readonly notice: Notice | null;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  /** Where a vertex appears, in CSS pixels of the window. */
  whereIs(curve: number, vertex: number): { x: number; y: number };
}

declare global {
  interface Window {
    __soapfilm?: Inspection;
  }
}

export function exposeFilm(viewpoint: Viewpoint, canvas: HTMLCanvasElement): void {
  const document = computed(() => ({ name: film.value.name, settings: film.value.settings, curves: curvesOf(film.value).map(listOf) }));
  const solve = computed(() => {
    const state = spanning.state.value;
    return state.phase === 'done' && none.value ? { phase: 'none' as const, ...none.value } : state;
  });
  const selected = computed(() => {
    const at = chosen.value;
    const curve = film.value.items.findIndex(({ id }) => id === at?.item);
    return at === null || curve < 0 ? null : { curve, vertex: at.handle };
  });
  const whereIs: Inspection['whereIs'] = (curve, vertex) => {
    const { x, y } = viewpoint.project(pointAt(film.peek().items[curve].shape as Lines, vertex));
    return inWindow(canvas, x, y);
  };
  const signals = { document, solve, surface, isStale, isGrowing, selection: selected, places: selection, mode, tool, notice, canUndo, canRedo };
  window.__soapfilm = Object.assign(valuesOf(signals), { whereIs });
}

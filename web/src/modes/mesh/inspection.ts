// `window.__meshes`: the mode's state, read-only, for the page's tests and for a look from the console.
import { computed } from '@preact/signals';
import type { HoleReport } from 'soapfilm';
import { inWindow, valuesOf } from '../../app/inspection.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import type { Stage } from '../../scene/stage.ts';
import { filling, isSettled, patches } from './filling.ts';
import type { Hole } from './grouping.ts';
import { chosenHoles, found, holes, hoveredHole, whole, wishFor } from './holes.ts';
import { withPatches, type Patch } from './patches.ts';
import { meshGroup, type MeshSettings } from './settings.ts';
import { vertexAt } from './whole.ts';
import { isFilled } from './wording.ts';

export interface MeshInspection {
  readonly document: { readonly name: string; readonly settings: MeshSettings; readonly vertices: number; readonly faces: number };
  readonly report: HoleReport | null;
  readonly holes: readonly (Hole & { readonly wish: 'fill' | 'leave' | null })[];
  readonly patches: readonly Patch[];
  /** Whether the holes have been found, and those that are to be filled have their patches. */
  readonly isSettled: boolean;
  readonly phase: string;
  readonly chosen: readonly number[];
  readonly hovered: number | null;
  /** `[3m]` */
  readonly filledFaces: Uint32Array | null;
  /** Where a vertex of the whole appears, in CSS pixels of the window. */
  whereIs(vertex: number): { x: number; y: number };
}

declare global {
  interface Window {
    __meshes?: MeshInspection;
  }
}

export function exposeForInspection({ view }: Stage, { viewpoint }: ModeScene): void {
  const signals = {
    document: computed(() => ({
      name: meshGroup.value.name,
      settings: meshGroup.value.settings,
      vertices: (whole.value?.positions.length ?? 0) / 3,
      faces: (whole.value?.faces.length ?? 0) / 3,
    })),
    report: computed(() => found.value?.report ?? null),
    holes: computed(() => holes.value.map((hole) => ({ ...hole, wish: wishFor(hole) }))),
    patches,
    isSettled: computed(() => isSettled.value && filling.state.value.phase !== 'running'),
    phase: computed(() => filling.state.value.phase),
    chosen: chosenHoles,
    hovered: hoveredHole,
    filledFaces: computed(() => whole.value && withPatches(whole.value, patches.value.filter(isFilled)).faces),
  };
  window.__meshes = Object.assign(valuesOf(signals), {
    whereIs: (vertex: number) => {
      const of = whole.peek();
      const at = of ? viewpoint.project(vertexAt(of, vertex)) : { x: NaN, y: NaN };
      return inWindow(view.canvas, at.x, at.y);
    },
  });
}

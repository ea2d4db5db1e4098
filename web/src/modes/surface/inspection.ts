// `window.__surfaces`: the mode's state, read-only, for the page's tests and for a look from the console.
import { computed } from '@preact/signals';
import { inWindow, valuesOf } from '../../app/inspection.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import type { Stage } from '../../scene/stage.ts';
import { handlesOf, placeOf, type Handle } from './handles.ts';
import { meshed, meshing, model, wish, type Meshed } from './meshing.ts';

export interface SurfaceInspection {
  readonly meshed: Meshed | null;
  readonly phase: string;
  /** Whether the mesh is that of the model, the settings and the picture as they are. */
  readonly isSettled: boolean;
  readonly handles: readonly Handle[];
  /** Where the camera stands now, in the scene. */
  eye(): readonly number[];
  /** Where a handle appears, in CSS pixels of the window. */
  whereIs(handle: number): { x: number; y: number };
}

declare global {
  interface Window {
    __surfaces?: SurfaceInspection;
  }
}

export function exposeForInspection({ view }: Stage, { viewpoint }: ModeScene): void {
  const handles = computed(() => (model.value ? handlesOf(model.value) : []));
  const signals = {
    meshed,
    phase: computed(() => meshing.state.value.phase),
    isSettled: computed(() => meshing.state.value.phase === 'done' && meshed.value?.of === wish.value),
    handles,
  };
  window.__surfaces = Object.assign(valuesOf(signals), {
    eye: () => viewpoint.camera.position.toArray(),
    whereIs: (handle: number) => {
      const of = model.peek();
      const at = of ? viewpoint.project(placeOf(of, handles.peek()[handle])) : { x: NaN, y: NaN };
      return inWindow(view.canvas, at.x, at.y);
    },
  });
}

// Meshing the model, in the worker: anew when it has become another one, from what there is when only the sampling has.
import { computed, signal } from '@preact/signals';
import type { Change, Model, Sampling } from 'soapfilm/surfaces';
import type { TrimmedModelHandle } from 'soapfilm/worker';
import type { Point } from '../../shapes/vec.ts';
import { createWork, plainFailure, type Failure } from '../../state/work.ts';
import { kMode, surfaceGroup, type ModelShape } from './settings.ts';

export interface Wish {
  readonly model: Model;
  readonly skips: boolean;
  readonly sampling: Sampling;
}

export interface Meshed {
  readonly of: Wish;
  readonly change: Change;
  /** In milliseconds, as the page waited for it. */
  readonly took: number;
}

/** What the camera sees. */
export interface Picture {
  readonly eye: Point;
  /** [16] column by column */
  readonly viewProjection: readonly number[];
  readonly width: number;
  readonly height: number;
}

/** The picture that the mesh is for; null: none, or not yet. Set by what draws. */
export const picture = signal<Picture | null>(null);
/** Whether the picture stays as it was, and with it the mesh, once that is made for it: to be looked at from elsewhere. */
export const frozen = signal(false);

export const settings = computed(() => surfaceGroup.value.settings);
const models = computed(() => surfaceGroup.value.items.map((item) => (item.shape as ModelShape).model));

/** All models of the document as one; null: there is none. */
export const model = computed<Model | null>(() => {
  const all = models.value;
  if (all.length === 0) return null;
  return all.length === 1 ? all[0] : { instances: all.map((part) => ({ part })) };
});

/** What mesh there is to be. */
export const wish = computed<Wish | null>(() => {
  const of = model.value;
  if (of === null) return null;
  const { relative, angle, aspect, follows, pixels, skips } = settings.value;
  const shape = { aspect: aspect === 0 ? Infinity : aspect };
  const camera = follows ? picture.value : null;
  const sampling: Sampling = camera
    ? { ...shape, camera: { ...camera, pixels } }
    : { ...shape, relative, angle: (angle * Math.PI) / 180 };
  return { model: of, skips, sampling };
});

/** The last mesh there was. */
export const meshed = signal<Meshed | null>(null);

interface Opened {
  readonly model: Model;
  readonly skips: boolean;
  readonly handle: TrimmedModelHandle;
}
let opened: Opened | null = null;

export const meshing = createWork<Wish, Meshed>({
  mode: kMode,
  verb: 'Meshing',
  input: wish,
  part: 'surfaces',
  alwaysLive: true,
  async compute(film, of, watch) {
    const ends = watch.signal;
    if (opened?.model !== of.model || opened.skips !== of.skips) {
      opened?.handle.dispose();
      opened = null;
      const handle = await film.createTrimmedModel(of.model, { skipInvalid: of.skips, signal: ends });
      if (ends.aborted) handle.dispose();
      ends.throwIfAborted();
      opened = { model: of.model, skips: of.skips, handle };
    }
    const { handle } = opened;
    const change = await handle.update({ ...of.sampling, signal: ends, onProgress: (fraction) => { watch.progress(fraction); } });
    return { of, change, took: watch.elapsed() };
  },
  show: (now) => (meshed.value = now),
  explain: (error): Failure => plainFailure(error),
});

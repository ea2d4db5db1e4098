// The kind of object that is a model of trimmed surfaces. Its handles are poles; what is drawn of it else is its mesh.
import type { Model } from 'soapfilm/surfaces';
import { Dots } from '../../scene/dots.ts';
import { distanceOf, type Eye, type Spot } from '../../scene/eye.ts';
import type { Drawn, DrawnKind, Hit, Layer, Marks } from '../../scene/kind.ts';
import { boxOfPoints, type Box } from '../../shapes/vec.ts';
import type { Item, Place } from '../../state/document.ts';
import { facesIn } from './faces.ts';
import { handlesOf, placeOf, withMoved } from './handles.ts';
import { kModel, type ModelShape } from './settings.ts';

/** In CSS pixels. */
const kDot = 6;
const kMarkedDot = 10;

const boxes = new WeakMap<Model, Box>();

export const modelKind: DrawnKind<ModelShape> = {
  name: kModel,
  boxOf: ({ model }) => boxOf(model),
  partStarts: ({ model }) => [0, handlesOf(model).length],
  handleAt: ({ model }, handle) => placeOf(model, handlesOf(model)[handle]),
  move: (shape, places, by) => ({ model: places.reduce((model, { handle }) => moved(model, handle, by), shape.model) }),
  // Poles are not taken away: a model goes as a whole.
  remove: (shape, places) => (places.some(({ handle }) => handle === null) ? null : shape),
  read: readShape,
  pick: pickHandle,
  makeLayer: () => new HandleLayer(),
};

const moved = (model: Model, handle: number | null, by: readonly [number, number, number]): Model =>
  handle === null ? model : withMoved(model, handlesOf(model)[handle], by);

/** Of all poles: the surfaces lie within. */
function boxOf(model: Model): Box {
  const known = boxes.get(model);
  if (known) return known;
  const all: number[] = [];
  for (const { surface, place } of facesIn(model)) {
    for (const [x, y, z] of surface.poles) all.push(...place([x as number, y as number, z as number]));
  }
  const box = boxOfPoints(new Float64Array(all.filter(Number.isFinite)), 3);
  boxes.set(model, box);
  return box;
}

function readShape(saved: unknown): ModelShape | null {
  const { model } = (saved ?? {}) as Partial<Record<keyof ModelShape, unknown>>;
  return typeof model === 'object' && model !== null ? { model } : null;
}

function pickHandle({ model }: ModelShape, eye: Eye, at: Spot, reach: number): Hit | null {
  let best: Hit | null = null;
  handlesOf(model).forEach((handle, i) => {
    const point = placeOf(model, handle);
    const p = eye.project(point);
    const distance = p.visible ? distanceOf(p, at) : Infinity;
    if (distance < (best?.distance ?? reach)) best = { part: 0, handle: i, distance, point };
  });
  return best;
}

class HandleLayer implements Layer {
  private readonly dots = new Dots(true);
  readonly object = this.dots.object;

  update(items: readonly Item[], marks: Marks, { placement, pixelRatio, theme }: Drawn): void {
    const { curves } = theme;
    const dots = this.dots.begin(placement);
    const modelOf = (id: number): Model | undefined => (items.find((item) => item.id === id)?.shape as ModelShape | undefined)?.model;
    if (marks.vertices) {
      for (const item of items) {
        const { model } = item.shape as ModelShape;
        for (const handle of handlesOf(model)) {
          dots.put(placeOf(model, handle), curves.line, kDot, handle.kind === 'pole' ? 'round' : 'diamond');
        }
      }
    }
    const mark = ({ item, handle }: Place): void => {
      const model = modelOf(item);
      const all = model ? handlesOf(model) : [];
      if (model && handle !== null && handle < all.length) dots.put(placeOf(model, all[handle]), curves.selected, kMarkedDot);
    };
    if (marks.hover) mark(marks.hover);
    marks.selection.forEach(mark);
    this.dots.show(pixelRatio, curves.rim);
  }
}

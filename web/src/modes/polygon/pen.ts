// Drawing rings: one inside a polygon is a hole of it, any other a polygon.
import { signal } from '@preact/signals';
import type { PenTool } from '../../scene/tools.ts';
import { linesOf, type Lines } from '../../shapes/lines.ts';
import type { Point } from '../../shapes/vec.ts';
import { newItem } from '../../state/document.ts';
import { dispatch, type Pen } from '../../state/store.ts';
import { hostOf, polygonGroup, polygonKind, withHole } from './polygons.ts';

export const ringPen = signal<Pen>({ count: 24, smoothing: 0.3 });

export const penTool: PenTool = {
  noun: 'ring',
  help: 'one stroke all the way round is one ring; inside another it is a hole',
  pen: () => ringPen.value,
  add: addRing,
};

function addRing(points: readonly Point[]): void {
  const { id, items } = polygonGroup.peek();
  const host = hostOf(items, points);
  if (host) dispatch({ type: 'reshape', group: id, item: host.id, shape: withHole(host.shape as Lines, points) });
  else dispatch({ type: 'add', group: id, items: [newItem(polygonKind, linesOf(2, [points]))] });
}

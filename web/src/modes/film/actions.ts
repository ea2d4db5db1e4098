// What buttons and keys have in common: commands that depend on the selection and the pen.
import type { Stage } from '../scene/stage.ts';
import { circleInPlane, toPlane } from '../shapes/plane.ts';
import { add, dot, scale, subtract } from '../shapes/vec.ts';
import { dispatch, doc, drawing, requestFrame, selection } from '../state/store.ts';
import { gridStep } from '../scene/grid.ts';

/** A vertex nearer to a plane lies in it, in radii of what is in view. */
const kClear = 1e-3;

let stage: Stage | null = null;

/** Says which stage the plane and the view are of. */
export function actOn(theStage: Stage): void {
  stage = theStage;
}

/**
 * Adds a circle in the drawing plane, around the point of it that the view turns about; smaller
 * where a curve has a vertex on that circle already.
 */
export function addCircle(): void {
  if (stage === null) return;
  const frame = stage.drawingPlane();
  const { radius } = stage.view;
  const center = toPlane(frame, stage.view.target);
  const { curves } = doc.peek();
  // Distances of the vertices in the plane from the center.
  const taken = curves.flat().flatMap((point) => {
    const [u, v] = toPlane(frame, point);
    const height = dot(subtract(point, frame.origin), frame.normal);
    return Math.abs(height) < kClear * radius ? [Math.hypot(u - center[0], v - center[1])] : [];
  });
  let size = 3 * gridStep(radius);
  while (taken.some((distance) => Math.abs(distance - size) < 0.1 * size)) size *= 0.75;
  const points = circleInPlane(frame, center, size, drawing.peek().count);
  const isFirst = curves.length === 0;
  dispatch({ type: 'add-curve', points });
  selection.value = { curve: doc.peek().curves.length - 1, vertex: null };
  if (isFirst) requestFrame();
}

export function deleteSelected(): void {
  const chosen = selection.peek();
  if (chosen === null) return;
  selection.value = null;
  dispatch({ type: 'delete-curve', curve: chosen.curve });
}

/** Chooses the next curve, or the one before; wraps round. */
export function stepCurve(step: 1 | -1): void {
  const { length } = doc.peek().curves;
  if (length === 0) return;
  const from = selection.peek()?.curve ?? (step > 0 ? -1 : length);
  selection.value = { curve: (from + step + length) % length, vertex: null };
}

/** Chooses the next vertex of the chosen curve, or the one before; wraps round. */
export function stepVertex(step: 1 | -1): void {
  if (doc.peek().curves.length === 0) return;
  const { curve, vertex } = selection.peek() ?? { curve: 0, vertex: null };
  const { length } = doc.peek().curves[curve];
  const from = vertex ?? (step > 0 ? -1 : length);
  selection.value = { curve, vertex: (from + step + length) % length };
}

/** Moves the chosen vertex along the screen's axes, in hundredths of what is in view. */
export function nudge(right: number, up: number): boolean {
  const { curve, vertex } = selection.peek() ?? { curve: 0, vertex: null };
  if (stage === null || vertex === null) return false;
  const from = doc.peek().curves[curve][vertex];
  const frame = stage.dragPlane(from);
  const step = 0.02 * stage.view.radius;
  const to = add(from, add(scale(frame.u, right * step), scale(frame.v, up * step)));
  dispatch({ type: 'move-vertex', curve, vertex, to });
  return true;
}

// The pointer on the canvas: the pen of the draw tool, the hand of the select tool. What neither
// takes is left to the orbit controls.
import { closeStroke, type ClosedStroke } from '../shapes/stroke.ts';
import { fromPlane, meetPlane, toPlane, type Frame, type Point2 } from '../shapes/plane.ts';
import { add, subtract, type Point } from '../shapes/vec.ts';
import { setLive } from '../state/solving.ts';
import { cancelGesture, dispatch, doc, drawing, endGesture, hover, isGrowing, say, selection, tool } from '../state/store.ts';
import type { Stage } from './stage.ts';

/** What a press has begun; a press that neither draws nor drags a vertex has none. */
type Action =
  | { kind: 'stroke'; pointer: number; frame: Frame; stroke: Point2[]; pixel: number; press: PointerEvent }
  | { kind: 'drag'; pointer: number; frame: Frame; curve: number; vertex: number; grip: Point; moved: boolean };

const kReach: Partial<Record<string, number>> = { pen: 14, touch: 24 };
/** How far from what it means the pointer may be, in CSS pixels. */
export const reachOf = ({ pointerType }: PointerEvent): number => kReach[pointerType] ?? 11;
/** A press that moves less is a click, in CSS pixels. */
const kClickSlop = 5;
/** Least extent of a stroke that becomes a curve, in CSS pixels. */
export const kLeastExtent = 16;
let gestures = 0;

export interface PointerTools {
  /** Ends what the pointer has begun, without effect; says whether there was anything. */
  cancel(): boolean;
}

export function attachPointer(stage: Stage): PointerTools {
  const { view } = stage;
  const { container, canvas } = view;
  let action: Action | null = null;
  let press: { x: number; y: number } | null = null;
  const touches = new Set<number>();

  const at = (event: PointerEvent) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const hit = (frame: Frame, event: PointerEvent): Point | null => {
    const { x, y } = at(event);
    const { from, direction } = view.ray(x, y);
    return meetPlane(frame, from, direction);
  };

  const beginStroke = (event: PointerEvent): boolean => {
    const frame = stage.drawingPlane();
    const start = hit(frame, event);
    if (start === null) {
      say('The drawing plane is seen edge-on here. Turn the view, or face the plane (P).', 'error');
      return true;
    }
    selection.value = null;
    const pixel = view.pixelSize(start);
    action = { kind: 'stroke', pointer: event.pointerId, frame, stroke: [toPlane(frame, start)], pixel, press: event };
    return true;
  };

  const beginDrag = (event: PointerEvent): boolean => {
    const picked = stage.pick(at(event).x, at(event).y, reachOf(event));
    if (picked === null || picked.vertex === null) return false;
    const point = doc.peek().curves[picked.curve][picked.vertex];
    const frame = stage.dragPlane(point);
    const grip = hit(frame, event);
    if (grip === null) {
      say('The drawing plane is seen edge-on here. Turn the view, or drag in the view plane.', 'error');
      return false;
    }
    selection.value = picked;
    action = {
      kind: 'drag',
      pointer: event.pointerId,
      frame,
      curve: picked.curve,
      vertex: picked.vertex,
      grip: subtract(point, grip),
      moved: false,
    };
    gestures++;
    return true;
  };

  const closed = (stroke: readonly Point2[], pixel: number): ClosedStroke => {
    const { count, smoothing } = drawing.peek();
    return closeStroke(stroke, { count, smoothing, leastExtent: kLeastExtent * pixel });
  };

  const onDown = (event: PointerEvent) => {
    if (isGrowing.peek()) stage.skipGrowth();
    if (event.pointerType === 'touch') touches.add(event.pointerId);
    if (touches.size > 1) {
      handOverToOrbit();
      return;
    }
    press = at(event);
    if (event.button !== 0 || event.altKey) return;
    const taken = tool.peek() === 'draw' ? beginStroke(event) : beginDrag(event);
    if (!taken) return;
    event.stopPropagation();
    container.setPointerCapture(event.pointerId);
  };

  /** A second finger: what the first began was meant to turn or pinch the view. */
  const handOverToOrbit = () => {
    const first = action?.kind === 'stroke' ? action.press : null;
    tools.cancel();
    press = null;
    if (first === null) return;
    container.releasePointerCapture(first.pointerId);
    canvas.dispatchEvent(new PointerEvent('pointerdown', first));
  };

  const onMove = (event: PointerEvent) => {
    if (action === null) {
      const isFree = event.buttons === 0 && event.pointerType !== 'touch' && tool.peek() === 'select';
      const under = isFree ? stage.pick(at(event).x, at(event).y, reachOf(event)) : null;
      const before = hover.peek();
      if (under?.curve !== before?.curve || under?.vertex !== before?.vertex) hover.value = under;
      canvas.dataset.over = under === null ? '' : under.vertex === null ? 'curve' : 'vertex';
      return;
    }
    if (event.pointerId !== action.pointer) return;
    event.stopPropagation();
    if (action.kind === 'stroke') {
      const all = event.getCoalescedEvents();
      for (const part of all.length > 0 ? all : [event]) {
        const point = hit(action.frame, part);
        if (point) action.stroke.push(toPlane(action.frame, point));
      }
      previewStroke(action);
      return;
    }
    const here = at(event);
    if (!action.moved && press && Math.hypot(here.x - press.x, here.y - press.y) < kClickSlop) return;
    const point = hit(action.frame, event);
    if (point === null) return;
    action.moved = true;
    setLive(true);
    const to = add(point, action.grip);
    dispatch({ type: 'move-vertex', curve: action.curve, vertex: action.vertex, to }, `drag ${gestures}`);
  };

  const previewStroke = ({ stroke, frame, pixel }: Extract<Action, { kind: 'stroke' }>) => {
    const outcome = closed(stroke, pixel);
    const curve = 'points' in outcome ? outcome.points.map((p) => fromPlane(frame, p)) : null;
    const raw = stroke.map((p) => fromPlane(frame, p));
    stage.pen.show(raw, curve, stage.placement.peek(), stage.theme.pen);
    view.invalidate();
  };

  const finishStroke = ({ stroke, frame, pixel }: Extract<Action, { kind: 'stroke' }>) => {
    const outcome = closed(stroke, pixel);
    if ('problem' in outcome) {
      say(
        outcome.problem === 'short'
          ? 'That stroke was too short for a curve. Draw all the way round.'
          : 'That stroke was nearly straight. Draw all the way round.',
        'error',
      );
      return;
    }
    dispatch({ type: 'add-curve', points: outcome.points.map((p) => fromPlane(frame, p)) });
  };

  const onUp = (event: PointerEvent) => {
    touches.delete(event.pointerId);
    if (action === null) {
      const here = at(event);
      const isClick = press && Math.hypot(here.x - press.x, here.y - press.y) < kClickSlop;
      if (isClick && event.button === 0 && tool.peek() === 'select') selection.value = stage.pick(here.x, here.y, reachOf(event));
      press = null;
      return;
    }
    if (event.pointerId !== action.pointer) return;
    event.stopPropagation();
    const ended = action;
    action = null;
    press = null;
    stage.pen.clear();
    view.invalidate();
    if (ended.kind === 'stroke') finishStroke(ended);
    else if (ended.moved) {
      endGesture();
      setLive(false);
    }
  };

  const onCancel = (event: PointerEvent) => {
    touches.delete(event.pointerId);
    if (event.pointerId === action?.pointer) tools.cancel();
  };

  const tools: PointerTools = {
    cancel() {
      if (action === null) return false;
      const ended = action;
      action = null;
      stage.pen.clear();
      view.invalidate();
      if (ended.kind === 'drag' && ended.moved) {
        cancelGesture();
        setLive(false);
      }
      return true;
    },
  };

  // In the capture phase on the canvas's parent: before the orbit controls, which listen on the canvas.
  container.addEventListener('pointerdown', onDown, { capture: true });
  container.addEventListener('pointermove', onMove, { capture: true });
  container.addEventListener('pointerup', onUp, { capture: true });
  container.addEventListener('pointercancel', onCancel, { capture: true });
  container.addEventListener('pointerleave', () => (hover.value = null));
  return tools;
}

// The pointer on the drawing of polygons: draws rings, drags vertices, moves and enlarges the view.
import type { Point2 } from '../shapes/plane.ts';
import { closeStroke } from '../shapes/stroke.ts';
import { history, polygonTool, ringPen, selectedRing, type RingPlace } from '../state/polygon.ts';
import { say } from '../state/store.ts';
import { kLeastExtent, reachOf } from './pointer.ts';
import type { PolygonView } from './polygon_view.ts';

type Action =
  | { readonly kind: 'stroke'; readonly points: Point2[] }
  | { readonly kind: 'drag'; readonly at: RingPlace & { readonly vertex: number }; readonly grip: Point2 }
  | { readonly kind: 'pan' };

let gestures = 0;

/** Attaches the pointer; what it returns ends what the pointer has begun, and says whether there was anything. */
export function attachPolygonPointer(view: PolygonView): () => boolean {
  const { canvas } = view;
  let action: Action | null = null;
  const pointers = new Map<number, Point2>();

  const at = (event: PointerEvent | WheelEvent): Point2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const end = (): void => {
    if (action?.kind === 'stroke') {
      view.stroke = [];
      view.invalidate();
    }
    history.endGesture();
    action = null;
  };
  const cancel = (): boolean => {
    if (action === null) return false;
    if (action.kind === 'drag') history.cancelGesture();
    end();
    return true;
  };

  const finishStroke = (points: readonly Point2[]): void => {
    const { count, smoothing } = ringPen.peek();
    const closed = closeStroke(points, { count, smoothing, leastExtent: view.lengthOf(kLeastExtent) });
    if ('problem' in closed) {
      say('Draw one stroke all the way round: it closes when you let go.');
      return;
    }
    history.dispatch({ type: 'add-ring', points: closed.points });
  };

  canvas.addEventListener('pointerdown', (event) => {
    const place = at(event);
    pointers.set(event.pointerId, place);
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 2) {
      // Two fingers move and enlarge; what one of them had begun is undone.
      cancel();
      action = { kind: 'pan' };
      return;
    }
    if (pointers.size > 2) return;
    const isMain = event.button === 0;
    if (isMain && polygonTool.peek() === 'draw') {
      const points = [view.toPlane(place)];
      view.stroke = points;
      action = { kind: 'stroke', points };
      return;
    }
    const picked = isMain ? view.pick(place, reachOf(event)) : null;
    if (isMain) selectedRing.value = picked;
    if (picked !== null && picked.vertex !== null) {
      gestures++;
      const { polygon, ring, vertex } = picked;
      const from = history.doc.peek().polygons[polygon][ring][vertex];
      const grip = view.toPlane(place);
      action = { kind: 'drag', at: { polygon, ring, vertex }, grip: [from[0] - grip[0], from[1] - grip[1]] };
    } else {
      action = { kind: 'pan' };
    }
  });

  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    const now = at(event);
    if (before === undefined) return;
    pointers.set(event.pointerId, now);
    if (action?.kind === 'stroke') {
      action.points.push(view.toPlane(now));
      view.invalidate();
    } else if (action?.kind === 'drag') {
      const [x, y] = view.toPlane(now);
      const to: Point2 = [x + action.grip[0], y + action.grip[1]];
      history.dispatch({ type: 'move-vertex', at: action.at, to }, `drag ${gestures}`);
    } else if (action?.kind === 'pan') {
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const distance = (p: Point2): number => Math.hypot(p[0] - other[0], p[1] - other[1]);
        view.zoom(distance(now) / Math.max(1, distance(before)), other);
      } else {
        view.pan(now[0] - before[0], now[1] - before[1]);
      }
    }
  });

  const release = (event: PointerEvent): void => {
    if (!pointers.delete(event.pointerId)) return;
    if (pointers.size > 0) return;
    const done = action;
    end();
    if (done?.kind === 'stroke' && event.type === 'pointerup') finishStroke(done.points);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('contextmenu', (event) => {
    event.preventDefault();
  });
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      view.zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), at(event));
    },
    { passive: false },
  );
  return cancel;
}

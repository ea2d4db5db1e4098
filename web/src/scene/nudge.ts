// What is chosen, moved by keys.
import { fromPlane } from '../shapes/plane.ts';
import { subtract } from '../shapes/vec.ts';
import { handlesAt, kindOf } from '../state/document.ts';
import { chosen, dispatch, endGesture, group, isLive, isMovable, itemBy, selection } from '../state/store.ts';
import type { Stage } from './stage.ts';

/** A key that is held down makes one step of the history: what it has moved by so far, in key steps. */
let held = { name: '', right: 0, up: 0 };
let count = 0;

/**
 * Moves what is chosen along the screen's axes, in key steps; says whether there was anything. `isRepeat`: the key is
 * still down. `endNudge` ends that.
 */
export function nudge(stage: Stage, right: number, up: number, isRepeat: boolean): boolean {
  const viewpoint = stage.current.peek()?.viewpoint;
  const at = chosen.peek();
  const item = at && itemBy(at.item);
  const id = group.peek()?.id;
  if (!viewpoint || !item || id === undefined || !isMovable(at)) return false;
  const goesOn = isRepeat && isLive.peek();
  if (!goesOn) held = { name: `nudge ${++count}`, right: 0, up: 0 };
  held = { ...held, right: held.right + right, up: held.up + up };
  const kind = kindOf(item);
  const handle = handlesAt(kind, item.shape, at).at(0);
  const point = handle === undefined ? viewpoint.target : kind.handleAt(item.shape, handle);
  const frame = stage.dragPlane(point);
  const step = viewpoint.keyStep(point);
  const by = subtract(fromPlane(frame, [step * held.right, step * held.up]), frame.origin);
  dispatch({ type: 'move', group: id, places: selection.peek(), by }, held.name);
  return true;
}

/** No key is down any more. */
export function endNudge(): void {
  if (held.name === '') return;
  held = { name: '', right: 0, up: 0 };
  endGesture();
}

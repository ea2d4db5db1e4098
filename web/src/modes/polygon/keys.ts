// Keys while polygons are drawn: those of the page's other mode, as far as they make sense here.
import type { PolygonView } from '../scene/polygon_view.ts';
import { beginFlooding, flooding, history, polygonTool, selectedRing, type RingPlace } from '../state/polygon.ts';
import { dismissNotice, notice } from '../state/store.ts';
import { attachKeyboard } from './keyboard.ts';

/** What an arrow moves the view or a vertex by, in CSS pixels. */
const kFar = 40;
const kNear = 4;
const kCloser = 1.2;

export function attachPolygonKeys(view: PolygonView, cancel: () => boolean): void {
  const plain: Partial<Record<string, () => void>> = {
    f: () => { view.frameAll(); },
    '[': () => { stepRing(-1); },
    ']': () => { stepRing(1); },
    ',': () => { stepVertex(-1); },
    '.': () => { stepVertex(1); },
    delete: deleteChosen,
    backspace: deleteChosen,
    ' ': toggleFlooding,
    escape: () => {
      if (cancel()) return;
      if (flooding.peek() !== null) flooding.value = null;
      else if (notice.peek() !== null) dismissNotice();
      else if (selectedRing.peek() !== null) selectedRing.value = null;
      else polygonTool.value = 'select';
    },
  };
  attachKeyboard({
    of: 'polygon',
    history,
    tool: polygonTool,
    plain,
    canvas: view.canvas,
    onArrow: (right, up, isFar) => {
      if (!nudge(view.lengthOf(isFar ? kFar : kNear), right, up)) view.pan(-kFar * right, kFar * up);
    },
    onZoom: (direction) => {
      view.zoom(direction === 'in' ? kCloser : 1 / kCloser, [view.canvas.clientWidth / 2, view.canvas.clientHeight / 2]);
    },
  });
}

export function deleteChosen(): void {
  const at = selectedRing.peek();
  if (at !== null) history.dispatch({ type: 'delete', at });
}

export function toggleFlooding(): void {
  if (flooding.peek() !== null) flooding.value = null;
  else beginFlooding();
}

/** Moves the chosen vertex by as many steps; says whether there was one. */
function nudge(step: number, right: number, up: number): boolean {
  const at = selectedRing.peek();
  if (at === null || at.vertex === null) return false;
  const { polygon, ring, vertex } = at;
  const [x, y] = history.doc.peek().polygons[polygon][ring][vertex];
  history.dispatch({ type: 'move-vertex', at: { polygon, ring, vertex }, to: [x + step * right, y + step * up] });
  return true;
}

/** Chooses the next ring of all polygons, or the one before; wraps round. */
function stepRing(step: 1 | -1): void {
  const rings: RingPlace[] = history.doc
    .peek()
    .polygons.flatMap((polygon, p) => polygon.map((_, ring) => ({ polygon: p, ring, vertex: null })));
  if (rings.length === 0) return;
  const at = selectedRing.peek();
  const from = rings.findIndex(({ polygon, ring }) => polygon === at?.polygon && ring === at.ring);
  const next = from < 0 ? (step > 0 ? 0 : rings.length - 1) : (from + step + rings.length) % rings.length;
  selectedRing.value = rings[next];
}

function stepVertex(step: 1 | -1): void {
  if (selectedRing.peek() === null) stepRing(1);
  const at = selectedRing.peek();
  if (at === null) return;
  const { length } = history.doc.peek().polygons[at.polygon][at.ring];
  const from = at.vertex ?? (step > 0 ? -1 : length);
  selectedRing.value = { ...at, vertex: (from + step + length) % length };
}

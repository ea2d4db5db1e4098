// Keys while polygons are drawn: those of the page's other mode, as far as they make sense here.
import type { PolygonView } from '../scene/polygon_view.ts';
import { beginFlooding, flooding, history, polygonTool, selectedRing, type RingPlace } from '../state/polygon.ts';
import { dismissNotice, mode, notice } from '../state/store.ts';
import { openDialog } from './dialogs.tsx';

const kFar = 40;

export function attachPolygonKeys(view: PolygonView, cancel: () => boolean, chooseFile: () => void): void {
  const plain: Partial<Record<string, () => void>> = {
    v: () => (polygonTool.value = 'select'),
    d: () => (polygonTool.value = 'draw'),
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
  const withControl: Partial<Record<string, () => void>> = { z: history.undo, y: history.redo, o: chooseFile };

  window.addEventListener('keydown', (event) => {
    if (mode.peek() !== 'polygon' || event.defaultPrevented || event.altKey) return;
    if (openDialog.peek() !== null || isTyping(event)) return;
    const key = event.key.toLowerCase();
    if (key === ' ' && event.target instanceof HTMLButtonElement) return;
    const hasControl = event.ctrlKey || event.metaKey;
    const action = hasControl ? (key === 'z' && event.shiftKey ? history.redo : withControl[key]) : plain[key];
    if (action) action();
    else if (hasControl || event.target !== view.canvas || !onArrow(view, event)) return;
    event.preventDefault();
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

function onArrow(view: PolygonView, event: KeyboardEvent): boolean {
  const moves: Partial<Record<string, readonly [right: number, up: number]>> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const move = moves[event.key];
  const middle = [view.canvas.clientWidth / 2, view.canvas.clientHeight / 2] as const;
  if (move) {
    const at = selectedRing.peek();
    if (at === null || at.vertex === null) {
      view.pan(-kFar * move[0], kFar * move[1]);
      return true;
    }
    const { polygon, ring, vertex } = at;
    const [x, y] = history.doc.peek().polygons[polygon][ring][vertex];
    const step = view.lengthOf(event.shiftKey ? kFar : 4);
    history.dispatch({ type: 'move-vertex', at: { polygon, ring, vertex }, to: [x + step * move[0], y + step * move[1]] });
    return true;
  }
  if (event.key === '+' || event.key === '=') view.zoom(1.2, middle);
  else if (event.key === '-') view.zoom(1 / 1.2, middle);
  else return false;
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

/** Whether the key belongs to a field; sliders and radio buttons keep only their arrows. */
function isTyping({ target, key }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLInputElement)) return false;
  return !['range', 'radio', 'checkbox'].includes(target.type) || key === ' ' || key.startsWith('Arrow');
}

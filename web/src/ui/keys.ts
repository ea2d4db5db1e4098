// Keys: one table for the page, and the arrows while the scene has the focus.
import type { PointerTools } from '../scene/pointer.ts';
import type { Stage } from '../scene/stage.ts';
import type { PlaneKind } from '../shapes/plane.ts';
import { saveSurface } from '../state/files.ts';
import { endSpan, solve } from '../state/solving.ts';
import { dismissNotice, drawing, isGrowing, mode, notice, redo, selection, tool, undo } from '../state/store.ts';
import { addCircle, deleteSelected, nudge, stepCurve, stepVertex } from './actions.ts';
import { chooseFile } from './bars.tsx';
import { openDialog } from './dialogs.tsx';

const kPlanes: readonly PlaneKind[] = ['xy', 'yz', 'zx', 'view'];
const kTurn = Math.PI / 24;

export function attachKeys(stage: Stage, pointer: PointerTools): void {
  const plain: Partial<Record<string, () => void>> = {
    v: () => (tool.value = 'select'),
    d: () => (tool.value = 'draw'),
    a: addCircle,
    g: () => (openDialog.value = 'gallery'),
    f: () => { stage.frameAll(); },
    p: () => { stage.facePlane(); },
    '?': () => (openDialog.value = 'help'),
    '[': () => { stepCurve(-1); },
    ']': () => { stepCurve(1); },
    ',': () => { stepVertex(-1); },
    '.': () => { stepVertex(1); },
    delete: deleteSelected,
    backspace: deleteSelected,
    escape: () => { escape(pointer); },
    ' ': () => {
      if (isGrowing.peek()) stage.skipGrowth();
      else stage.replay();
    },
  };
  kPlanes.forEach((plane, i) => {
    plain[String(i + 1)] = () => (drawing.value = { ...drawing.peek(), plane });
  });
  const withControl: Partial<Record<string, () => void>> = { z: undo, y: redo, o: chooseFile, s: saveSurface };

  window.addEventListener('keydown', (event) => {
    if (mode.peek() !== 'film' || event.defaultPrevented || event.altKey) return;
    if (openDialog.peek() !== null || isTyping(event)) return;
    const key = event.key.toLowerCase();
    const hasControl = event.ctrlKey || event.metaKey;
    // A button takes the space bar for itself.
    if (key === ' ' && event.target instanceof HTMLButtonElement) return;
    const action = hasControl ? (key === 'z' && event.shiftKey ? redo : withControl[key]) : plain[key];
    if (action) {
      event.preventDefault();
      action();
    } else if (!hasControl && event.target === stage.view.canvas && onArrow(stage, event)) {
      event.preventDefault();
    }
  });
}

function onArrow(stage: Stage, event: KeyboardEvent): boolean {
  const far = event.shiftKey ? 10 : 1;
  const moves: Partial<Record<string, readonly [right: number, up: number]>> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const move = moves[event.key];
  if (move) {
    if (!nudge(far * move[0], far * move[1])) stage.view.orbit(kTurn * move[0], -kTurn * move[1]);
    return true;
  }
  if (event.key === '+' || event.key === '=') stage.view.orbit(0, 0, 0.85);
  else if (event.key === '-') stage.view.orbit(0, 0, 1 / 0.85);
  else return false;
  return true;
}

/** Ends the nearest thing that can be ended. */
function escape(pointer: PointerTools): void {
  if (pointer.cancel()) return;
  if (solve.peek().phase === 'running') endSpan();
  else if (notice.peek() !== null) dismissNotice();
  else if (selection.peek() !== null) selection.value = null;
  else tool.value = 'select';
}

/** Whether the key belongs to a field; sliders and radio buttons keep only their arrows. */
function isTyping(event: KeyboardEvent): boolean {
  const { target } = event;
  if (!(target instanceof HTMLInputElement)) return false;
  const isText = !['range', 'radio', 'checkbox'].includes(target.type);
  return isText || event.key === ' ' || event.key.startsWith('Arrow');
}

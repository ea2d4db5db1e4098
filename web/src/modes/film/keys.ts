// Keys while films are made: one table.
import type { PointerTools } from '../scene/pointer.ts';
import type { Stage } from '../scene/stage.ts';
import type { PlaneKind } from '../shapes/plane.ts';
import { saveSurface } from '../state/files.ts';
import { endSpan, solve } from '../state/solving.ts';
import { dismissNotice, drawing, history, isGrowing, notice, selection, tool } from '../state/store.ts';
import { addCircle, deleteSelected, nudge, stepCurve, stepVertex } from './actions.ts';
import { openDialog } from './dialogs.tsx';
import { attachKeyboard } from './keyboard.ts';

const kPlanes: readonly PlaneKind[] = ['xy', 'yz', 'zx', 'view'];
const kTurn = Math.PI / 24;
const kCloser = 0.85;

export function attachKeys(stage: Stage, pointer: PointerTools): void {
  const plain: Partial<Record<string, () => void>> = {
    a: addCircle,
    g: () => (openDialog.value = 'gallery'),
    f: () => { stage.frameAll(); },
    p: () => { stage.facePlane(); },
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
  attachKeyboard({
    of: 'film',
    history,
    tool,
    plain,
    withControl: { s: saveSurface },
    canvas: stage.view.canvas,
    onArrow: (right, up, isFar) => {
      const far = isFar ? 10 : 1;
      if (!nudge(far * right, far * up)) stage.view.orbit(kTurn * right, -kTurn * up);
    },
    onZoom: (direction) => { stage.view.orbit(0, 0, direction === 'in' ? kCloser : 1 / kCloser); },
  });
}

/** Ends the nearest thing that can be ended. */
function escape(pointer: PointerTools): void {
  if (pointer.cancel()) return;
  if (solve.peek().phase === 'running') endSpan();
  else if (notice.peek() !== null) dismissNotice();
  else if (selection.peek() !== null) selection.value = null;
  else tool.value = 'select';
}

// The keyboard: one listener, for the actions of the page and of the mode that is shown.
import { endNudge } from '../scene/nudge.ts';
import { runByKey, type Action } from './actions.ts';
import { openDialog } from './dialogs.tsx';

export function attachKeyboard(canvas: HTMLCanvasElement, actions: () => readonly Action[]): void {
  window.addEventListener('keydown', (event) => {
    if (event.defaultPrevented) return;
    if (openDialog.peek() !== null || isTyping(event)) return;
    // A button takes the space bar for itself.
    if (event.key === ' ' && event.target instanceof HTMLButtonElement) return;
    if (runByKey(actions(), event, event.target === canvas)) event.preventDefault();
  });
  window.addEventListener('keyup', endNudge);
  window.addEventListener('blur', endNudge);
}

/** Whether the key belongs to a field; sliders and radio buttons keep only their arrows. */
function isTyping({ target, key }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLInputElement)) return false;
  const isText = !['range', 'radio', 'checkbox'].includes(target.type);
  return isText || key === ' ' || key.startsWith('Arrow');
}

// The keyboard: one listener, for the actions of the page and of the mode that is shown.
import { endNudge } from '../scene/nudge.ts';
import { runByKey, type Action } from './actions.ts';
import { openDialog } from './dialogs.tsx';

/** Actions that count while the pointer has begun something: they end it. */
const kWhileBusy = ['undo', 'escape'];

interface KeyboardOptions {
  readonly canvas: HTMLCanvasElement;
  readonly actions: () => readonly Action[];
  /** Whether the pointer has begun something. */
  readonly isBusy: () => boolean;
}

export function attachKeyboard({ canvas, actions, isBusy }: KeyboardOptions): void {
  window.addEventListener('keydown', (event) => {
    if (event.defaultPrevented) return;
    if (openDialog.peek() !== null || isTyping(event)) return;
    // A button takes the space bar for itself.
    if (event.key === ' ' && event.target instanceof HTMLButtonElement) return;
    const all = isBusy() ? actions().filter(({ id }) => kWhileBusy.includes(id)) : actions();
    if (runByKey(all, event, event.target === canvas)) event.preventDefault();
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

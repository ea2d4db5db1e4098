// The keyboard: one listener for each mode, the keys that both have, and the arrows while a canvas
// has the focus.
import type { Signal } from '@preact/signals';
import type { History } from '../state/history.ts';
import { mode, type Mode, type Tool } from '../state/store.ts';
import { chooseFile } from './bars.tsx';
import { openDialog } from './dialogs.tsx';

type Table = Partial<Record<string, () => void>>;

interface Keyboard {
  /** Keys count only while the page is in this mode. */
  readonly of: Mode;
  readonly history: Pick<History<unknown, unknown>, 'undo' | 'redo'>;
  readonly tool: Signal<Tool>;
  /** By `KeyboardEvent.key` in lower case, besides the tools and the help sheet. */
  readonly plain: Table;
  /** With Ctrl or ⌘, besides undo, redo and opening a file. */
  readonly withControl?: Table;
  readonly canvas: HTMLCanvasElement;
  /** An arrow, as steps of 1 along the screen's axes; `isFar`: with Shift. */
  readonly onArrow: (right: number, up: number, isFar: boolean) => void;
  readonly onZoom: (direction: 'in' | 'out') => void;
}

const kArrows: Partial<Record<string, readonly [right: number, up: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
const kZooms: Partial<Record<string, 'in' | 'out'>> = { '+': 'in', '=': 'in', '-': 'out' };

export function attachKeyboard({ of, history: { undo, redo }, tool, canvas, ...keyboard }: Keyboard): void {
  const plain: Table = {
    v: () => (tool.value = 'select'),
    d: () => (tool.value = 'draw'),
    '?': () => (openDialog.value = 'help'),
    ...keyboard.plain,
  };
  const withControl: Table = { z: undo, y: redo, o: chooseFile, ...keyboard.withControl };

  const actionOf = (event: KeyboardEvent): (() => void) | undefined => {
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) return key === 'z' && event.shiftKey ? redo : withControl[key];
    if (plain[key] || event.target !== canvas) return plain[key];
    const arrow = kArrows[event.key];
    if (arrow) return () => { keyboard.onArrow(...arrow, event.shiftKey); };
    const zoom = kZooms[key];
    return zoom && (() => { keyboard.onZoom(zoom); });
  };

  window.addEventListener('keydown', (event) => {
    if (mode.peek() !== of || event.defaultPrevented || event.altKey) return;
    if (openDialog.peek() !== null || isTyping(event)) return;
    // A button takes the space bar for itself.
    if (event.key === ' ' && event.target instanceof HTMLButtonElement) return;
    const action = actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** Whether the key belongs to a field; sliders and radio buttons keep only their arrows. */
function isTyping({ target, key }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLInputElement)) return false;
  const isText = !['range', 'radio', 'checkbox'].includes(target.type);
  return isText || key === ' ' || key.startsWith('Arrow');
}

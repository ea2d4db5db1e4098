// Actions: one record each, from which buttons, menus, keys and the help sheet are made.
import type { AnyIcon } from './icons.tsx';

/**
 * Where an action has a button: in the bar at the top (`document`, `open`, `edit`, `help`), among the tools, below them
 * with what takes away (`bin`), in the bar of the view, in the menu of exports.
 */
export type Bar = 'document' | 'open' | 'edit' | 'help' | 'tools' | 'bin' | 'view' | 'export';

export interface Action {
  readonly id: string;
  /** What it does; may change with the state, and is read as a signal is. */
  readonly label: string | (() => string);
  /** In the help sheet, where more is to be said than the label does. */
  readonly help?: string;
  /** The heading of the help sheet that it stands under; none: it is not in the sheet. */
  readonly section?: string;
  /**
   * `KeyboardEvent.key` in lower case, with `ctrl+` (or ⌘) and `shift+` before it; `canvas+` where it counts only
   * while the scene has the focus. The first is shown on buttons.
   */
  readonly keys?: readonly string[];
  /** Keys as the help sheet shows them, where they differ from `keys`. */
  readonly keysShown?: string;
  readonly bar?: Bar;
  readonly icon?: AnyIcon | (() => AnyIcon);
  /** Beside the icon where there is room, or in a menu. */
  readonly text?: string;
  /** A second word in a menu. */
  readonly note?: string;
  /** Whether it can be done now; read as a signal is. Absent: always. */
  readonly applies?: () => boolean;
  /** Whether its button is off although the key, which then says why, is not; read as a signal is. */
  readonly isOff?: () => boolean;
  /** Whether what it turns on is on; read as a signal is. Absent: it turns nothing on. */
  readonly isOn?: () => boolean;
  readonly run: (event?: KeyboardEvent) => void;
}

export const labelOf = ({ label }: Action): string => (typeof label === 'string' ? label : label());

/** Whether its button can be pressed; read as a signal is. */
export const isReady = ({ applies, isOff }: Action): boolean => (applies?.() ?? true) && !(isOff?.() ?? false);

/** A key or combination as it is written on buttons: "Ctrl Z". */
export function keysOf({ keys, keysShown }: Action): string | undefined {
  if (keysShown !== undefined) return keysShown;
  return keys?.[0]
    ?.replace('canvas+', '')
    // The plus sign may be the key itself.
    .split(/\+(?=.)/)
    .map((part) => kNames[part] ?? part[0].toUpperCase() + part.slice(1))
    .join(' ');
}

const kNames: Partial<Record<string, string>> = { delete: 'Del', escape: 'Esc', ' ': 'Space' };

/** The names of a pressed key, as in `Action.keys`. */
function namesOf(event: KeyboardEvent, isCanvas: boolean): string[] {
  const key = event.key.toLowerCase();
  // A sign that takes Alt or AltGr to be typed, as brackets do on many keyboards, is that sign.
  const isSign = event.key.length === 1 && !/[\p{L}\p{N}\s]/u.test(event.key);
  if (event.altKey) return isSign ? [key] : [];
  const isControl = event.ctrlKey || event.metaKey;
  if (isControl) return [`ctrl+${event.shiftKey ? 'shift+' : ''}${key}`];
  // Of signs and letters Shift is a part.
  const names = event.shiftKey && key.length > 1 ? [`shift+${key}`, key] : [key];
  return isCanvas ? [...names, ...names.map((name) => `canvas+${name}`)] : names;
}

/** Runs the first action that has the key and applies; says whether any has it. */
export function runByKey(actions: readonly Action[], event: KeyboardEvent, isCanvas: boolean): boolean {
  const names = namesOf(event, isCanvas);
  const found = actions.filter(({ keys }) => keys?.some((each) => names.includes(each)));
  found.find(({ applies }) => applies?.() ?? true)?.run(event);
  return found.length > 0;
}

// Actions: one record each, from which buttons, menus, keys and the help sheet are made.
import type { IconName } from './icons.tsx';

/** Where an action has a button: in the bar at the top, beside the tools, in the bar of the view, in the menu. */
export type Bar = 'document' | 'tools' | 'edit' | 'view' | 'export';

export interface Action {
  readonly id: string;
  /** What it does; may change with the state, and is read as a signal is. */
  readonly label: string | (() => string);
  /** In the help sheet, where more is to be said than the label does. */
  readonly help?: string;
  /** The heading of the help sheet that it stands under; none: it is not in the sheet. */
  readonly section?: 'Tools' | 'View' | 'Edit' | 'File';
  /**
   * `KeyboardEvent.key` in lower case, with `ctrl+` (or ⌘) and `shift+` before it; `canvas+` where it counts only
   * while the scene has the focus. The first is shown on buttons.
   */
  readonly keys?: readonly string[];
  /** Keys as the help sheet shows them, where they differ from `keys`. */
  readonly keysShown?: string;
  readonly bar?: Bar;
  readonly icon?: IconName | (() => IconName);
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
    .split('+')
    .map((part) => kNames[part] ?? part[0].toUpperCase() + part.slice(1))
    .join(' ');
}

const kNames: Partial<Record<string, string>> = { delete: 'Del', escape: 'Esc', ' ': 'Space' };

/** Runs the first action of the lists that has the key and applies; says whether there was one. */
export function runByKey(actions: readonly Action[], event: KeyboardEvent, isCanvas: boolean): boolean {
  const key = event.key.toLowerCase();
  const wanted = `${event.ctrlKey || event.metaKey ? 'ctrl+' : ''}${event.shiftKey && key.length > 1 ? 'shift+' : ''}${key}`;
  const names = event.ctrlKey && event.shiftKey ? [`ctrl+shift+${key}`] : [wanted, ...(isCanvas ? [`canvas+${wanted}`] : [])];
  const found = actions.find(({ keys }) => keys?.some((each) => names.includes(each)));
  if (!found) return false;
  if (found.applies?.() ?? true) found.run(event);
  return true;
}

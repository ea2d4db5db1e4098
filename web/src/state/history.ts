// A document with its history: commands make the next document, steps go back and forth.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals';

const kHistoryLimit = 200;

export interface History<D, C> {
  readonly doc: ReadonlySignal<D>;
  readonly canUndo: ReadonlySignal<boolean>;
  readonly canRedo: ReadonlySignal<boolean>;
  /**
   * Applies a command. Commands of one `gesture` (a drag, a slider's travel) become one step of
   * the history, until `endGesture`.
   */
  readonly dispatch: (command: C, gesture?: string | null) => void;
  readonly endGesture: () => void;
  /** Goes back to before the open gesture, as if it had not been. */
  readonly cancelGesture: () => void;
  /** Makes the document as it is the first of the history. */
  readonly forgetHistory: () => void;
  readonly undo: () => void;
  readonly redo: () => void;
}

/**
 * @param apply the document after a command; the same object where nothing changes
 * @param changed called within the batch in which the document changes
 */
export function createHistory<D, C>(
  empty: D,
  apply: (document: D, command: C) => D,
  changed: (document: D) => void,
): History<D, C> {
  const past = signal<readonly D[]>([]);
  const future = signal<readonly D[]>([]);
  const current = signal<D>(empty);
  let openGesture: string | null = null;

  const step = (from: typeof past, to: typeof past): void => {
    const next = from.peek().at(-1);
    if (next === undefined) return;
    openGesture = null;
    batch(() => {
      from.value = from.peek().slice(0, -1);
      to.value = [...to.peek(), current.peek()];
      current.value = next;
      changed(next);
    });
  };
  const undo = (): void => {
    step(past, future);
  };

  return {
    doc: computed(() => current.value),
    canUndo: computed(() => past.value.length > 0),
    canRedo: computed(() => future.value.length > 0),
    dispatch(command, gesture = null) {
      const before = current.peek();
      const after = apply(before, command);
      if (after === before) return;
      batch(() => {
        if (gesture === null || gesture !== openGesture) {
          past.value = [...past.peek().slice(1 - kHistoryLimit), before];
        }
        openGesture = gesture;
        future.value = [];
        current.value = after;
        changed(after);
      });
    },
    endGesture() {
      openGesture = null;
    },
    cancelGesture() {
      if (openGesture === null) return;
      undo();
      future.value = [];
    },
    forgetHistory() {
      openGesture = null;
      batch(() => {
        past.value = [];
        future.value = [];
      });
    },
    undo,
    redo() {
      step(future, past);
    },
  };
}

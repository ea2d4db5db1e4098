// The document with its history, one for all modes: commands make the next document, steps go back and forth.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals';
import { apply, type Command, type Document, type Group } from './document.ts';

const kHistoryLimit = 200;

/** What one step changed: every command is for one group. */
interface Step {
  readonly before: Group;
  readonly after: Group;
}

export interface History {
  readonly doc: ReadonlySignal<Document>;
  readonly canUndo: ReadonlySignal<boolean>;
  readonly canRedo: ReadonlySignal<boolean>;
  /** Whether a gesture is under way: what changes meanwhile is about to change again. */
  readonly isLive: ReadonlySignal<boolean>;
  /**
   * Applies a command. Commands of one `gesture` (a drag, a slider's travel) take each other's place, until
   * `endGesture`: all are applied to the document as it was before the first, and are one step of the history.
   */
  readonly dispatch: (command: Command, gesture?: string) => void;
  readonly endGesture: () => void;
  /** Goes back to before the open gesture, as if it had not been. */
  readonly cancelGesture: () => void;
  readonly undo: () => void;
  readonly redo: () => void;
  /** Adds a group, or puts it in the place of the one with its id, without a step. */
  readonly put: (group: Group) => void;
}

/** What a gesture has done so far: all its commands are applied to `before`. */
interface Gesture {
  readonly name: string;
  readonly before: Group;
  /** Whether the last step of the past is the gesture's; it has none where it changes nothing. */
  readonly hasStep: boolean;
}

/** @param changed called within the batch in which a group changes; `isStep`: by undo or redo */
export function createHistory(changed: (before: Group, after: Group, isStep: boolean) => void): History {
  const past = signal<readonly Step[]>([]);
  const future = signal<readonly Step[]>([]);
  const current = signal<Document>({ groups: [] });
  const gesture = signal<Gesture | null>(null);

  const groupBy = (id: number): Group => {
    const found = current.peek().groups.find((group) => group.id === id);
    if (found === undefined) throw new Error(`There is no group ${id}.`);
    return found;
  };
  const replace = (next: Group, isStep: boolean): void => {
    const present = groupBy(next.id);
    current.value = { groups: current.peek().groups.map((group) => (group === present ? next : group)) };
    changed(present, next, isStep);
  };
  const step = (from: typeof past, to: typeof past, read: keyof Step): void => {
    const taken = from.peek().at(-1);
    gesture.value = null;
    if (taken === undefined) return;
    batch(() => {
      from.value = from.peek().slice(0, -1);
      to.value = [...to.peek(), taken];
      replace(taken[read], true);
    });
  };

  return {
    doc: computed(() => current.value),
    canUndo: computed(() => past.value.length > 0),
    canRedo: computed(() => future.value.length > 0),
    isLive: computed(() => gesture.value !== null),
    dispatch(command, name) {
      const present = groupBy(command.group);
      const open = gesture.peek();
      const same = open !== null && open.name === name && open.before.id === present.id ? open : null;
      const before = same?.before ?? present;
      const after = apply(before, command);
      if (after === present) return;
      batch(() => {
        const kept = same?.hasStep ? past.peek().slice(0, -1) : past.peek();
        const hasStep = after !== before;
        past.value = hasStep ? [...kept.slice(1 - kHistoryLimit), { before, after }] : kept;
        future.value = [];
        gesture.value = name === undefined ? null : { name, before, hasStep };
        replace(after, false);
      });
    },
    endGesture() {
      gesture.value = null;
    },
    cancelGesture() {
      const open = gesture.peek();
      if (open === null) return;
      batch(() => {
        gesture.value = null;
        if (!open.hasStep) return;
        past.value = past.peek().slice(0, -1);
        replace(open.before, false);
      });
    },
    undo() {
      step(past, future, 'before');
    },
    redo() {
      step(future, past, 'after');
    },
    put(group) {
      const { groups } = current.peek();
      if (groups.some(({ id }) => id === group.id)) current.value = { groups: groups.map((each) => (each.id === group.id ? group : each)) };
      else current.value = { groups: [...groups, group] };
    },
  };
}

// Keeps a document as a draft: puts it back, and stores it whenever it has changed.
import { effect } from '@preact/signals';
import { reserveIds, type Document } from './document.ts';
import type { Problem } from './draft_reading.ts';
import { claimSlot, saveDraft, setAside, type Browser, type Claim } from './draft_slots.ts';
import type { History } from './history.ts';
import { complain, say } from './notice.ts';

/** Where the document came from; `none`: it is empty. */
export type Restored = Claim['from'];

export interface Drafts {
  /** Puts the draft of this tab, if there is one, into the document; never rejects. */
  readonly restore: () => Promise<Restored>;
  /**
   * Stores the document whenever it has changed, from now on, and says what there is to say about drafts. Call it when
   * the first room is shown: a change of rooms takes away what was said before.
   */
  readonly keep: () => void;
  /** Stores the document as it is, without waiting for a gesture's end: the page may be about to go. */
  readonly flush: () => void;
  /** Stores a copy that stays as it is, if anything is stored: not all of it could be read. Never rejects. */
  readonly setAside: () => Promise<void>;
}

/** Storage that has not answered by then is not waited for. */
const kPatienceMs = 10_000;

const kNoAnswer = new Error('No answer.');

const kAside: Record<Problem, string> = {
  version: 'A draft in this browser is of another version of this page and was not opened. It is kept.',
  broken: 'A draft in this browser is damaged and was not opened. It is kept.',
};

export function createDrafts(browser: Browser, history: Pick<History, 'doc' | 'isLive' | 'canUndo' | 'put'>): Drafts {
  const { doc, isLive, canUndo, put } = history;
  let slot = '';
  /** Whether there is something to lose: examples that nobody has touched are not stored. */
  let isDraft = false;
  /** The document as it is stored, or is going to be. */
  let stored = doc.peek();
  let hasComplained = false;
  let isLate = false;
  let remark = (): void => undefined;

  const write = async (next: Document): Promise<void> => {
    try {
      await saveDraft(browser, slot, next);
    } catch (error) {
      if (hasComplained) return;
      hasComplained = true;
      complain(`This browser keeps no draft: ${reasonOf(error)}. Save files to keep your work.`, 'draft');
    }
  };
  const writes = latestOnly(write);
  const storeIfDue = (): void => {
    if (doc.peek() === stored || !(isDraft || canUndo.peek())) return;
    isDraft = true;
    stored = doc.peek();
    writes.add(stored);
  };

  return {
    async restore() {
      let claim: Claim;
      try {
        claim = await within(kPatienceMs, claimSlot(browser));
      } catch (error) {
        // A slot that may hold a draft is let be: whoever comes next takes it over.
        isLate = error === kNoAnswer;
        claim = { slot: browser.newSlot(), doc: null, from: 'none', areAllHeld: false, problem: null };
      }
      slot = claim.slot;
      browser.memory.set(slot);
      if (claim.doc !== null) {
        reserveIds(claim.doc);
        claim.doc.groups.forEach(put);
        isDraft = true;
      }
      stored = doc.peek();
      remark = () => {
        if (isLate) complain('The drafts of this browser could not be read in time. They are kept.', 'draft');
        else remarkOn(claim, browser.hold !== null);
      };
      return claim.from;
    },
    keep() {
      remark();
      effect(() => {
        // Both are read, so that the effect follows both.
        const [, live] = [doc.value, isLive.value];
        if (!live) storeIfDue();
      });
    },
    flush() {
      storeIfDue();
      writes.hurry();
    },
    async setAside() {
      await setAside(browser, slot).catch(() => undefined);
    },
  };
}

function remarkOn({ from, areAllHeld, problem }: Claim, knowsTabs: boolean): void {
  if (problem !== null) complain(kAside[problem], 'draft');
  else if (areAllHeld) say('Your drawing is open in another tab. This tab has one of its own; both are kept.', 'draft');
  else if (from === 'copy' && knowsTabs) say('This tab has a copy of the drawing in the other tab. Each keeps its own from now on.', 'draft');
}

interface Latest<T> {
  readonly add: (value: T) => void;
  /** Calls with what still waits, at once. */
  readonly hurry: () => void;
}

/** Calls one after the other; of the values that come in the meantime only with the latest. */
export function latestOnly<T>(call: (value: T) => Promise<void>): Latest<T> {
  let isUnderWay = false;
  let waiting: { readonly value: T } | null = null;
  const callNext = (): Promise<void> | null => {
    const next = waiting;
    waiting = null;
    return next && call(next.value);
  };
  const run = async (): Promise<void> => {
    isUnderWay = true;
    for (let now = callNext(); now !== null; now = callNext()) await now;
    isUnderWay = false;
  };
  return {
    add(value) {
      waiting = { value };
      if (!isUnderWay) void run();
    },
    hurry() {
      void callNext();
    },
  };
}

function within<T>(ms: number, promise: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    setTimeout(reject, ms, kNoAnswer);
    promise.then(resolve, reject);
  });
}

function reasonOf(error: unknown): string {
  const { name = '', message = '' } = (error ?? {}) as Partial<Error>;
  if (name === 'QuotaExceededError') return 'its storage is full';
  return name === 'DataCloneError' ? message : 'it refuses storage';
}

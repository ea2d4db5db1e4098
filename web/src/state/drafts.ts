// Drafts: the document is stored in the browser after every gesture, and is there again when the page is. Each tab has
// a draft of its own.
import { createStore, del, get, keys, promisifyRequest } from 'idb-keyval';
import { createDrafts } from './draft_keeper.ts';
import type { Browser } from './draft_slots.ts';
import * as page from './store.ts';

export { adoptGroup } from './draft_reading.ts';
export type { Restored } from './draft_keeper.ts';

/** The browser that the page is in. */
function thisBrowser(): Browser {
  const database = createStore('soapfilm', 'drafts');
  // In places that are not secure there are none, whatever the types say.
  const locks = navigator.locks as LockManager | undefined;
  const kSlotKey = 'soapfilm draft';
  return {
    store: {
      // What throws at once, such as a browser without a database, rejects.
      keys: async () => keys<string>(database),
      get: async (key) => get<unknown>(key, database),
      set: async (key, value) =>
        database('readwrite', (store) => {
          store.put(value, key);
          // A browser that is not told so waits for the page to ask for more, and gives up when the page goes.
          store.transaction.commit();
          return promisifyRequest(store.transaction);
        }),
      del: async (key) => del(key, database),
    },
    hold: locks === undefined ? null : (name, waitMs) => holdLock(locks, name, waitMs),
    memory: {
      get() {
        try {
          return sessionStorage.getItem(kSlotKey);
        } catch {
          return null;
        }
      },
      set(slot) {
        try {
          sessionStorage.setItem(kSlotKey, slot);
        } catch {
          // The draft is found all the same, as that of a closed tab.
        }
      },
    },
    newSlot: () => `${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`,
    now: () => Date.now(),
  };
}

function holdLock(locks: LockManager, name: string, waitMs: number): Promise<boolean> {
  return new Promise((resolve, reject) => {
    const whenHeld = (lock: Lock | null): Promise<void> | undefined => {
      resolve(lock !== null);
      // Held until the tab is closed or loads another page.
      return lock === null ? undefined : new Promise(() => undefined);
    };
    const options: LockOptions = waitMs === 0 ? { ifAvailable: true } : { signal: AbortSignal.timeout(waitMs) };
    locks.request(name, options, whenHeld).catch((error: unknown) => {
      if (error instanceof DOMException && error.name === 'TimeoutError') resolve(false);
      else reject(new Error('Locks are refused.', { cause: error }));
    });
  });
}

const drafts = createDrafts(thisBrowser(), page);

export const restoreDraft = drafts.restore;
export const setDraftAside = drafts.setAside;

/** Stores the document whenever it has changed, and when the page is hidden or left. */
export function keepDrafts(): void {
  drafts.keep();
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') drafts.flush();
  });
  window.addEventListener('pagehide', drafts.flush);
}

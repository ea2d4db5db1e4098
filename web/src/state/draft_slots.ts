// Which draft is a tab's own, and how many are kept. The browser comes in only through `Browser`.
import type { Document } from './document.ts';
import { draftOf, isRecord, readDraft, type Problem } from './draft_reading.ts';

/** What of the browser drafts need; any of it may be missing or refuse. */
export interface Browser {
  /** What is stored, for all tabs. Its methods reject where storage is refused. */
  readonly store: {
    readonly keys: () => Promise<readonly string[]>;
    readonly get: (key: string) => Promise<unknown>;
    readonly set: (key: string, value: unknown) => Promise<void>;
    readonly del: (key: string) => Promise<void>;
  };
  /**
   * Holds a name for as long as the tab lives; resolves to false if another tab has held it all that time. Null where
   * tabs cannot know of each other.
   */
  readonly hold: ((name: string, waitMs: number) => Promise<boolean>) | null;
  /** The tab's slot, which outlives a reload of the page. */
  readonly memory: { readonly get: () => string | null; readonly set: (slot: string) => void };
  readonly newSlot: () => string;
  readonly now: () => number;
}

/** The slot of a tab, and how its draft came into it. */
export interface Claim {
  readonly slot: string;
  readonly doc: Document | null;
  /**
   * `own`: left there before the page was loaded again; `copy`: of a draft that another tab may hold; `closed`: left
   * by a tab that is closed; `none`: there is none.
   */
  readonly from: 'own' | 'copy' | 'closed' | 'none';
  /** Whether there are drafts and other tabs hold all of them. */
  readonly areAllHeld: boolean;
  /** What was wrong with a stored draft, which has been set aside. */
  readonly problem: Problem | null;
}

const kMostDrafts = 8;
/**
 * A page that is loaded again may have to wait so long until the one before has let go of its lock. Only a copied tab
 * waits in vain, and starts that much later.
 */
const kReloadMs = 2500;

const kPrefix = 'draft ';
const keyOf = (slot: string): string => kPrefix + slot;

const kNone = { doc: null, from: 'none', areAllHeld: false, problem: null } as const;

/** Finds the slot of a tab: its own, one that a closed tab has left, or a new one. */
export async function claimSlot(browser: Browser): Promise<Claim> {
  const own = browser.memory.get();
  if (own !== null && (await holds(browser, own, kReloadMs))) {
    const { doc, problem } = await take(browser, own);
    return { ...kNone, slot: own, doc, from: doc === null ? 'none' : 'own', problem };
  }
  const drafts = await draftsIn(browser);
  // A second tab with the memory of the first, or none that could know of others: the draft may be in use there.
  const original = own ?? (browser.hold === null ? drafts.at(0)?.slot : undefined);
  const claim = await (original === undefined ? takeOver(browser, drafts) : copy(browser, original));
  await prune(browser, drafts.filter(({ slot }) => slot !== claim.slot));
  return claim;
}

/** The latest draft that no tab holds. */
async function takeOver(browser: Browser, drafts: readonly Dated[]): Promise<Claim> {
  let isAnyFree = false;
  let problem: Problem | null = null;
  for (const { slot } of drafts) {
    if (!(await holds(browser, slot))) continue;
    isAnyFree = true;
    const found = await take(browser, slot);
    if (found.doc !== null) return { ...kNone, slot, doc: found.doc, from: 'closed', problem };
    problem ??= found.problem;
  }
  return { ...kNone, slot: await holdNew(browser), areAllHeld: drafts.length > 0 && !isAnyFree, problem };
}

/** A new slot with a copy of a draft that is left as it is. */
async function copy(browser: Browser, original: string): Promise<Claim> {
  const slot = await holdNew(browser);
  const found = readDraft(await browser.store.get(keyOf(original)));
  if (found === null || 'problem' in found) return { ...kNone, slot };
  await saveDraft(browser, slot, found.doc);
  return { ...kNone, slot, doc: found.doc, from: 'copy' };
}

async function holdNew(browser: Browser): Promise<string> {
  const slot = browser.newSlot();
  await holds(browser, slot);
  return slot;
}

export async function saveDraft({ store, now }: Browser, slot: string, doc: Document): Promise<void> {
  await store.set(keyOf(slot), draftOf(doc, now()));
}

async function holds({ hold }: Browser, slot: string, waitMs = 0): Promise<boolean> {
  return hold === null || hold(`soapfilm ${keyOf(slot)}`, waitMs);
}

/** Reads the draft of a slot that this tab holds; one that cannot be read is set aside, and never destroyed. */
async function take(browser: Browser, slot: string): Promise<{ doc: Document | null; problem: Problem | null }> {
  const found = readDraft(await browser.store.get(keyOf(slot)));
  if (found === null) return { doc: null, problem: null };
  if ('doc' in found) return { doc: found.doc, problem: null };
  await setAside(browser, slot);
  await browser.store.del(keyOf(slot));
  return { doc: null, problem: found.problem };
}

/** Stores a copy of a draft where it stays as it is. */
export async function setAside({ store, now }: Browser, slot: string): Promise<void> {
  const stored = await store.get(keyOf(slot));
  if (stored !== undefined) await store.set(`aside ${slot} ${now()}`, stored);
}

interface Dated {
  readonly slot: string;
  readonly time: number;
}

/** All drafts, the latest first. */
async function draftsIn({ store }: Browser): Promise<Dated[]> {
  const keys = (await store.keys()).filter((key) => key.startsWith(kPrefix));
  const dated = keys.map(async (key): Promise<Dated> => {
    const stored = await store.get(key);
    const time = isRecord(stored) && typeof stored.time === 'number' ? stored.time : 0;
    return { slot: key.slice(kPrefix.length), time };
  });
  return (await Promise.all(dated)).sort((a, b) => b.time - a.time);
}

/** Drops the oldest of the drafts that no tab holds, until there is room for one more. */
async function prune(browser: Browser, drafts: readonly Dated[]): Promise<void> {
  let count = drafts.length;
  for (const { slot } of [...drafts].reverse()) {
    if (count < kMostDrafts) return;
    if (!(await holds(browser, slot))) continue;
    await browser.store.del(keyOf(slot));
    count--;
  }
}

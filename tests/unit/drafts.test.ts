// Drafts: which one a tab keeps, what is restored of them, and what is said where the browser refuses.
import { beforeEach, describe, expect, test } from 'vitest';
import { newId, registerKind, type Document, type Group } from '../../web/src/state/document.ts';
import { createDrafts, latestOnly, type Restored } from '../../web/src/state/draft_keeper.ts';
import { adoptGroup, draftOf, readDraft } from '../../web/src/state/draft_reading.ts';
import type { Browser } from '../../web/src/state/draft_slots.ts';
import { createHistory } from '../../web/src/state/history.ts';
import { dismissNotice, notice } from '../../web/src/state/notice.ts';
import { dots, dotsItem } from '../support/dots_kind.js';

registerKind(dots);
beforeEach(dismissNotice);

const groupOf = (name: string): Group => ({ id: newId(), mode: 'test', name, settings: { size: 1 }, items: [dotsItem([1, 2])] });
const docOf = (name: string): Document => ({ groups: [groupOf(name)] });

/** A browser with tabs; each has its memory and the locks that it holds. */
class Fake {
  readonly stored = new Map<string, unknown>();
  readonly locks = new Map<string, Tab>();
  time = 0;
  slots = 0;
  /** Thrown by whatever is asked of the store. */
  refusal: Error | null = null;
  /** What stores wait for. */
  gate: Promise<void> = Promise.resolve();
  knowsTabs = true;

  open(memory: string | null = null): Tab {
    return new Tab(this, memory);
  }

  names(): string[] {
    const drafts = [...this.stored].filter(([key]) => key.startsWith('draft '));
    return drafts.map(([, value]) => (value as { doc: Document }).doc.groups[0].name).sort();
  }

  draft(slot: string, value: unknown = draftOf(docOf(slot), ++this.time)): void {
    this.stored.set(`draft ${slot}`, value);
  }
}

class Tab {
  readonly history = createHistory(() => undefined);
  readonly drafts;

  constructor(
    readonly fake: Fake,
    public memory: string | null,
  ) {
    const ask = async <T>(answer: () => T): Promise<T> => {
      if (fake.refusal) throw fake.refusal;
      await fake.gate;
      return answer();
    };
    const browser: Browser = {
      store: {
        keys: () => ask(() => [...fake.stored.keys()]),
        get: (key) => ask(() => structuredClone(fake.stored.get(key))),
        // The copy is made when it is asked for, as the browser does it.
        set: (key, value) => {
          const copy: unknown = structuredClone(value);
          return ask(() => void fake.stored.set(key, copy));
        },
        del: (key) => ask(() => void fake.stored.delete(key)),
      },
      hold: fake.knowsTabs
        ? (name) => {
            const isFree = !fake.locks.has(name);
            if (isFree) fake.locks.set(name, this);
            return Promise.resolve(isFree);
          }
        : null,
      memory: { get: () => this.memory, set: (slot) => (this.memory = slot) },
      newSlot: () => `new ${++fake.slots}`,
      now: () => ++fake.time,
    };
    this.drafts = createDrafts(browser, this.history);
  }

  async start(): Promise<Restored> {
    const restored = await this.drafts.restore();
    this.drafts.keep();
    return restored;
  }

  draw(name: string): void {
    const [group] = this.history.doc.peek().groups;
    if (!(group as Group | undefined)) {
      const made = groupOf('example');
      this.history.put(made);
      this.draw(name);
    } else this.history.dispatch({ type: 'open', group: group.id, name, items: [dotsItem([3])] });
  }

  close(): void {
    for (const [name, tab] of this.fake.locks) if (tab === this) this.fake.locks.delete(name);
  }

  reload(): Tab {
    this.close();
    return this.fake.open(this.memory);
  }

  get names(): string[] {
    return this.history.doc.value.groups.map(({ name }) => name);
  }
}

const settled = () => new Promise((resolve) => setTimeout(resolve));

describe('a tab', () => {
  test('drawn in and loaded again: has its drawing, ids are new, and nothing is said', async () => {
    const fake = new Fake();
    const tab = fake.open();
    expect(await tab.start()).toBe('none');
    tab.draw('mine');
    await settled();
    const again = tab.reload();
    expect([await again.start(), again.names, notice.value]).toEqual(['own', ['mine'], null]);
    expect(again.history.canUndo.value).toBe(false);
  });

  test('with a drawing of an earlier visit: new ids are none of its own', async () => {
    const fake = new Fake();
    fake.draft('own', draftOf({ groups: [{ ...groupOf('old'), id: 1e6 }] }, 1));
    await fake.open('own').start();
    expect(newId()).toBe(1e6 + 1);
  });

  test('left while a change waits for another to be stored: stores it at once', async () => {
    const fake = new Fake();
    const tab = fake.open();
    await tab.start();
    fake.gate = new Promise(() => undefined);
    tab.draw('first');
    fake.gate = Promise.resolve();
    tab.draw('second');
    await settled();
    expect(fake.stored.size).toBe(0);
    tab.drafts.flush();
    await settled();
    expect(fake.names()).toEqual(['second']);
  });

  test('with an example that nobody has touched: stores nothing', async () => {
    const fake = new Fake();
    const tab = fake.open();
    await tab.start();
    tab.history.put(groupOf('example'));
    tab.drafts.flush();
    await settled();
    expect(fake.stored.size).toBe(0);
  });

  test('once drawn in: every change is stored, undo and other rooms included', async () => {
    const fake = new Fake();
    const tab = fake.open();
    await tab.start();
    tab.draw('first');
    tab.history.undo();
    await settled();
    expect(fake.names()).toEqual(['example']);
    tab.history.put({ ...groupOf('second'), mode: 'other' });
    await settled();
    expect((fake.stored.get(`draft ${tab.memory ?? ''}`) as { doc: Document }).doc.groups).toHaveLength(2);
  });

  test('during a gesture: stores at its end, or when the page goes', async () => {
    const fake = new Fake();
    const tab = fake.open();
    await tab.start();
    const group = groupOf('example');
    tab.history.put(group);
    const dragTo = (size: number) => { tab.history.dispatch({ type: 'set', group: group.id, settings: { size } }, 'drag'); };
    const size = () => (fake.stored.get('draft new 1') as { doc: Document } | undefined)?.doc.groups[0].settings;
    dragTo(2);
    await settled();
    expect(size()).toBeUndefined();
    tab.drafts.flush();
    await settled();
    expect(size()).toEqual({ size: 2 });
    dragTo(3);
    tab.history.endGesture();
    await settled();
    expect(size()).toEqual({ size: 3 });
  });

  test('closed: the next tab takes the latest such drawing over', async () => {
    const fake = new Fake();
    fake.draft('older');
    fake.draft('latest');
    const tab = fake.open();
    expect([await tab.start(), tab.names, tab.memory, notice.value]).toEqual(['closed', ['latest'], 'latest', null]);
    const next = fake.open();
    expect([await next.start(), next.names]).toEqual(['closed', ['older']]);
  });
});

describe('two tabs', () => {
  test('the second begins anew, says so, and neither overwrites the other', async () => {
    const fake = new Fake();
    const first = fake.open();
    await first.start();
    first.draw('first');
    await settled();
    const second = fake.open();
    expect([await second.start(), second.names]).toEqual(['none', []]);
    expect(notice.value).toMatchObject({ kind: 'info', cause: 'draft' });
    expect(notice.value?.text).toContain('open in another tab');
    second.draw('second');
    first.draw('first again');
    await settled();
    expect(fake.names()).toEqual(['first again', 'second']);
    const again = [first.reload(), second.reload()];
    await Promise.all(again.map((tab) => tab.start()));
    expect(again.map((tab) => tab.names)).toEqual([['first again'], ['second']]);
  });

  test('the first has no drawing: nothing is said', async () => {
    const fake = new Fake();
    await fake.open().start();
    expect([await fake.open().start(), notice.value]).toEqual(['none', null]);
  });

  test('a tab that was duplicated: has a copy of its own at once', async () => {
    const fake = new Fake();
    const first = fake.open();
    await first.start();
    first.draw('first');
    await settled();
    const second = fake.open(first.memory);
    expect([await second.start(), second.names]).toEqual(['copy', ['first']]);
    expect(second.memory).not.toBe(first.memory);
    expect(notice.value?.text).toContain('copy');
    expect(fake.names()).toEqual(['first', 'first']);
    second.draw('second');
    await settled();
    expect(fake.names()).toEqual(['first', 'second']);
  });

  test('a browser in which tabs cannot know of each other: copies, never takes over', async () => {
    const fake = new Fake();
    fake.knowsTabs = false;
    fake.draft('left');
    const tab = fake.open();
    expect([await tab.start(), tab.names, notice.value]).toEqual(['copy', ['left'], null]);
    tab.draw('mine');
    await settled();
    expect(fake.names()).toEqual(['left', 'mine']);
    const again = fake.open(tab.memory);
    expect([await again.start(), again.names]).toEqual(['own', ['mine']]);
  });
});

describe('many drafts', () => {
  test('with that of a new tab eight are kept: the oldest that no tab holds go', async () => {
    const fake = new Fake();
    for (let i = 0; i < 11; i++) fake.draft(`${i}`);
    const holder = fake.open('0');
    await holder.start();
    const tab = fake.open();
    expect([await tab.start(), tab.names]).toEqual(['closed', ['10']]);
    expect(fake.names()).toEqual(['0', '10', '4', '5', '6', '7', '8', '9']);
  });
});

describe('a draft that cannot be read', () => {
  test.each<[string, unknown, string]>([
    ['of another version', { ...draftOf(docOf('x'), 1), version: 2 }, 'another version'],
    ['damaged', { version: 1, time: 1, doc: {} }, 'damaged'],
    ['of something else', 'text', 'damaged'],
  ])('%s: set aside as it is, and said', async (_, value, words) => {
    const fake = new Fake();
    fake.draft('own', value);
    const tab = fake.open('own');
    expect([await tab.start(), tab.names]).toEqual(['none', []]);
    expect(notice.value).toMatchObject({ kind: 'error', cause: 'draft' });
    expect(notice.value?.text).toContain(words);
    tab.draw('new');
    await settled();
    expect([...fake.stored.keys()].filter((key) => key.startsWith('aside'))).toHaveLength(1);
    expect([...fake.stored.values()]).toContainEqual(value);
    expect(fake.names()).toEqual(['new']);
  });

  test('of a closed tab: the next one is taken over', async () => {
    const fake = new Fake();
    fake.draft('good');
    fake.draft('bad', { version: 7, time: 99 });
    const tab = fake.open();
    expect([await tab.start(), tab.names]).toEqual(['closed', ['good']]);
    expect(notice.value?.text).toContain('another version');
  });

  test('setAside: a copy of what is stored', async () => {
    const fake = new Fake();
    fake.draft('own');
    const tab = fake.open('own');
    await tab.start();
    await tab.drafts.setAside();
    tab.draw('new');
    await settled();
    expect([...fake.stored].map(([key, value]) => [key.split(' ')[0], (value as { doc: Document }).doc.groups[0].name])).toEqual([
      ['draft', 'new'],
      ['aside', 'own'],
    ]);
  });
});

describe('a browser that refuses', () => {
  test.each([
    ['QuotaExceededError', 'its storage is full'],
    ['SecurityError', 'it refuses storage'],
  ])('%s: the page works, and says so once, when there is something to lose', async (name, words) => {
    const fake = new Fake();
    fake.refusal = Object.assign(new Error('no'), { name });
    const tab = fake.open();
    expect([await tab.start(), notice.value]).toEqual(['none', null]);
    tab.draw('mine');
    await settled();
    expect(notice.value).toMatchObject({ kind: 'error', cause: 'draft', text: `This browser keeps no draft: ${words}. Save files to keep your work.` });
    dismissNotice();
    tab.draw('more');
    await settled();
    expect(notice.value).toBeNull();
    await tab.drafts.setAside();
    fake.refusal = null;
    tab.draw('at last');
    await settled();
    expect(fake.names()).toEqual(['at last']);
  });

  test('for a while: the draft of that time is not overwritten', async () => {
    const fake = new Fake();
    fake.draft('own');
    fake.refusal = new Error('busy');
    const tab = fake.open('own');
    await tab.start();
    fake.refusal = null;
    tab.draw('new');
    await settled();
    expect(fake.names()).toEqual(['new', 'own']);
  });
});

test('latestOnly: one at a time, and of those that wait only the latest', async () => {
  const called: number[] = [];
  const ends: (() => void)[] = [];
  const { add, hurry } = latestOnly<number>((value) => {
    called.push(value);
    return new Promise((resolve) => ends.push(resolve));
  });
  [1, 2, 3].forEach(add);
  expect(called).toEqual([1]);
  ends[0]();
  await settled();
  expect(called).toEqual([1, 3]);
  [4, 5].forEach(add);
  hurry();
  hurry();
  expect(called).toEqual([1, 3, 5]);
  ends.forEach((end) => { end(); });
  await settled();
  add(6);
  expect(called).toEqual([1, 3, 5, 6]);
});

describe('readDraft', () => {
  const good = draftOf({ groups: [groupOf('a'), groupOf('b')] }, 1);
  const [a, b] = good.doc.groups;
  const withGroups = (...groups: unknown[]) => ({ ...good, doc: { groups } });

  test('what was stored: the same again', () => {
    expect(readDraft(structuredClone(good))).toEqual({ doc: good.doc });
    expect(readDraft(undefined)).toBeNull();
    expect(readDraft(withGroups())).toEqual({ doc: { groups: [] } });
  });

  test.each<[string, unknown]>([
    ['null', null],
    ['no version', { ...good, version: undefined }],
    ['no document', { ...good, doc: null }],
    ['groups that are no list', { ...good, doc: { groups: {} } }],
    ['a group that is none', withGroups(a, null)],
    ['two of one id', withGroups(a, { ...b, id: a.id })],
    ['an object with the id of a group', withGroups(a, { ...b, items: [{ ...b.items[0], id: a.id }] })],
    ['an id that is no number', withGroups({ ...a, id: '1' })],
    ['an id of no whole number', withGroups({ ...a, id: 1.5 })],
    ['an id too large to count on', withGroups({ ...a, id: Number.MAX_SAFE_INTEGER })],
    ['a name that is no text', withGroups({ ...a, name: 5 })],
    ['no mode', withGroups({ ...a, mode: undefined })],
    ['settings that are a list', withGroups({ ...a, settings: [] })],
    ['no objects', withGroups({ ...a, items: undefined })],
    ['an object without a shape', withGroups({ ...a, items: [{ id: 3, kind: 'dots' }] })],
    ['an object without a kind', withGroups({ ...a, items: [{ id: 3, shape: [] }] })],
  ])('%s: damaged', (_, stored) => {
    expect(readDraft(stored)).toEqual({ problem: 'broken' });
  });
});

describe('adoptGroup', () => {
  test('objects that no kind can read: left out and counted', () => {
    const group = { ...groupOf('a'), items: [dotsItem([1]), { ...dotsItem([2]), kind: 'ghost' }, { ...dotsItem([3]), shape: 'broken' }] };
    const { group: adopted, lost } = adoptGroup(group, [dots], {});
    expect([adopted.items, lost]).toEqual([[group.items[0]], 2]);
  });

  test('settings: what is saved where it is of the type, what is preset for the rest', () => {
    const preset = { size: 1, name: 'a', on: true, weights: { area: 1, angle: 2 }, most: null, list: [1] };
    const adopt = (settings: object) => adoptGroup({ ...groupOf('a'), settings }, [dots], preset).group.settings;
    const saved = { size: 2, name: 'b', on: false, weights: { area: 3, angle: 4 }, most: null, list: [] };
    expect(adopt({ ...saved, gone: 1 })).toEqual(saved);
    expect(adopt({})).toEqual(preset);
    expect(adopt({ size: '2', name: null, on: 0, weights: { area: 3 }, most: 5, list: {} })).toEqual(preset);
    expect(adopt({ size: NaN, weights: null })).toEqual(preset);
    expect(adoptGroup({ ...groupOf('a'), settings: saved }, [dots]).group.settings).toEqual(saved);
  });
});

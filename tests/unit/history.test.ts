// The history of the document: gestures, steps back and forth, and what is chosen meanwhile.
import { beforeAll, beforeEach, describe, expect, test } from 'vitest';
import { newId, registerKind, type Group, type Id, type Place } from '../../web/src/state/document.ts';
import { createHistory } from '../../web/src/state/history.ts';
import { complain, notice } from '../../web/src/state/notice.ts';
import * as store from '../../web/src/state/store.ts';
import { dots, dotsItem, type Dots } from '../support/dots_kind.js';

beforeAll(() => {
  registerKind(dots);
});

const newGroup = (mode = 'test'): Group => ({ id: newId(), mode, name: 'Test', settings: {}, items: [dotsItem([0, 1]), dotsItem([2])] });

function setUp(mode = 'test') {
  const changes: [mode: string, isStep: boolean][] = [];
  const history = createHistory((_, group, isStep) => changes.push([group.mode, isStep]));
  const group = newGroup(mode);
  history.put(group);
  const first: Place = { item: group.items[0].id, part: 0, handle: 0 };
  const drag = (to: number, gesture?: string) => {
    history.dispatch({ type: 'move', group: group.id, places: [first], by: [to, 0, 0] }, gesture);
  };
  const x = () => (history.doc.peek().groups[0].items[0].shape as Dots)[0][0];
  const can = () => [history.canUndo.value, history.canRedo.value];
  return { history, group, drag, x, can, changes };
}

describe('a gesture', () => {
  test('that comes back to where it began and goes on: still one step, and the step before it stays', () => {
    const { history, drag, x, can } = setUp();
    drag(1);
    [1, 0, 2].forEach((by) => { drag(by, 'drag'); });
    expect(x()).toBe(3);
    history.endGesture();
    history.undo();
    expect([x(), ...can()]).toEqual([1, true, true]);
    history.undo();
    expect([x(), ...can()]).toEqual([0, false, true]);
  });

  test('that is cancelled where it began: the step before it stays', () => {
    const { history, drag, x, can } = setUp();
    drag(1);
    [1, 0].forEach((by) => { drag(by, 'drag'); });
    history.cancelGesture();
    expect([x(), ...can()]).toEqual([1, true, false]);
    drag(0, 'drag');
    history.cancelGesture();
    expect([x(), ...can()]).toEqual([1, true, false]);
  });

  test('one step, and the next gesture of that name another', () => {
    const { history, drag, x, can } = setUp();
    [1, 2, 3].forEach((by) => { drag(by, 'drag'); });
    expect([x(), history.isLive.value]).toEqual([3, true]);
    history.endGesture();
    expect(history.isLive.value).toBe(false);
    [4, 5].forEach((by) => { drag(by, 'drag'); });
    expect(x()).toBe(8);
    history.undo();
    expect(x()).toBe(3);
    history.undo();
    expect([x(), ...can()]).toEqual([0, false, true]);
    history.redo();
    history.redo();
    expect([x(), ...can()]).toEqual([8, true, false]);
  });

  test('back where it began: no step', () => {
    const { drag, x, can } = setUp();
    drag(1, 'drag');
    drag(0, 'drag');
    expect([x(), ...can()]).toEqual([0, false, false]);
  });

  test('cancelled: as if it had not been', () => {
    const { history, drag, x, can } = setUp();
    drag(1);
    [2, 3].forEach((by) => { drag(by, 'drag'); });
    history.cancelGesture();
    expect([x(), ...can(), history.isLive.value]).toEqual([1, true, false, false]);
    history.cancelGesture();
    expect(x()).toBe(1);
  });

  test('another command in between: ends it', () => {
    const { history, drag, x } = setUp();
    drag(1, 'drag');
    drag(1);
    expect(history.isLive.value).toBe(false);
    drag(1, 'drag');
    expect(x()).toBe(3);
  });
});

describe('steps', () => {
  test('a change after undo: ends the redo', () => {
    const { history, drag, can } = setUp();
    drag(1);
    history.undo();
    drag(2);
    expect(can()).toEqual([true, false]);
  });

  test('a command without effect: no step', () => {
    const { drag, can, changes } = setUp();
    drag(0);
    expect([can(), changes]).toEqual([[false, false], []]);
  });

  test('many: the oldest are forgotten, none of the latest 200', () => {
    const { history, drag, x, can } = setUp();
    for (let i = 1; i <= 250; i++) drag(1);
    for (let i = 0; i < 200; i++) history.undo();
    expect([x(), ...can()]).toEqual([50, false, true]);
  });

  test('of two groups: undone in the order they were made, each in its own', () => {
    const { history, drag, x, changes } = setUp('film');
    const other = newGroup('polygon');
    history.put(other);
    drag(1);
    history.dispatch({ type: 'clear', group: other.id });
    drag(1);
    history.undo();
    history.undo();
    expect([x(), history.doc.value.groups[1]]).toEqual([1, other]);
    expect(changes.filter(([, isStep]) => isStep).map(([mode]) => mode)).toEqual(['film', 'polygon']);
  });

  test('put: no step, in place of the group with that id', () => {
    const { history, group, can } = setUp();
    history.put({ ...group, name: 'Other' });
    expect([history.doc.value.groups.map(({ name }) => name), can()]).toEqual([['Other'], [false, false]]);
  });

  test('a group that is not there: an error', () => {
    const { history } = setUp();
    expect(() => { history.dispatch({ type: 'clear', group: -1 }); }).toThrow('no group -1');
  });
});

describe('the store', () => {
  let group: Group;
  beforeEach(() => {
    store.mode.value = 'test';
    group = store.ensureGroup('test', {});
    store.dispatch({ type: 'open', group: group.id, name: 'Test', items: [dotsItem([0, 1, 2], [3, 4, 5]), dotsItem([6])] });
    group = store.groupOf('test', {}).value;
  });
  const place = (item: number, part: number, handle: number | null): Place => ({ item: group.items[item].id, part, handle });
  const remove = (...places: Place[]) => { store.dispatch({ type: 'delete', group: group.id, places }); };

  test('ensureGroup: made once', () => {
    expect(store.ensureGroup('test', {}).id).toBe(group.id);
  });

  test('places that are gone: not chosen any more; the others are', () => {
    const kept = place(0, 0, 1);
    store.choose(kept, place(1, 0, 0), null);
    expect(store.chosen.value).toEqual(place(1, 0, 0));
    store.hover.value = place(1, 0, null);
    remove(place(1, 0, null));
    expect([store.selection.value, store.hover.value]).toEqual([[kept], null]);
  });

  test('places of an object whose vertices have other numbers now: not chosen any more', () => {
    const [a, b, other] = [place(0, 0, 1), place(0, 0, 2), place(1, 0, null)];
    store.choose(a, b, other);
    remove(a, b);
    expect(store.selection.value).toEqual([other]);
    store.choose(place(0, 0, 0));
    store.undo();
    expect(store.selection.value).toEqual([]);
    store.choose(a);
    store.dispatch({ type: 'move', group: group.id, places: [a], by: [1, 0, 0] });
    expect(store.selection.value).toEqual([a]);
  });

  test('what another mode changes: leaves the choice alone', () => {
    store.choose(place(0, 0, 1));
    const other = store.ensureGroup('other', {});
    store.dispatch({ type: 'set', group: other.id, settings: { size: Math.random() } });
    expect(store.selection.value).toEqual([place(0, 0, 1)]);
  });

  test('undo and redo: tell the mode that they changed', () => {
    const shown: string[] = [];
    store.onStep((mode) => shown.push(mode));
    remove(place(1, 0, null));
    store.undo();
    store.redo();
    store.onStep(() => undefined);
    expect(shown).toEqual(['test', 'test']);
  });

  test('a change: answers a complaint', () => {
    complain('No.', 'stroke');
    remove(place(1, 0, null));
    expect(notice.value).toBeNull();
  });

  test('stepping through parts and handles: wraps round', () => {
    store.choose();
    const seen = [1, 1, 1, 1].map((step) => {
      store.stepPart(step as 1);
      return [group.items.findIndex(({ id }: { id: Id }) => id === store.chosen.value?.item), store.chosen.value?.part];
    });
    expect(seen).toEqual([[0, 0], [0, 1], [1, 0], [0, 0]]);
    store.choose(place(0, 1, null));
    const handles = ([1, 1, 1, 1, -1] as const).map((step) => {
      store.stepHandle(step);
      return store.chosen.value?.handle;
    });
    expect(handles).toEqual([3, 4, 5, 3, 5]);
  });
});

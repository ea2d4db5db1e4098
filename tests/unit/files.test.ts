// Opening files: together, as one step, each other file named with what can open it.
import { parseLoops, SoapfilmError } from 'soapfilm';
import { beforeEach, describe, expect, test, vi } from 'vitest';
import type { Content } from '../../web/src/app/content.ts';
import { countOf, fileStem, listed, openFiles, save, type Destination } from '../../web/src/app/files.ts';
import type { Mode, ReadFile, Room } from '../../web/src/app/mode.ts';
import { film } from '../../web/src/modes/film/mode.ts';
import { polygon } from '../../web/src/modes/polygon/mode.ts';
import { registerKind } from '../../web/src/state/document.ts';
import { complain, dismissNotice, notice } from '../../web/src/state/notice.ts';
import * as store from '../../web/src/state/store.ts';
import { dots, dotsItem } from '../support/dots_kind.js';

registerKind(dots);

const kCurve = '1 3\n3\n0 0 0\n1 0 0\n0 1 0\n';
const kTwo = '2 6\n3\n0 0 0\n1 0 0\n0 1 0\n3\n0 0 1\n1 0 1\n0 1 1\n';
const kNamed = '{ "name": "Kite", "loops": [[[0,0,0],[1,0,0],[0,1,0]]] }';
const kMesh = 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';
const kGeo = '{ "type": "FeatureCollection", "features": [] }';
const kFilmOpens = 'Film opens a .curve file, a JSON file of loops or an OBJ file of lines.';

const file = (name: string, data: BlobPart = kCurve) => new File([data], name);

/** One object for each loop; of GeoJSON one. */
function read(kind: string, { text }: Content): ReadFile {
  if (kind === 'geojson') return { items: [dotsItem([0])] };
  const { starts, name } = parseLoops(text);
  return { items: Array.from(starts.subarray(1), (end) => dotsItem([end])), ...(name !== undefined && { name }) };
}

const roomOf = (nouns: readonly [string, string], reader: Room['read'] = read) => ({ nouns, read: reader, settings: {} }) as unknown as Room;
const rooms: Record<string, { mode: Mode; room: Room }> = {
  film: { mode: film, room: roomOf(['curve', 'curves']) },
  polygon: { mode: polygon, room: roomOf(['polygon', 'polygons']) },
};
const go = vi.fn<Destination['go']>((id) => {
  store.mode.value = id;
  return Promise.resolve(rooms[id] ?? null);
});
const into = (id: string): Destination => ({ ...rooms[id], modes: [film, polygon], go });
const open = async (...files: File[]) => {
  await openFiles(files, into('film'));
  return notice.value?.text;
};
const shown = () => store.group.value;

beforeEach(() => {
  dismissNotice();
  go.mockClear();
  store.mode.value = 'film';
  store.ensureGroup('polygon', {});
  store.dispatch({ type: 'clear', group: store.ensureGroup('film', {}).id });
  store.framing.value = null;
});

describe('openFiles', () => {
  test('one: named by itself or by its file, chosen none, all in view', async () => {
    expect(await open(file('box.curve', kTwo))).toBe('Opened “box.curve”: 2 curves.');
    expect([shown()?.name, shown()?.items.length, notice.value?.kind]).toEqual(['box', 2, 'info']);
    store.choose({ item: shown()?.items[0].id ?? 0, part: 0, handle: null });
    expect(await open(file('a.b.json', kNamed))).toBe('Opened “a.b.json”: 1 curve.');
    expect([shown()?.name, store.selection.value, store.framing.value]).toEqual(['Kite', [], { atOnce: false }]);
  });

  test('several: together, as one step of the history', async () => {
    expect(await open(file('a.curve'), file('b.json', kTwo))).toBe('Opened “a.curve” and “b.json”: 3 curves.');
    expect([shown()?.name, shown()?.items.length]).toEqual(['a and 1 more', 3]);
    store.undo();
    expect(shown()?.items).toEqual([]);
    const many = Array.from({ length: 9 }, (_, i) => file(`${i}.curve`));
    expect(await open(...many)).toBe('Opened “0.curve”, “1.curve” and 7 more: 9 curves.');
  });

  test('some that are none: the others are opened, each of these is named', async () => {
    expect(await open(file('a.curve'), file('m.off', kMesh), file('bad.curve', '1 3\n3\n0 0 zero\n'), file('b.curve'))).toBe(
      'Opened “a.curve” and “b.curve”: 2 curves. Could not open “bad.curve”: Line 3: "zero" is not a finite number. ' +
        `Could not open “m.off”: it is a mesh (OFF), which no mode opens. ${kFilmOpens}`,
    );
    expect([shown()?.items.length, notice.value?.kind]).toEqual([2, 'error']);
  });

  test('none of them: nothing changes, those of a kind are told together', async () => {
    const before = store.doc.value;
    const png = Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0);
    expect(await open(file('a.curve', png), file('no.json', 'no'), file('b.png', png), file('c.txt', 'word'))).toBe(
      'Could not open “a.curve” and “b.png”: each is a PNG picture, which no mode opens. ' +
        `Could not open “no.json” and “c.txt”: each is in no format that is known here. ${kFilmOpens}`,
    );
    expect(store.doc.value).toBe(before);
  });

  test('of another mode: says which, and goes there to open them', async () => {
    expect(await open(file('countries.geojson', kGeo))).toBe('“countries.geojson” is a GeoJSON file: the mode Polygon opens it.');
    expect(notice.value?.action?.label).toBe('Open in Polygon');
    notice.value?.action?.run();
    await vi.waitFor(() => { expect(notice.value?.text).toBe('Opened “countries.geojson”: 1 polygon.'); });
    expect([go.mock.calls, shown()?.mode, shown()?.name]).toEqual([[['polygon'], ['polygon']], 'polygon', 'countries']);
    store.mode.value = 'film';
    expect(await open(file('a.json', kGeo), file('b.json', kGeo))).toBe('“a.json” and “b.json” are each a GeoJSON file: the mode Polygon opens them.');
  });

  test('of another mode that cannot be fetched: what going there has said stays', async () => {
    await open(file('countries.geojson', kGeo));
    go.mockImplementationOnce(() => {
      complain('Polygon could not be fetched.', 'mode');
      return Promise.resolve(null);
    });
    notice.value?.action?.run();
    await Promise.resolve();
    expect(notice.value?.text).toBe('Polygon could not be fetched.');
  });

  test('in the mode of polygons: GeoJSON is its own', async () => {
    store.mode.value = 'polygon';
    await openFiles([file('a.txt', kGeo)], into('polygon'));
    expect(notice.value?.text).toBe('Opened “a.txt”: 1 polygon.');
  });

  test('empty, too large, or not to be read: said', async () => {
    expect(await open(file('empty.curve', ' \n\ufeff'))).toBe('Could not open “empty.curve”: it is empty.');
    const large = Object.defineProperty(file('large.curve'), 'size', { value: 80 * 2 ** 20 });
    expect(await open(large)).toBe('Could not open “large.curve”: it has 80 MB; no more than 64 are opened.');
    const folder = Object.defineProperty(file('folder'), 'arrayBuffer', { value: () => Promise.reject(new Error('folder')) });
    expect(await open(folder)).toBe('Could not open “folder”: the browser could not read it.');
  });

  test.each([
    [new SoapfilmError('bad-file', 'it has no polygons'), 'it has no polygons.'],
    [new TypeError('Failed to fetch dynamically imported module: x'), 'what reads files could not be loaded.'],
    [new RangeError('Too long.'), 'Too long.'],
  ])('a reader that fails with %s: its reason in words', async (error, words) => {
    const failing = { ...into('film'), room: roomOf(['curve', 'curves'], () => Promise.reject(error)) };
    await openFiles([file('a.curve')], failing);
    expect(notice.value?.text).toBe(`Could not open “a.curve”: ${words}`);
  });

  test('tried anew: an old complaint about files goes, another one stays', async () => {
    complain('old', 'file');
    await openFiles([], into('film'));
    expect(notice.value).toBeNull();
    complain('old', 'mode');
    await openFiles([], into('film'));
    expect(notice.value?.text).toBe('old');
  });
});

test('save: says what is wrong where it cannot be written', async () => {
  save('a.obj', 'model/obj', () => Promise.reject(new TypeError('error loading dynamically imported module')));
  await vi.waitFor(() => { expect(notice.value?.text).toBe('Could not save “a.obj”: what writes files could not be loaded.'); });
  save('a.obj', 'model/obj', () => {
    throw new SoapfilmError('not-finite', 'Vertex 3 is not finite');
  });
  await vi.waitFor(() => { expect(notice.value?.text).toBe('Could not save “a.obj”: Vertex 3 is not finite.'); });
});

test('words: counts, lists, names of files', () => {
  expect([countOf(1, 'curve'), countOf(12_000, 'curve'), countOf(2, 'mesh', 'meshes')]).toEqual(['1 curve', '12,000 curves', '2 meshes']);
  expect([listed([]), listed(['a']), listed(['a', 'b', 'c'], undefined, 'or')]).toEqual(['', 'a', 'a, b or c']);
  expect([fileStem('Two facing saddles (3)'), fileStem('“…”')]).toEqual(['two-facing-saddles-3', 'soapfilm']);
});

// The mode of meshes: its examples, which loops bound one hole, and patches as part of a mesh.
import { fillHoles, findHoles, load } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { colorsOf } from '../../web/src/modes/mesh/attributes.ts';
import { kExamples } from '../../web/src/modes/mesh/examples.ts';
import { holesOf, join, split } from '../../web/src/modes/mesh/grouping.ts';
import { meshKind } from '../../web/src/modes/mesh/mesh_kind.ts';
import { areMeshSettings, kSettings, type MeshShape } from '../../web/src/modes/mesh/settings.ts';
import { loopAt, noteRims, placeOf, rimsOf, wholeOf } from '../../web/src/modes/mesh/whole.ts';
import { countTwins, weld } from '../../web/src/modes/mesh/weld.ts';
import { wordsForDefect } from '../../web/src/modes/mesh/wording.ts';
import { distanceOf, shareAlong, type Eye, type Spot } from '../../web/src/scene/eye.ts';
import type { Point } from '../../web/src/shapes/vec.ts';
import { newItem } from '../../web/src/state/document.ts';
import { Random } from '../support/generators.js';

beforeAll(() => load({ parts: ['meshes'] }));

describe('examples', () => {
  test.each(kExamples.map(({ title, shape }) => [title, shape] as const))('%s: has holes, islands and no defects, and is filled', (_, shape) => {
    const mesh = shape();
    const { groups, defects } = findHoles(mesh);
    expect(defects).toEqual([]);
    expect(groups.some(({ why }) => why === 'island')).toBe(true);
    const { holes } = fillHoles(mesh);
    expect(holes.map(({ status }) => status)).toEqual(groups.map(({ isOpenRim }) => (isOpenRim ? 'open-rim' : 'filled')));
  });
});

const [torus] = kExamples;

describe('holes', () => {
  test('split, joined, and as found where nothing was said', () => {
    const report = findHoles(torus.shape());
    const found = holesOf(report, []);
    expect(found.map(({ loops }) => loops)).toEqual(report.groups.map(({ loops }) => loops));
    const hole = found.findIndex(({ loops }) => loops.length === 3);
    const apart = split([], found[hole]);
    const after = holesOf(report, apart);
    expect(after).toHaveLength(found.length + 2);
    expect(after.flatMap(({ loops }) => loops).sort()).toEqual(found.flatMap(({ loops }) => loops).sort());
    const parts = after.filter(({ loops }) => found[hole].loops.includes(loops[0]));
    const again = holesOf(report, join(apart, parts, report));
    expect(again.map(({ loops }) => [...loops].sort())).toEqual(found.map(({ loops }) => [...loops].sort()));
    expect(again[hole].loops[0]).toBe(found[hole].loops[0]);
    expect(again[hole].why).toBe('given');
  });

  test('loops that there are not: are passed over', () => {
    const report = findHoles(torus.shape());
    expect(holesOf(report, [[999]])).toEqual(holesOf(report, []));
    expect(holesOf(report, [[0, 999], [0]])).toHaveLength(holesOf(report, [[0]]).length);
  });
});

describe('several meshes', () => {
  test('are worked on as one; each has its own rims', () => {
    const items = kExamples.map(({ shape }) => newItem(meshKind, shape()));
    const whole = wholeOf(items);
    const report = findHoles(whole);
    expect(report.loops.length).toBe(items.reduce((sum, { shape }) => sum + findHoles(shape).loops.length, 0));
    noteRims(whole, report);
    report.loops.forEach(({ vertices }, loop) => {
      const place = placeOf(whole, loop);
      if (place === null) throw new Error(`Loop ${loop} is nowhere.`);
      expect(loopAt(whole, place)).toBe(loop);
      const k = items.findIndex(({ id }) => id === place.item);
      const rims = rimsOf(items[k].shape);
      expect(Array.from(rims.vertices.subarray(rims.starts[place.part], rims.starts[place.part + 1]), (v) => v + whole.starts[k])).toEqual([...vertices]);
    });
  });
});

describe('the kind', () => {
  test('picking: the rim nearest to a place, by brute force', () => {
    // Single triangles, each with a rim of its own, and a look along z.
    const seed = 5;
    const random = new Random(seed);
    const { positions: p, faces: corners } = torus.shape();
    const positions = Float32Array.from([...corners].flatMap((vertex) => [...p.subarray(3 * vertex, 3 * vertex + 3)]));
    const shape: MeshShape = { positions, faces: Uint32Array.from(corners, (_, i) => i) };
    const whole = wholeOf([newItem(meshKind, shape)]);
    noteRims(whole, findHoles(whole));
    const at = ([x, y]: readonly number[]) => ({ x: 100 * x, y: 100 * y, visible: true });
    const axis: Point = [0, 0, 1];
    const eye: Eye = {
      project: at,
      pixelSize: () => 0.01,
      ray: (x, y) => ({ from: [x, y, 0], direction: axis }),
      axes: () => ({ right: [1, 0, 0], up: [0, 1, 0], toViewer: axis }),
    };
    const { starts, vertices } = rimsOf(shape);
    const distanceTo = (part: number, spot: Spot): number => {
      const rim = [...vertices.subarray(starts[part], starts[part + 1])].map((vertex) => at(positions.subarray(3 * vertex, 3 * vertex + 2) as unknown as number[]));
      return Math.min(...rim.map((a, i) => {
        const b = rim[(i + 1) % rim.length];
        const share = shareAlong(spot, a, b);
        return distanceOf(spot, { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) });
      }));
    };
    let hits = 0;
    for (let i = 0; i < 60; i++) {
      const spot = { x: random.range(-220, 220), y: random.range(-220, 220) };
      const least = Math.min(...Array.from({ length: starts.length - 1 }, (_, part) => distanceTo(part, spot)));
      const hit = meshKind.pick(shape, eye, spot, 2);
      expect(hit !== null, `seed ${seed}, place ${i}`).toBe(least < 2);
      if (hit === null) continue;
      hits++;
      expect(hit.distance, `seed ${seed}, place ${i}`).toBeCloseTo(least, 9);
      expect(distanceTo(hit.part, spot), `seed ${seed}, place ${i}`).toBeCloseTo(least, 9);
    }
    expect(hits).toBeGreaterThan(10);
    expect(hits).toBeLessThan(55);
  });

  test('what was saved: is read if it is a mesh', () => {
    const shape: MeshShape = { positions: new Float32Array(9), faces: new Uint32Array([0, 1, 2]) };
    expect(meshKind.read(structuredClone(shape))).toEqual(shape);
    for (const saved of [
      null,
      {},
      { ...shape, faces: [0, 1, 2] },
      { ...shape, faces: new Uint32Array([0, 1, 3]) },
      { ...shape, faces: new Uint32Array([0, 1]) },
      { ...shape, positions: new Float32Array([NaN, ...new Float32Array(8)]) },
    ]) {
      expect(meshKind.read(saved)).toBeNull();
    }
  });

  test('settings: those of another version are told', () => {
    expect(areMeshSettings(kSettings)).toBe(true);
    expect(areMeshSettings({ ...kSettings, filled: ['a'] as unknown as number[] })).toBe(false);
    expect(areMeshSettings({ ...kSettings, groups: [5] as unknown as number[][] })).toBe(false);
    expect(areMeshSettings({ ...kSettings, density: 9 })).toBe(false);
    expect(areMeshSettings({ ...kSettings, creaseAngle: 0 })).toBe(false);
  });
});

test('defects: in words, one or many', () => {
  const [faces, none] = [new Uint32Array(2), new Uint32Array()];
  expect(wordsForDefect({ kind: 'duplicate-face', faces, edges: none, vertices: none })).toBe('2 faces are there twice: kept as they are.');
  expect(wordsForDefect({ kind: 'unused-vertex', faces: none, edges: none, vertices: new Uint32Array(1) })).toBe('1 vertex is in no face: kept as it is.');
});

test('welding: seams go, faces that fold to nothing go, all else stays in order', () => {
  const soup: MeshShape = {
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, -0, 1, 0]),
    faces: new Uint32Array([0, 1, 2, 3, 4, 5, 1, 3, 4]),
  };
  expect(countTwins(soup, [0, 1, 2, 3, 4, 5, 5])).toBe(2);
  expect(weld(soup)).toEqual({ positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]), faces: new Uint32Array([0, 1, 2, 1, 3, 2]) });
  expect(Object.is(soup.positions[15], -0)).toBe(true);
});

describe('attributes of vertices', () => {
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
  const faces = new Uint32Array([0, 1, 2, 3, 4, 5]);
  const color = { data: Float32Array.from({ length: 18 }, (_, i) => i / 18), size: 3 };
  const uv = { data: Float32Array.from({ length: 12 }, (_, i) => i), size: 2 };

  test('in a draft: kept, but for what are none of so many vertices', () => {
    expect(meshKind.read({ positions, faces, attributes: { color, uv } })).toEqual({ positions, faces, attributes: { color, uv } });
    for (const attributes of [5, { color: null }, { color: { ...color, size: 4 } }, { color: { data: [...color.data], size: 3 } }]) {
      expect(meshKind.read({ positions, faces, attributes })).toEqual({ positions, faces });
    }
  });

  test('in a draft, with numbers that are not finite: those are left out, and the others kept', () => {
    for (const x of [NaN, Infinity]) {
      const broken = { ...color, data: color.data.map((each, i) => (i === 7 ? x : each)) };
      expect(meshKind.read({ positions, faces, attributes: { color: broken, uv } })).toEqual({ positions, faces, attributes: { uv } });
      expect(meshKind.read({ positions, faces, attributes: { color: broken } })).toEqual({ positions, faces });
    }
  });

  test('welded: those of the first vertex at each place', () => {
    const { attributes } = weld({ positions, faces, attributes: { color, uv } });
    const kept = (data: Float32Array, size: number) => [0, 1, 2, 4].flatMap((v) => [...data.subarray(size * v, size * (v + 1))]);
    expect([...(attributes?.color.data ?? [])]).toEqual(kept(color.data, 3));
    expect([...(attributes?.uv.data ?? [])]).toEqual(kept(uv.data, 2));
  });

  test('of several meshes: what all have is of all, and drawn where it is a colour', () => {
    const both = wholeOf([
      newItem(meshKind, { positions, faces, attributes: { color, uv } }),
      newItem(meshKind, { positions, faces, attributes: { uv: color, color } }),
    ]);
    expect(Object.keys(both.attributes ?? {})).toEqual(['color']);
    expect(colorsOf(both)?.data).toEqual(Float32Array.from([...color.data, ...color.data]));
    expect(colorsOf({ attributes: { color: uv } })).toBeNull();
    expect(wholeOf([newItem(meshKind, { positions, faces }), newItem(meshKind, { positions, faces, attributes: { color } })])).not.toHaveProperty('attributes');
  });
});

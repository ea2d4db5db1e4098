// Patches in the mode of meshes: those of holes that split the same face, those that cross, and which are filled again.
import { fillHoles, findHoles, load, type FillOptions, type HoleReport, type MeshLike } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { holesOf, type Hole } from '../../web/src/modes/mesh/grouping.ts';
import { meshKind } from '../../web/src/modes/mesh/mesh_kind.ts';
import { currentAmong, dueAmong, keyOf, patchesIn, withPatches, type Patches } from '../../web/src/modes/mesh/patches.ts';
import type { MeshShape } from '../../web/src/modes/mesh/settings.ts';
import { wholeOf, type Whole } from '../../web/src/modes/mesh/whole.ts';
import { newItem } from '../../web/src/state/document.ts';
import { areaOfNew, cut, openEdges, pointOf, sphere, together, turned, type Mesh } from '../support/meshes.js';

beforeAll(() => load({ parts: ['meshes'] }));

const kManner = 'any';

/** A mesh with its holes, and patches of some of them at once. */
class Room {
  readonly whole: Whole;
  readonly report: HoleReport;
  readonly holes: readonly Hole[];
  private readonly making;

  constructor(
    shape: MeshShape,
    groups: (report: HoleReport) => readonly (readonly number[])[],
    private readonly options: FillOptions = {},
  ) {
    this.whole = wholeOf([newItem(meshKind, shape)]);
    this.report = findHoles(this.whole);
    this.holes = holesOf(this.report, groups(this.report));
    this.making = { of: this.whole, manner: kManner };
  }

  fill(some: readonly Hole[], output: 'mesh' | 'patches' = 'patches') {
    const named = { groups: some.map(({ loops }) => loops), holes: some.map((_, i) => i) };
    return fillHoles(this.whole, { ...this.options, ...named, output });
  }

  /** The patches with those of these holes in place of what they had. */
  after(kept: Patches, some: readonly Hole[]): Patches {
    return new Map([...kept, ...patchesIn(this.fill(some), some, this.making)]);
  }

  current(all: readonly Hole[], kept: Patches): Hole[] {
    return all.filter(currentAmong(all, kept, this.making));
  }

  due(all: readonly Hole[], kept: Patches): Hole[] {
    return dueAmong(all, kept, this.making, this.report);
  }
}

/** A flat disc of six corners and four faces. */
function disc(x: number, y: number, z: number): Mesh {
  const corners = Array.from({ length: 6 }, (_, i) => [x + 0.3 * Math.cos((Math.PI * i) / 3), y + 0.3 * Math.sin((Math.PI * i) / 3), z]);
  return { positions: Float64Array.from(corners.flat()), faces: Uint32Array.of(0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5) };
}

/**
 * A plate with two holes on either side of one long face, which touches the plate's other part with its tip. Each hole
 * has two islands, above and below a long side of the face: no sphere through its ends is without a vertex of theirs.
 */
function plate(): MeshShape {
  const corners = [[-3, -3], [15, -3], [15, 13], [-3, 13], [0, 0], [12, 0], [12, 5], [12, 10], [0, 10], [0, 5.5], [0, 4.5]];
  const faces = [0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 7, 6, 2, 3, 8, 2, 8, 7, 0, 4, 10, 0, 10, 3, 3, 10, 9, 3, 9, 8, 9, 10, 6];
  const frame = { positions: Float64Array.from(corners.flatMap(([x, y]) => [x, y, 0])), faces: Uint32Array.from(faces) };
  const islands = [[5, 5 + 7 / 24], [7, 5 - 5 / 24]].flatMap(([x, y]) => [disc(x, y, 1), turned(disc(x, y, -1))]);
  const { positions, faces: all } = together(frame, ...islands);
  return { positions: Float32Array.from(positions), faces: all };
}

const kLongFace = 11;

/** The two holes, with the islands that are theirs. */
function plateGroups({ loops }: HoleReport): number[][] {
  const at = (vertex: number): number => loops.findIndex(({ vertices }) => vertices.includes(vertex));
  return [[at(4), at(23), at(29)], [at(8), at(11), at(17)]];
}

/** The triangles of a mesh by the places of their corners, in an order of their own. */
const trianglesOf = (mesh: MeshLike): string[] =>
  Array.from({ length: mesh.faces.length / 3 }, (_, f) => {
    const corners = [...mesh.faces.subarray(3 * f, 3 * f + 3)].map((vertex) => pointOf(mesh, vertex).map(Math.fround).join(' '));
    const first = corners.indexOf([...corners].sort()[0]);
    return [...corners.slice(first), ...corners.slice(0, first)].join(', ');
  }).sort();

describe('two holes that split the same face', () => {
  const open = (): Room => {
    const room = new Room(plate(), plateGroups, { candidates: 'delaunay' });
    const [, a, b] = room.holes;
    // Else this is about nothing.
    for (const some of [[a], [b], [a, b]]) expect(room.fill(some).splitFaces.map(({ face }) => face)).toEqual([kLongFace]);
    return room;
  };

  test('filled at once: one mesh, as the library has it', () => {
    const room = open();
    const both = room.holes.slice(1);
    const patches = [...room.after(new Map(), both).values()];
    expect(patches[0].added).toBe(patches[1].added);
    const filled = withPatches(room.whole, patches);
    expect(trianglesOf(filled)).toEqual(trianglesOf(room.fill(both, 'mesh').mesh));
    // But for the plate's own rim.
    expect(openEdges(filled.faces)).toHaveLength(4);
    for (const vertex of filled.faces) expect(3 * vertex).toBeLessThan(filled.positions.length);
    expect(new Set(filled.faces).size).toBe(filled.positions.length / 3);
  });

  test('in any order of patches, and each alone: its pieces once, which make up the face', () => {
    const room = open();
    const both = room.holes.slice(1);
    const together = [...room.after(new Map(), both).values()];
    expect(trianglesOf(withPatches(room.whole, [...together].reverse()))).toEqual(trianglesOf(withPatches(room.whole, together)));
    for (const hole of both) {
      const [patch] = room.after(new Map(), [hole]).values();
      expect(trianglesOf(withPatches(room.whole, [patch]))).toEqual(trianglesOf(room.fill([hole], 'mesh').mesh));
    }
    const [{ added }] = together;
    const pieces = { positions: Float32Array.from([...room.whole.positions, ...added.positions]), faces: added.split[0].pieces };
    const given = { positions: room.whole.positions, faces: room.whole.faces.subarray(3 * kLongFace, 3 * kLongFace + 3) };
    const area = (mesh: MeshLike): number => areaOfNew({ ...room.fill(both), mesh, oldFaces: 0 });
    expect(area(pieces)).toBeCloseTo(area(given), 5);
  });

  test('one after the other: both are filled again, and one of them when the other goes', () => {
    const room = open();
    const both = room.holes.slice(1);
    const [a, b] = both;
    let kept = room.after(new Map(), [a]);
    expect(room.current([a], kept)).toEqual([a]);
    expect(room.due(both, kept)).toEqual(both);
    kept = room.after(kept, both);
    expect(room.current(both, kept)).toEqual(both);
    expect(room.due(both, kept)).toEqual([]);
    expect(room.current([b], kept)).toEqual([]);
    kept = room.after(kept, room.due([b], kept));
    expect(room.current([b], kept)).toEqual([b]);
    // The other one is kept as it was beside the first's earlier patch.
    expect(room.current(both, kept)).toEqual([b]);
    expect(room.due(both, kept)).toEqual(both);
  });
});

describe('patches that cross', () => {
  const moved = ({ positions, faces }: Mesh, by: number): Mesh => ({ positions: positions.map((x, i) => (i % 3 === 0 ? x + by : x)), faces });

  /** Two spheres without the caps in which they would meet, and the second without one on its far side as well. */
  function open(): { room: Room; left: Hole; right: Hole; far: Hole } {
    const ball = sphere(6);
    const spheres = [moved(cut(ball, ([x]) => x > 0.5), -0.9), moved(cut(ball, ([x]) => x < -0.5 || x > 0.7), 0.9)];
    const { positions, faces } = together(...spheres);
    const room = new Room({ positions: Float32Array.from(positions), faces }, ({ loops }) => loops.map((_, loop) => [loop]));
    const placeOf = ({ loops: [loop] }: Hole): number => room.whole.positions[3 * room.report.loops[loop].vertices[0]];
    const [left, right, far] = [...room.holes].sort((a, b) => placeOf(a) - placeOf(b));
    return { room, left, right, far };
  }

  const statuses = (holes: readonly Hole[], kept: Patches) => holes.map((hole) => kept.get(keyOf(hole))?.result.status);

  test('name each other and no others', () => {
    const { room, left, right, far } = open();
    const kept = room.after(new Map(), room.holes);
    const [a, b, c] = [left, right, far].map((hole) => kept.get(keyOf(hole)));
    expect(statuses([left, right, far], kept)).toEqual(['self-intersecting', 'self-intersecting', 'filled']);
    expect([...(a?.peers ?? [])]).toEqual([[keyOf(right), b]]);
    expect([...(b?.peers ?? [])]).toEqual([[keyOf(left), a]]);
    expect(c?.peers.size).toBe(0);
    expect(a?.crossing).not.toEqual([]);
    expect(b?.crossing).not.toEqual([]);
  });

  test('one that is left: the other one is filled again, and crosses nothing; with both again they cross', () => {
    const { room, left, right, far } = open();
    let kept = room.after(new Map(), room.holes);
    const rest = [right, far];
    expect(room.current(rest, kept)).toEqual([far]);
    expect(room.due(rest, kept)).toContain(right);
    kept = room.after(kept, room.due(rest, kept));
    expect(room.current(rest, kept)).toEqual(rest);
    expect(statuses(rest, kept)).toEqual(['filled', 'filled']);
    expect(kept.get(keyOf(right))).toMatchObject({ crossing: [], crossed: [] });
    const again = room.due(room.holes, kept);
    expect(again).toContain(left);
    expect(again).toContain(right);
    kept = room.after(kept, again);
    expect(room.current(room.holes, kept)).toEqual(room.holes);
    expect(statuses([left, right], kept)).toEqual(['self-intersecting', 'self-intersecting']);
  });

  test('one near what is missing: the other one comes with it', () => {
    const { room, left, right, far } = open();
    const kept = room.after(new Map(), [left, right]);
    const apart = room.after(new Map(), [left]);
    // The left one is too far from the missing one by itself.
    expect(room.due([left, far], apart)).toEqual([far]);
    expect(new Set(room.due(room.holes, kept))).toEqual(new Set([left, right, far]));
    const after = room.after(kept, room.due(room.holes, kept));
    expect(room.current(room.holes, after)).toEqual(room.holes);
    expect(statuses([left, right], after)).toEqual(['self-intersecting', 'self-intersecting']);
  });
});

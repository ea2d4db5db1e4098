// Rims that only a surface with further vertices on them can span: the faces along them are split, and nothing else.
import { fillHoles, findHoles, load, type FillOptions, type FillResult, type MeshLike } from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { areaOfNew, openEdges, together, turned, type Mesh } from '../support/meshes.js';

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker({ size: 2 });
});
afterAll(() => {
  film.dispose();
});

/** A flat disc of six corners and four faces. */
function disc(x: number, y: number): Mesh {
  const corners = Array.from({ length: 6 }, (_, i) => [x + 0.3 * Math.cos((Math.PI * i) / 3), y + 0.3 * Math.sin((Math.PI * i) / 3), 0]);
  return { positions: Float64Array.from(corners.flat()), faces: Uint32Array.of(0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5) };
}

/**
 * A plate with a hole into which a long tongue reaches, and two islands on either side of it: no sphere through the ends
 * of a long side of the tongue is without other vertices, so no Delaunay triangle has such a side.
 */
function plate(second = disc(5, 6)): Mesh {
  const hole = [[0, 0], [12, 0], [12, 10], [0, 10], [0, 5.5], [10, 5.5], [10, 4.5], [0, 4.5]];
  const outside = [[-3, -3], [15, -3], [15, 13], [-3, 13]];
  const faces = [8, 9, 1, 8, 1, 0, 9, 10, 2, 9, 2, 1, 10, 11, 3, 10, 3, 2, 8, 0, 7, 8, 7, 4, 8, 4, 3, 8, 3, 11, 7, 6, 5, 7, 5, 4];
  const frame = { positions: Float64Array.from([...hole, ...outside].flatMap(([x, y]) => [x, y, 0])), faces: Uint32Array.from(faces) };
  return together(frame, disc(5, 4), second);
}

const kPlate = plate();
const kArea = 18 * 16;
/** The faces of the tongue. */
const kTongue = [10, 11];

/** The group of the hole: all loops but the rim of the plate. */
function holeOf(mesh: MeshLike): number[][] {
  const { loops } = findHoles(mesh);
  return [loops.flatMap(({ vertices }, i) => (vertices.includes(8) ? [] : [i]))];
}

const area = (mesh: MeshLike): number => areaOfNew({ mesh, oldFaces: 0 } as FillResult);

/** Every edge but the four of the plate's rim has a face on each side, and no edge has three. */
const expectWhole = ({ faces }: MeshLike): void => {
  expect(openEdges(faces)).toHaveLength(4);
};

const options: FillOptions = { candidates: 'delaunay', groups: [[1, 2, 3]] };

describe('faces along a rim that had to be split', () => {
  test('are those alone, in pieces that make up the same surface; the rest is as given', () => {
    const result = fillHoles(kPlate, { ...options, groups: holeOf(kPlate) });
    const { mesh, splitFaces, oldFaces, oldVertices, holes } = result;
    expect(holes.map(({ status }) => status)).toEqual(['filled']);
    expect(splitFaces.map(({ face }) => face).sort((a, b) => a - b)).toEqual(kTongue);
    expect(mesh.positions.slice(0, 3 * oldVertices)).toEqual(kPlate.positions);
    for (let f = 0; f < oldFaces; f++) {
      const split = splitFaces.find(({ face }) => face === f);
      expect(mesh.faces.slice(3 * f, 3 * f + 3)).toEqual(split ? split.corners : kPlate.faces.slice(3 * f, 3 * f + 3));
    }
    for (const { face, first, count } of splitFaces) {
      const pieces = [face, ...Array.from({ length: count }, (_, i) => first + i)];
      const corners = Uint32Array.from(pieces.flatMap((f) => [...mesh.faces.subarray(3 * f, 3 * f + 3)]));
      const given = { positions: kPlate.positions, faces: kPlate.faces.slice(3 * face, 3 * face + 3) };
      expect(area({ positions: mesh.positions, faces: corners })).toBeCloseTo(area(given), 12);
    }
    expectWhole(mesh);
    expect(area(mesh)).toBeCloseTo(kArea, 9);
    const [{ faces: [from, to] }] = holes;
    expect([from, to]).toEqual([oldFaces + splitFaces.reduce((sum, { count }) => sum + count, 0), mesh.faces.length / 3]);
  });

  test('none, where other candidates do without', () => {
    const { splitFaces, mesh } = fillHoles(kPlate, { groups: holeOf(kPlate) });
    expect(splitFaces).toEqual([]);
    expectWhole(mesh);
  });

  test('none, if there may be no new vertices', () => {
    const { splitFaces, holes } = fillHoles(kPlate, { ...options, maxNewVertices: 0 });
    expect(splitFaces).toEqual([]);
    expect(holes[0]).toMatchObject({ status: 'failed', reason: 'inserted-vertices' });
  });

  test('output patches: the new part alone, which the corners of split faces complete', () => {
    const whole = fillHoles(kPlate, options);
    const { mesh, splitFaces, oldFaces, oldVertices } = fillHoles(kPlate, { ...options, output: 'patches' });
    expect(splitFaces).toEqual(whole.splitFaces);
    expect(mesh.positions).toEqual(whole.mesh.positions.slice(3 * oldVertices));
    expect(mesh.faces).toEqual(whole.mesh.faces.slice(3 * oldFaces));
  });

  test('attributes go on as they were along the rim', () => {
    // Linear, so the same on pieces as on the face.
    const data = Float32Array.from({ length: kPlate.positions.length / 3 }, (_, v) => kPlate.positions[3 * v] / 8);
    const { mesh } = fillHoles({ ...kPlate, attributes: { x: { data, size: 1 } } }, options);
    const { splitFaces } = fillHoles(kPlate, options);
    const corners = splitFaces.flatMap(({ first, count }) => [...mesh.faces.subarray(3 * first, 3 * (first + count))]);
    for (const v of corners) expect(mesh.attributes?.x.data[v]).toBeCloseTo(mesh.positions[3 * v] / 8, 6);
  });

  test('positions in single precision: so are those of the new vertices', () => {
    const { mesh, holes } = fillHoles({ ...kPlate, positions: Float32Array.from(kPlate.positions) }, options);
    expect(mesh.positions).toBeInstanceOf(Float32Array);
    expect(holes[0].status).toBe('filled');
    expectWhole(mesh);
  });

  test('with other holes: those are filled as they would be', () => {
    // A box without its lid beside the plate.
    const box: Mesh = {
      positions: Float64Array.of(30, 0, 0, 34, 0, 0, 34, 4, 0, 30, 4, 0, 30, 0, 4, 34, 0, 4, 34, 4, 4, 30, 4, 4),
      faces: Uint32Array.of(0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7),
    };
    const both = together(kPlate, box);
    const lid = findHoles(both).loops.findIndex(({ vertices }) => vertices.length === 4 && !vertices.includes(8));
    const groups = [[lid], ...holeOf(both).map((loops) => loops.filter((loop) => loop !== lid))];
    const { mesh, holes } = fillHoles(both, { ...options, groups });
    expect(holes.map(({ status }) => status)).toEqual(['filled', 'filled']);
    expectWhole(mesh);
    expect(area(mesh)).toBeCloseTo(kArea + 6 * 16, 9);
  });

  test('of two holes: both, or the one that can be filled; the other says what is wrong with it', async () => {
    const far = ({ positions, faces }: Mesh): Mesh => ({ positions: positions.map((x, i) => (i % 3 === 2 ? x + 50 : x)), faces });
    const groups = (mesh: Mesh): number[][] => {
      const loops = findHoles(mesh).loops.map(({ vertices }, i) => ({ i, first: Math.min(...vertices), size: vertices.length }));
      const half = mesh.positions.length / 6;
      const inside = loops.filter(({ size }) => size !== 4);
      return [inside.filter(({ first }) => first < half).map(({ i }) => i), inside.filter(({ first }) => first >= half).map(({ i }) => i)];
    };
    const good = together(kPlate, far(kPlate));
    const both = fillHoles(good, { ...options, groups: groups(good) });
    expect(both.holes.map(({ status }) => status)).toEqual(['filled', 'filled']);
    expect(both.splitFaces.map(({ face }) => face).sort((a, b) => a - b)).toEqual([10, 11, 30, 31]);
    expect(openEdges(both.mesh.faces)).toHaveLength(8);
    // An island that is inside out.
    const bad = together(kPlate, far(plate(turned(disc(5, 6)))));
    const one = fillHoles(bad, { ...options, groups: groups(bad) });
    expect(one.holes.map(({ status, reason }) => [status, reason])).toEqual([['filled', undefined], ['failed', 'opposed-rims']]);
    expect(one.splitFaces.map(({ face }) => face).sort((a, b) => a - b)).toEqual(kTongue);
    expect(one.mesh.faces.slice(3 * 30, 3 * 32)).toEqual(bad.faces.slice(3 * 30, 3 * 32));
    expect(await film.fillHoles(bad, { ...options, groups: groups(bad) })).toEqual(one);
  });

  test('in a worker: the same', async () => {
    const [here, there] = [fillHoles(kPlate, options), await film.fillHoles(kPlate, options)];
    expect(there).toEqual(here);
  });
});

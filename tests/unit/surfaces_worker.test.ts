// Trimmed models in threads: what they answer is what they answer here, and no call that is ended harms them.
import { load } from 'soapfilm';
import { TrimmedModel, type Model, type ModelInstance } from 'soapfilm/surfaces';
import { createWorker, type Film, type TrimmedModelHandle } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { rejectionOf } from '../support/errors.js';
import { box, measure, modelOf, plate, tube } from '../support/models.js';

const kHole = [[0.25, 0.25], [0.75, 0.25], [0.5, 0.75]];
/** Takes a while where it is to be fine. */
const kMany: Model = {
  instances: Array.from({ length: 100 }, (_, i): ModelInstance => ({ part: tube(), matrix: [1 + i, 0, 0, 300 * i, 0, 1, 0, 0, 0, 0, 1, 0] })),
};

let film: Film;
beforeAll(async () => {
  await load({ parts: ['surfaces'] });
  film = await createWorker({ parts: ['surfaces'] });
});
afterAll(() => {
  film.dispose();
});

async function withBoth(model: Model, use: (here: TrimmedModel, there: TrimmedModelHandle) => Promise<void>): Promise<void> {
  const here = new TrimmedModel(model);
  const there = await film.createTrimmedModel(model);
  await use(here, there);
  here.dispose();
  there.dispose();
}

describe('createTrimmedModel', () => {
  test('tessellate and update: the same as here, ranges included', () =>
    withBoth(kMany, async (here, there) => {
      expect(await there.tessellate({ relative: 1e-3 })).toEqual(here.tessellate({ relative: 1e-3 }));
      for (const relative of [1e-3, 1e-4, 1e-2]) expect(await there.update({ relative })).toEqual(here.update({ relative }));
    }));

  test('poles that move: the same as here, and errors too', () =>
    withBoth(modelOf(plate([kHole])), async (here, there) => {
      here.movePole(0, 3, [2, 1, 0.5]);
      here.moveTrim(0, 1, 0, 2, [0.5, 0.9]);
      // In their order, without waiting.
      const moves = [there.movePole(0, 3, [2, 1, 0.5]), there.moveTrim(0, 1, 0, 2, [0.5, 0.9])];
      expect(await there.update()).toEqual(here.update());
      await Promise.all(moves);
      expect(await rejectionOf(there.moveTrim(0, 1, 0, 2, [5, 5]))).toMatchObject({ face: 0, loop: 1 });
      expect((await rejectionOf(there.movePole(0, 77, [0, 0, 0]))).code).toBe('bad-option');
      expect((await rejectionOf(there.movePole(0, 0, [0, NaN, 0]))).message).toMatch(/`at`/);
      expect(await there.tessellate()).toEqual(here.tessellate());
    }));

  test('a fault: is that of TrimmedModel, or told where faces are left out', async () => {
    const bad = modelOf(plate([kHole.map(([u, v]) => [u + 0.5, v])]));
    const error = await rejectionOf(film.createTrimmedModel(bad));
    expect(error).toMatchObject({ face: 0 });
    expect(() => new TrimmedModel(bad)).toThrow(error.message);
    const crooked = { ...box(), edges: [] };
    expect(await rejectionOf(film.createTrimmedModel(crooked))).toMatchObject({ code: 'bad-edge', face: 0, loop: 0, use: 0 });
    for (const model of [bad, crooked]) {
      const there = await film.createTrimmedModel(model, { skipInvalid: true });
      const here = new TrimmedModel(model, { skipInvalid: true });
      const mesh = await there.tessellate();
      expect(mesh.reports.length).toBeGreaterThan(0);
      expect(mesh).toEqual(here.tessellate());
      there.dispose();
      here.dispose();
    }
  });

  test('onProgress: hears of the end; what it throws ends the call, and the model goes on', async () => {
    const there = await film.createTrimmedModel(kMany);
    const heard: number[] = [];
    await there.tessellate({ relative: 1e-5, onProgress: (fraction) => heard.push(fraction) });
    expect(heard.at(-1)).toBe(1);
    expect(heard).toEqual([...heard].sort((a, b) => a - b));
    const reason = new Error('enough');
    const stop = (): never => {
      throw reason;
    };
    await expect(there.tessellate({ relative: 1e-8, onProgress: stop })).rejects.toBe(reason);
    expect((await there.tessellate()).reports).toEqual([]);
    there.dispose();
  });

  test('a signal: ends a call at once; the next ones find the model as it was, with what was moved', () =>
    withBoth(modelOf(plate([kHole])), async (here, there) => {
      here.movePole(0, 3, [2, 1, 0]);
      await there.movePole(0, 3, [2, 1, 0]);
      await there.update();
      const controller = new AbortController();
      const running = there.tessellate({ signal: controller.signal });
      const waiting = there.tessellate();
      controller.abort('why not');
      expect(await rejectionOf(running)).toMatchObject({ code: 'cancelled', cause: 'why not' });
      const mesh = here.tessellate();
      expect(await waiting).toEqual(mesh);
      const again = new AbortController();
      const update = there.update({ relative: 1e-5, signal: again.signal });
      again.abort();
      expect((await rejectionOf(update)).code).toBe('cancelled');
      const { mesh: updated, vertexRanges } = await there.update();
      expect(measure(updated)).toEqual(measure(mesh));
      expect(Array.from(vertexRanges)).toEqual([0, updated.positions.length / 3]);
      const ended = AbortSignal.abort();
      expect((await rejectionOf(there.update({ signal: ended }))).code).toBe('cancelled');
      expect((await rejectionOf(film.createTrimmedModel(box(), { signal: ended }))).code).toBe('cancelled');
    }));

  test('disposed: calls before are answered, later ones are not', async () => {
    const there = await film.createTrimmedModel(box());
    const answer = there.tessellate();
    there.dispose();
    there.dispose();
    expect(measure(await answer)).toEqual({ area: 6, volume: 1, open: 0 });
    for (const call of [there.tessellate(), there.update(), there.movePole(0, 0, [0, 0, 0]), there.moveTrim(0, 0, 0, 0, [0, 0])]) {
      expect((await rejectionOf(call)).code).toBe('disposed');
    }
  });

  test('a pool that is disposed of: takes its models along', async () => {
    const own = await createWorker({ parts: ['surfaces'] });
    const there = await own.createTrimmedModel(box());
    own.dispose();
    expect((await rejectionOf(there.tessellate())).code).toBe('disposed');
    expect((await rejectionOf(own.createTrimmedModel(box()))).code).toBe('disposed');
  });

  test('several models: each on its own', async () => {
    const open = await Promise.all([1, 2, 3].map((x) => film.createTrimmedModel(box(x))));
    const meshes = await Promise.all(open.map((there) => there.tessellate()));
    expect(meshes.map((mesh) => measure(mesh).volume)).toEqual([1, 2, 3]);
    for (const there of open) there.dispose();
  });

  test('a pool without the part: says so', async () => {
    const own = await createWorker({ parts: ['polygons'] });
    const error = await rejectionOf(own.createTrimmedModel(box()));
    expect(error.code).toBe('not-loaded');
    expect(error.message).toMatch(/'surfaces'.*`createWorker`/);
    own.dispose();
  });
});

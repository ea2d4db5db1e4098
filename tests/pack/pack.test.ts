import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { executeTool, packAndInstall, repository, type Consumer } from './consumer.ts';

let consumer: Consumer;
beforeAll(async () => {
  consumer = await packAndInstall();
});
afterAll(() => consumer.remove());

/** Two rings of 6 and 8 points: 14 + 2 * 2 - 4 triangles. */
const kRings = `
  const ring = (count, z) => Array.from({ length: count }, (_, i) =>
    [Math.cos(2 * Math.PI * i / count), Math.sin(2 * Math.PI * i / count), z]);
  const loops = [ring(6, 0), ring(8, 1)];`;
const kTriangles = '14';

describe('the tarball', () => {
  test('contents: the built library and its documents, nothing else', () => {
    const strange = consumer.files.filter((file) => !/^wasm\/dist\/[a-z_]+(\.d\.ts|\.js|\.wasm)$/.test(file));
    expect(strange).toEqual(['CHANGELOG.md', 'LICENSE', 'README.md', 'package.json']);
    for (const name of ['loops.wasm', 'polygons.wasm', 'meshes.wasm', 'surfaces.wasm', ...['index', 'worker', 'files', 'surfaces'].flatMap((stem) => [`${stem}.js`, `${stem}.d.ts`])]) {
      expect(consumer.files).toContain(`wasm/dist/${name}`);
    }
  });

  test('dependencies: none are installed with it', async () => {
    const lock = JSON.parse(await readFile(path.join(consumer.folder, 'package-lock.json'), 'utf8')) as {
      packages: Record<string, unknown>;
    };
    expect(Object.keys(lock.packages)).toEqual(['', 'node_modules/soapfilm']);
  });

  test('publint: nothing to say', async () => {
    const output = await executeTool('publint/src/cli.js', ['run', consumer.tarball, '--strict'], repository);
    expect(output).toMatch(/All good/i);
  });

  test('are the types wrong: no', async () => {
    const args = [consumer.tarball, '--profile', 'esm-only', '--exclude-entrypoints', './loops.wasm', './polygons.wasm', './meshes.wasm', './surfaces.wasm'];
    await executeTool('@arethetypeswrong/cli/dist/index.js', args, repository);
  });

  test('size: each part up to 150 KB, that for meshes 200 KB, and the scripts up to 21 KB, gzipped', async () => {
    const dist = path.join(consumer.folder, 'node_modules/soapfilm/wasm/dist');
    for (const [name, most] of [['loops.wasm', 150], ['polygons.wasm', 150], ['meshes.wasm', 200], ['surfaces.wasm', 150]] as const) {
      const size = gzipSync(await readFile(path.join(dist, name))).length;
      expect(size, name).toBeLessThanOrEqual(most * 1024);
    }
    // Reading and writing files comes on top, for those who use it.
    const index = await readFile(path.join(dist, 'index.js'), 'utf8');
    const contents = index.replace(/^.*formats\.js.*$/m, '');
    expect(contents).not.toBe(index);
    const { outputFiles } = await build({
      stdin: { contents, resolveDir: dist },
      bundle: true,
      minify: true,
      format: 'esm',
      write: false,
      external: ['*_inline.js'],
    });
    expect(gzipSync(outputFiles[0].contents).length).toBeLessThanOrEqual(21 * 1024);
  });

  test('size: files of meshes up to 12 KB, and 22 KB more for GLB, gzipped; licences come with what is bundled', async () => {
    const dist = path.join(consumer.folder, 'node_modules/soapfilm/wasm/dist');
    const { outputFiles } = await build({
      entryPoints: [path.join(dist, 'files.js')],
      bundle: true,
      minify: true,
      format: 'esm',
      write: false,
      external: ['./glb.js'],
    });
    expect(gzipSync(outputFiles[0].contents).length).toBeLessThanOrEqual(12 * 1024);
    const glb = await readFile(path.join(dist, 'glb.js'), 'utf8');
    const [licences] = /^\/\*![^]*?\*\//.exec(glb) ?? [''];
    expect(licences.match(/Copyright \(c\)/g)).toHaveLength(2);
    expect(gzipSync(glb.slice(licences.length)).length).toBeLessThanOrEqual(22 * 1024);
  });

  test('size: trimmed surfaces up to 18 KB, gzipped, of which reading from other libraries is left out if it is not used', async () => {
    const dist = path.join(consumer.folder, 'node_modules/soapfilm/wasm/dist');
    const sizeOf = async (contents: string): Promise<number> => {
      const { outputFiles } = await build({ stdin: { contents, resolveDir: dist }, bundle: true, minify: true, format: 'esm', write: false, external: ['*_inline.js'] });
      return gzipSync(outputFiles[0].contents).length;
    };
    const all = await sizeOf("export * from './surfaces.js';");
    expect(all).toBeLessThanOrEqual(18 * 1024);
    expect(await sizeOf("export { TrimmedModel } from './surfaces.js';")).toBeLessThan(all - 2 * 1024);
  });

  test('one feature alone: brings nothing of the others', async () => {
    const dist = path.join(consumer.folder, 'node_modules/soapfilm/wasm/dist');
    const { outputFiles } = await build({
      stdin: { contents: "export { load, triangulatePolygon } from './index.js';", resolveDir: dist },
      bundle: true,
      minify: true,
      format: 'esm',
      write: false,
      external: ['*_inline.js'],
    });
    expect(outputFiles[0].text).not.toMatch(/sf_span_loops|sf_session|sf_\w+_holes|sf_\w+_surfaces|GeometryCollection|\.curve/);
    expect(outputFiles[0].text).toContain('sf_triangulate_polygons');
  });
});

describe('in Node', () => {
  test('spanLoops: spans two loops', async () => {
    const source = `import { load, spanLoops } from 'soapfilm'; ${kRings}
      await load();
      const span = spanLoops(loops);
      console.log(span.triangles.length / 3);`;
    expect((await consumer.run('span.mjs', source)).trim()).toBe(kTriangles);
  });

  test('triangulatePolygon: triangulates a polygon with a hole, here and in the worker', async () => {
    const source = `import { load, triangulatePolygon, PolygonSession } from 'soapfilm';
      import { createWorker } from 'soapfilm/worker';
      await load();
      const polygon = [[[0, 0], [9, 0], [9, 9], [0, 9]], [[2, 2], [4, 2], [3, 4]]];
      const film = await createWorker();
      const there = await film.triangulatePolygon(polygon, { quality: 'delaunay' });
      const session = new PolygonSession(polygon);
      const remote = await film.createPolygonSession(polygon);
      console.log(triangulatePolygon(polygon).triangles.length / 3, there.triangles.length / 3,
        session.insertPoint([6, 6]).triangleCount, (await remote.insertPoint([6, 6])).triangleCount);
      film.dispose();`;
    expect((await consumer.run('polygon.mjs', source)).trim()).toBe('7 7 9 9');
  });

  test('fillHoles: fills a cube without its lid, here and in the worker', async () => {
    const source = `import { load, fillHoles } from 'soapfilm';
      import { createWorker } from 'soapfilm/worker';
      await load({ parts: ['meshes'] });
      const positions = Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1);
      const faces = Uint32Array.of(0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7);
      const film = await createWorker({ parts: ['meshes'] });
      const there = await film.fillHoles({ positions, faces });
      console.log(fillHoles({ positions, faces }).mesh.faces.length / 3, there.mesh.faces.length / 3, there.closed);
      film.dispose();`;
    expect((await consumer.run('holes.mjs', source)).trim()).toBe('12 12 true');
  });

  test('TrimmedModel: meshes a patch, here and in the worker', async () => {
    const source = `import { load } from 'soapfilm';
      import { parseTrimmedModel, TrimmedModel } from 'soapfilm/surfaces';
      import { createWorker } from 'soapfilm/worker';
      await load({ parts: ['surfaces'] });
      const knots = [0, 0, 1, 1];
      const poles = [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]];
      const surface = { degreeU: 1, degreeV: 1, knotsU: knots, knotsV: knots, countU: 2, countV: 2, poles };
      const model = parseTrimmedModel({ schema: 'trimmed-nurbs/1', faces: [{ surface }], edges: [] });
      const film = await createWorker({ parts: ['surfaces'] });
      const there = await film.createTrimmedModel(model);
      console.log(new TrimmedModel(model).tessellate().triangles.length / 3, (await there.tessellate()).triangles.length / 3);
      film.dispose();`;
    expect((await consumer.run('surfaces.mjs', source)).trim()).toBe('2 2');
  });

  test('the worker: spans two loops and lets the process end', async () => {
    const source = `import { createWorker } from 'soapfilm/worker'; ${kRings}
      const film = await createWorker();
      const span = await film.spanLoops(loops);
      console.log(span.triangles.length / 3);
      film.dispose();`;
    expect((await consumer.run('worker.mjs', source)).trim()).toBe(kTriangles);
  });

  test('files: a mesh comes back from each format', async () => {
    const source = `import { readMesh, writeMesh } from 'soapfilm/files';
      const mesh = { positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), faces: Uint32Array.of(0, 1, 2) };
      for (const format of ['obj', 'ply', 'stl', 'glb']) {
        const { faces } = await readMesh(await writeMesh(mesh, format));
        console.log(format, faces.join(' '));
      }`;
    expect((await consumer.run('files.mjs', source)).trim()).toBe('obj 0 1 2\nply 0 1 2\nstl 0 1 2\nglb 0 1 2');
  });

  test('SoapfilmError: is one class for all entries', async () => {
    const source = `import { SoapfilmError } from 'soapfilm';
      import { readMesh } from 'soapfilm/files';
      import { createWorker } from 'soapfilm/worker';
      const film = await createWorker();
      const broken = new TextEncoder().encode('glTF and no more than that');
      for (const call of [() => film.spanLoops([]), () => readMesh(new Uint8Array()), () => readMesh(broken)]) {
        const error = await call().catch((error) => error);
        console.log(error instanceof SoapfilmError, error.code);
      }
      film.dispose();`;
    expect((await consumer.run('error.mjs', source)).trim()).toBe('true no-loops\ntrue bad-file\ntrue bad-file');
  });

  test('the modules: are found by name, and load takes their bytes', async () => {
    const source = `import { readFile } from 'node:fs/promises';
      import { findHoles, load, spanLoops, triangulatePolygon } from 'soapfilm'; ${kRings}
      const read = (name) => readFile(new URL(import.meta.resolve(name)));
      const [core, polygons, meshes, surfaces] = await Promise.all(['loops', 'polygons', 'meshes', 'surfaces'].map((part) => read(\`soapfilm/\${part}.wasm\`)));
      await load({ wasm: { loops: core, polygons, meshes, surfaces } });
      console.log(spanLoops(loops).triangles.length / 3,
        triangulatePolygon([[[0, 0], [1, 0], [1, 1], [0, 1]]]).triangles.length / 3,
        findHoles({ positions: new Float32Array(9), faces: new Uint32Array() }).loops.length);`;
    expect((await consumer.run('bytes.mjs', source)).trim()).toBe(`${kTriangles} 2 0`);
  });
});

describe('in TypeScript', () => {
  test.each(['bundler', 'nodenext'])('%s: a strict program compiles against the types', async (resolution) => {
    const source = `
      import {
        fillHoles, findHoles, load, PolygonSession, spanLoops, SoapfilmError, triangulateGeoJSON, triangulatePolygon,
        triangulatePolygons, type FillOptions, type FillResult, type HoleReport, type LoopSet, type MeshInput, type PolygonOptions, type PolygonTriangulation, type SpanOptions,
      } from 'soapfilm';
      import { readMesh, writeMesh, type MeshFile } from 'soapfilm/files';
      import { TrimmedModel, type Change, type Mesh, type Model, type Report, type Sampling } from 'soapfilm/surfaces';
      import { createWorker, type PolygonSessionHandle, type TrimmedModelHandle } from 'soapfilm/worker';
      const loops: LoopSet = { positions: new Float64Array(9), starts: Uint32Array.of(0, 3) };
      const options: SpanOptions = { weights: { area: 1 }, onProgress: (fraction) => fraction + 1 };
      await load();
      try {
        const span = spanLoops(loops, options);
        const count: number = span.found ? span.triangles.length : span.reason.length;
        const film = await createWorker();
        const again = await film.spanLoops([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], { signal: AbortSignal.timeout(count) });
        if (again.found) again.positions.fill(0);
        const polygon: PolygonTriangulation = await film.triangulatePolygon([[[0, 0], [1, 0], [0, 1]]]);
        const plain: PolygonOptions = { method: 'trapezoids', output: 'strips', repair: 'even-odd' };
        const { triangles } = triangulatePolygon({ coordinates: [0, 0, 1, 0, 0, 1] }, plain);
        const { errors } = triangulatePolygons([[[[0, 0], [1, 0], [0, 1]]]], { skipInvalid: true });
        const { featureStarts } = triangulateGeoJSON({ type: 'Polygon', coordinates: [] } as { type: string });
        using session = new PolygonSession([[[0, 0], [1, 0], [0, 1]]]);
        session.move(0, [polygon.triangles.length, triangles.length + errors.length + featureStarts.length]);
        using handle: PolygonSessionHandle = await film.createPolygonSession([[[0, 0], [1, 0], [0, 1]]]);
        const { changed } = await handle.move(0, [(await handle.triangles).length, (await handle.read()).next.length]);
        const mesh: MeshInput = { positions: new Float32Array(9), triangles: Uint32Array.of(0, 1, 2) };
        const report: HoleReport = findHoles(mesh, { maxSeconds: changed.length });
        const filling: FillOptions = { holes: report.groups.map((_, g) => g), fairness: 1, perHole: { 0: { density: 0 } } };
        const filled: FillResult = await film.fillHoles(mesh, { ...filling, signal: AbortSignal.timeout(count) });
        const file: MeshFile = await readMesh(await writeMesh(filled.mesh, 'glb', { name: 'bust' }), 'bust.glb');
        await writeMesh(span.found ? span : fillHoles(file).mesh, file.warnings.length > 0 ? 'obj' : file.format);
        if (filled.holes[0]?.status === 'failed') fillHoles({ ...filled.mesh }, { onProgress: (fraction, hole, of) => fraction + hole + of });
        const parts: Model = { instances: [{ part: 'bolt', matrix: new Float64Array(16) }], parts: { bolt: { faces: [], edges: [] } } };
        using model = new TrimmedModel(parts, { skipInvalid: true });
        const sampling: Sampling = { relative: 1e-4, aspect: Infinity, onProgress: (fraction) => fraction };
        const tessellation: Mesh = model.tessellate(sampling);
        const told: string[] = tessellation.reports.map((report: Report) => (report.report === 'left-out' ? report.message : report.report));
        using remote: TrimmedModelHandle = await film.createTrimmedModel(parts);
        const update: Change = await remote.update({ tolerance: told.length, signal: AbortSignal.timeout(count) });
        model.movePole(update.faces[0] ?? 0, 0, [0, 0, 0], 2);
        film.dispose();
      } catch (error) {
        if (error instanceof SoapfilmError && error.code === 'bad-loops') throw error;
      }
      // @ts-expect-error: not a part
      await load({ parts: ['polygon'] });
      // @ts-expect-error: not a sampling
      new TrimmedModel({ faces: [], edges: [] }).tessellate({ tolerances: 3 });
      // @ts-expect-error: not a format
      await writeMesh({ positions: new Float32Array(9), faces: Uint32Array.of(0, 1, 2) }, 'fbx');
      // @ts-expect-error: not a fairness
      fillHoles({ positions: new Float32Array(9), faces: Uint32Array.of(0, 1, 2) }, { fairness: 3 });
      // @ts-expect-error: not a weight
      spanLoops(loops, { weights: { volume: 1 } });`;
    await writeFile(path.join(consumer.folder, 'program.ts'), source);
    const options = {
      module: resolution === 'bundler' ? 'esnext' : 'nodenext',
      moduleResolution: resolution,
      target: 'es2022',
      lib: ['es2022', 'dom', 'esnext.disposable'],
      strict: true,
      exactOptionalPropertyTypes: true,
      noEmit: true,
      skipLibCheck: false,
      types: [],
    };
    const project = path.join(consumer.folder, `tsconfig.${resolution}.json`);
    await writeFile(project, JSON.stringify({ compilerOptions: options, files: ['program.ts'] }));
    await executeTool('typescript/bin/tsc', ['-p', project], consumer.folder);
  });
});

import { createServer, type Server } from 'node:http';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import type { AddressInfo } from 'node:net';
import path from 'node:path';
import { chromium, type Browser } from '@playwright/test';
import { build as esbuild } from 'esbuild';
import { build as vite, createServer as createViteServer } from 'vite';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { list, packAndInstall, type Consumer } from './consumer.ts';

// An app that spans two loops on the main thread and in a worker, triangulates a polygon in either, opens a
// session on it in a worker, fills a cube without its lid in either, has it in files
// and back, meshes a patch in either, and says so in its title.
const kApp = `
  import { fillHoles, load, spanLoops, triangulatePolygon } from 'soapfilm';
  import { readMesh, writeMesh } from 'soapfilm/files';
  import { TrimmedModel } from 'soapfilm/surfaces';
  import { createWorker } from 'soapfilm/worker';
  const ring = (count, z) => Array.from({ length: count }, (_, i) =>
    [Math.cos(2 * Math.PI * i / count), Math.sin(2 * Math.PI * i / count), z]);
  const loops = [ring(6, 0), ring(8, 1)];
  async function start() {
    await load();
    const film = await createWorker();
    const polygon = [[[0, 0], [9, 0], [9, 9], [0, 9]], [[2, 2], [4, 2], [3, 4]]];
    const found = [spanLoops(loops), await film.spanLoops(loops)];
    found.push(triangulatePolygon(polygon), await film.triangulatePolygon(polygon));
    const session = await film.createPolygonSession(polygon);
    found.push({ triangles: await session.triangles });
    const cube = {
      positions: Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1),
      faces: Uint32Array.of(0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7),
    };
    for (const { mesh } of [fillHoles(cube), await film.fillHoles(cube)]) found.push({ triangles: mesh.faces });
    for (const format of ['ply', 'glb']) found.push({ triangles: (await readMesh(await writeMesh(cube, format))).faces });
    const knots = [0, 0, 1, 1];
    const poles = [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]];
    const surface = { degreeU: 1, degreeV: 1, knotsU: knots, knotsV: knots, countU: 2, countV: 2, poles };
    const model = { faces: [{ surface }], edges: [] };
    found.push(new TrimmedModel(model).tessellate(), await (await film.createTrimmedModel(model)).tessellate());
    film.dispose();
    return found.map(({ triangles }) => triangles.length / 3).join(' ');
  }
  start().then(
    (title) => (document.title = title),
    (error) => (document.title = 'failed: ' + error.message),
  );`;
const kTitle = '14 14 7 7 7 12 12 10 10 2 2';

const kTypes: Readonly<Record<string, string>> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.wasm': 'application/wasm',
};

let consumer: Consumer;
let browser: Browser;
beforeAll(async () => {
  consumer = await packAndInstall();
  const isRoot = process.getuid?.() === 0;
  browser = await chromium.launch({
    ...(process.env.CHROMIUM ? { executablePath: process.env.CHROMIUM } : { channel: 'chromium' }),
    args: isRoot ? ['--no-sandbox'] : [],
  });
});
afterAll(async () => {
  await browser.close();
  await consumer.remove();
});

async function writeApp(name: string, html: string): Promise<string> {
  const folder = path.join(consumer.folder, name);
  await mkdir(folder);
  await writeFile(path.join(folder, 'app.js'), kApp);
  await writeFile(path.join(folder, 'index.html'), html);
  return folder;
}

/** Serves a folder; `headers` go with every answer. */
async function serve(folder: string, headers: Record<string, string> = {}): Promise<Server> {
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    const file = path.join(folder, name === '/' ? 'index.html' : name);
    readFile(file).then(
      (data) => {
        const type = kTypes[path.extname(file)] ?? 'application/octet-stream';
        response.writeHead(200, { 'content-type': type, ...headers }).end(data);
      },
      () => response.writeHead(404).end(),
    );
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  return server;
}

/** The title that the app gives its page, and the paths that the page asked for. */
async function visit(url: string): Promise<{ title: string; asked: string[] }> {
  const page = await browser.newPage();
  const asked: string[] = [];
  page.on('request', (request) => asked.push(new URL(request.url()).pathname));
  try {
    await page.goto(url, { timeout: 0 });
    await page.waitForFunction(() => document.title !== '', undefined, { timeout: 0 });
    return { title: await page.title(), asked };
  } finally {
    await page.close();
  }
}

/** `visit` on a folder served as it is. */
async function visitFolder(folder: string, headers: Record<string, string> = {}) {
  const server = await serve(folder, headers);
  try {
    const { port } = server.address() as AddressInfo;
    return await visit(`http://127.0.0.1:${port}/`);
  } finally {
    server.close();
  }
}

const kHtml = '<!doctype html><script type="module" src="./app.js"></script>';

describe('bundlers', () => {
  test('vite: all parts and the worker become assets, and both entries work', async () => {
    const root = await writeApp('vite', kHtml);
    await vite({ root, base: './', logLevel: 'error', configFile: false });
    const files = await list(path.join(root, 'dist/assets'));
    expect(files.filter((file) => /^loops-.*\.wasm$/.test(file))).toHaveLength(1);
    expect(files.filter((file) => /^polygons-.*\.wasm$/.test(file))).toHaveLength(1);
    expect(files.filter((file) => /^meshes-.*\.wasm$/.test(file))).toHaveLength(1);
    expect(files.filter((file) => /^surfaces-.*\.wasm$/.test(file))).toHaveLength(1);
    expect(files.filter((file) => /^worker_thread-.*\.js$/.test(file))).toHaveLength(1);
    const { title, asked } = await visitFolder(path.join(root, 'dist'));
    expect(title).toBe(kTitle);
    // Once each, although the worker has them as well.
    expect(asked.filter((file) => /\.wasm$/.test(file))).toHaveLength(4);
    expect(asked.some((file) => /inline/.test(file))).toBe(false);
  });

  test("vite: works under a policy of 'self' and 'wasm-unsafe-eval'", async () => {
    const root = path.join(consumer.folder, 'vite/dist');
    const policy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'";
    const { title } = await visitFolder(root, { 'content-security-policy': policy });
    expect(title).toBe(kTitle);
  });

  test('vite, development: both entries work, wherever it puts the package', async () => {
    const root = await writeApp('vite-dev', kHtml);
    const server = await createViteServer({
      root,
      configFile: false,
      logLevel: 'error',
      server: { host: '127.0.0.1', port: 0 },
    });
    try {
      await server.listen();
      const { port } = server.httpServer?.address() as AddressInfo;
      expect((await visit(`http://127.0.0.1:${port}/`)).title).toBe(kTitle);
    } finally {
      await server.close();
    }
  });

  test('esbuild: loses the files and falls back to the inline copies', async () => {
    const root = await writeApp('esbuild', kHtml.replace('./app.js', './out/app.js'));
    await esbuild({
      entryPoints: [path.join(root, 'app.js')],
      bundle: true,
      format: 'esm',
      splitting: true,
      outdir: path.join(root, 'out'),
      logLevel: 'error',
    });
    expect((await visitFolder(root)).title).toBe(kTitle);
  });

  test('no bundler: served as it is, with an import map', async () => {
    const dist = './node_modules/soapfilm/wasm/dist';
    const map = { imports: { soapfilm: `${dist}/index.js`, 'soapfilm/worker': `${dist}/worker.js`, 'soapfilm/files': `${dist}/files.js`, 'soapfilm/surfaces': `${dist}/surfaces.js` } };
    const html = kHtml.replace('<script', `<script type="importmap">${JSON.stringify(map)}</script><script`);
    await writeFile(path.join(consumer.folder, 'app.js'), kApp);
    await writeFile(path.join(consumer.folder, 'index.html'), html);
    const { title, asked } = await visitFolder(consumer.folder);
    expect(title).toBe(kTitle);
    for (const name of ['loops.wasm', 'polygons.wasm', 'meshes.wasm', 'surfaces.wasm']) {
      expect(asked).toContain(`/node_modules/soapfilm/wasm/dist/${name}`);
    }
  });
});

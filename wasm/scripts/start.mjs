// npm start: installs, builds and serves the page, prints its address and opens it where there is a
// display. npm run dev: the same from the sources, rebuilt as they change.
import { watch } from 'node:fs';
import path from 'node:path';
import { buildLibrary, buildPage } from './build.mjs';
import { main, root, say } from './run.mjs';
import { checkNode } from './tools.mjs';

const hasDisplay =
  !process.env.CI &&
  (process.platform !== 'linux' || Boolean(process.env.DISPLAY || process.env.WAYLAND_DISPLAY));

async function preview() {
  await buildPage();
  const vite = await import('vite');
  const server = await vite.preview({ root: path.join(root, 'web'), configFile: path.join(root, 'vite.config.js'), preview: { open: hasDisplay } });
  announce(server.resolvedUrls);
}

async function develop() {
  await buildLibrary();
  const vite = await import('vite');
  const server = await vite.createServer({ root: path.join(root, 'web'), configFile: path.join(root, 'vite.config.js'), server: { open: hasDisplay } });
  await server.listen();
  let building = Promise.resolve();
  let timer;
  const rebuild = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      building = building.then(buildLibrary).catch((error) => say(error.message));
    }, 200);
  };
  for (const folder of ['wasm/src', 'wasm/include', 'wasm/ts']) {
    watch(path.join(root, folder), { recursive: true }, rebuild);
  }
  announce(server.resolvedUrls);
}

function announce(urls) {
  say(`\nsoapfilm: ${urls?.local[0] ?? ''}\nCtrl-C ends it.`);
}

await main(async () => {
  checkNode();
  await (process.argv.includes('--dev') ? develop() : preview());
});

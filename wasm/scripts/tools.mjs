// The programs that building and testing need: finds each, or installs it with apt, or says how to
// get it. Plain Node, for it runs before anything is installed.
import { spawnSync } from 'node:child_process';
import {
  accessSync,
  constants,
  existsSync,
  mkdtempSync,
  readFileSync,
  realpathSync,
  rmSync,
  statSync,
  utimesSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { Failure, root, run, say } from './run.mjs';

const kOldestNode = [20, 19];

function findProgram(...names) {
  for (const name of names) {
    if (name === undefined || name === '') continue;
    const folders = path.isAbsolute(name) ? [''] : (process.env.PATH ?? '').split(path.delimiter);
    for (const folder of folders) {
      const file = path.join(folder, name);
      try {
        accessSync(file, constants.X_OK);
        if (statSync(file).isFile()) return file;
      } catch {
        // not here
      }
    }
  }
  return undefined;
}

function findEmcc() {
  const sdk = process.env.EMSDK;
  return findProgram('emcc', sdk && path.join(sdk, 'upstream/emscripten/emcc'));
}

function findHeader(name) {
  const folders = ['/usr/include', '/usr/local/include', '/opt/homebrew/include', '/opt/local/include'];
  folders.unshift(...(process.env.CPLUS_INCLUDE_PATH ?? '').split(path.delimiter).filter(Boolean));
  return folders.map((folder) => path.join(folder, name)).find((file) => existsSync(file));
}

/** A Chromium for the page's tests. Set CHROMIUM to name another. */
export function findChromium() {
  return findProgram(
    process.env.CHROMIUM,
    'chromium',
    'chromium-browser',
    'google-chrome',
    'google-chrome-stable',
    '/Applications/Chromium.app/Contents/MacOS/Chromium',
    '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  );
}

/** clang-format 14: other versions break lines differently. */
function findClangFormat() {
  const file = findProgram('clang-format-14', 'clang-format');
  if (!file) return undefined;
  const { stdout } = spawnSync(file, ['--version'], { encoding: 'utf8' });
  return /version 14\./.test(stdout) ? file : undefined;
}

/**
 * Where each tool is looked for, the Debian packages that hold it, and what to say where there is no
 * apt. An optional tool's absence is reported and its step left out.
 */
const kTools = {
  emcc: {
    find: findEmcc,
    packages: ['emscripten'],
    advice: `Emscripten (emcc) compiles the C++ core to WebAssembly. To get it:
  git clone https://github.com/emscripten-core/emsdk.git
  cd emsdk
  ./emsdk install latest
  ./emsdk activate latest
  source ./emsdk_env.sh          (Windows: emsdk_env.bat)
and run the command again in that shell, or set EMSDK to that folder.`,
  },
  cmake: {
    find: () => findProgram('cmake'),
    packages: ['cmake'],
    advice: 'CMake 3.20 or newer: https://cmake.org/download (macOS: brew install cmake).',
  },
  ninja: {
    find: () => findProgram('ninja', 'ninja-build'),
    packages: ['ninja-build'],
    advice: 'Ninja: https://ninja-build.org (macOS: brew install ninja).',
  },
  compiler: {
    find: () => findProgram(process.env.CXX, 'g++', 'c++', 'clang++'),
    packages: ['g++'],
    advice: 'A C++17 compiler: g++ or clang++ (macOS: xcode-select --install).',
  },
  doctest: {
    find: () => findHeader('doctest/doctest.h'),
    packages: ['doctest-dev'],
    advice: 'doctest, the C++ test framework (macOS: brew install doctest).',
  },
  chromium: {
    find: findChromium,
    packages: ['chromium'],
    advice: 'Chromium or Chrome; if it is not on PATH, set CHROMIUM to its program file.',
  },
  clangFormat: {
    find: findClangFormat,
    packages: ['clang-format-14'],
    optional: 'clang-format 14',
  },
  clangTidy: {
    find: () => findProgram('clang-tidy-14', 'clang-tidy'),
    packages: ['clang-tidy'],
    optional: 'clang-tidy',
  },
  clang: {
    find: () => findProgram('clang++'),
    packages: ['clang'],
    optional: 'clang',
  },
  fuzzer: {
    find: findFuzzer,
    packages: () => [`libclang-rt-${clangVersion() ?? 14}-dev`],
    optional: "clang's libFuzzer",
  },
  cgal: {
    find: () => findHeader('CGAL/version.h'),
    packages: ['libcgal-dev'],
    optional: 'CGAL',
  },
};

function clangVersion() {
  const file = findProgram('clang++');
  return file && /clang-(\d+)|llvm-(\d+)/.exec(realpathSync(file))?.slice(1).find(Boolean);
}

/** The clang++ that can make fuzzers: not all come with the run-time libraries. */
function findFuzzer() {
  const file = findProgram('clang++');
  if (!file) return undefined;
  const folder = mkdtempSync(path.join(tmpdir(), 'fuzzer-'));
  const { status } = spawnSync(
    file,
    ['-fsanitize=fuzzer,address,undefined', '-x', 'c++', '-', '-o', path.join(folder, 'program')],
    { input: 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, decltype(sizeof 0)) { return 0; }' },
  );
  rmSync(folder, { recursive: true, force: true });
  return status === 0 ? file : undefined;
}

async function becomeRoot() {
  if (process.getuid?.() === 0) return [];
  const sudo = findProgram('sudo');
  if (!sudo) return undefined;
  // Without a terminal nobody can answer a question for the password.
  const silent = await run(sudo, ['-n', 'true'], { capture: true, allowFailure: true });
  if (silent.code === 0) return [sudo, '-n'];
  return process.stdin.isTTY ? [sudo] : undefined;
}

async function installWithApt(packages) {
  const apt = findProgram('apt-get');
  if (!apt || process.env.SOAPFILM_NO_APT) return false;
  const prefix = await becomeRoot();
  if (!prefix) return false;
  say(`Installing with apt: ${packages.join(' ')}`);
  const aptGet = (...args) => {
    const line = [...prefix, 'env', 'DEBIAN_FRONTEND=noninteractive', apt, '-q', ...args];
    return run(line[0], line.slice(1), { allowFailure: true });
  };
  const twice = async (...args) => {
    const first = await aptGet(...args);
    return first.code === 0 ? first : aptGet(...args);
  };
  const install = ['install', '-y', '--no-install-recommends', ...packages];
  await twice('update');
  return (await twice(...install)).code === 0;
}

/**
 * Makes the named tools available, by apt where it can.
 * Returns { paths: where each was found, missing: what to call each optional one that was not }.
 * Throws a Failure that says how to get a needed one.
 */
export async function ensureTools(names) {
  const absent = () => names.filter((name) => !kTools[name].find());
  const packagesOf = (name) =>
    typeof kTools[name].packages === 'function' ? kTools[name].packages() : kTools[name].packages;
  let lacking = absent();
  if (lacking.length > 0) {
    say(`Not found: ${lacking.join(', ')}`);
    const needed = lacking.filter((name) => !kTools[name].optional);
    if (needed.length > 0) await installWithApt(needed.flatMap(packagesOf));
    // One at a time: a release without one of these packages can still have the others.
    for (const name of lacking.filter((name) => kTools[name].optional)) {
      await installWithApt(packagesOf(name));
    }
    lacking = absent();
  }
  const fatal = lacking.filter((name) => !kTools[name].optional);
  if (fatal.length > 0) {
    throw new Failure(
      [
        'These are needed and could not be installed automatically:',
        ...fatal.map((name) => `\n${kTools[name].advice}`),
        `\nOn Debian and Ubuntu: sudo apt-get install ${fatal.flatMap(packagesOf).join(' ')}`,
      ].join('\n'),
    );
  }
  return {
    paths: Object.fromEntries(names.map((name) => [name, kTools[name].find()])),
    missing: lacking.map((name) => kTools[name].optional),
  };
}

/** Environment in which Emscripten's programs work, given where emcc is. */
export function emscriptenEnvironment(emcc) {
  const folder = path.dirname(emcc);
  const env = { PATH: `${folder}${path.delimiter}${process.env.PATH ?? ''}` };
  // Debian keeps acorn, which some link steps need, where its Node looks and others do not.
  if (existsSync('/usr/share/nodejs/acorn')) {
    env.NODE_PATH = ['/usr/share/nodejs', process.env.NODE_PATH].filter(Boolean).join(':');
  }
  return env;
}

/** Throws a Failure where this Node is too old for the tools (the built package needs only 20). */
export function checkNode() {
  const [major, minor] = process.versions.node.split('.').map(Number);
  if (major > kOldestNode[0] || (major === kOldestNode[0] && minor >= kOldestNode[1])) return;
  throw new Failure(
    `Node ${process.versions.node} is too old to build soapfilm: ${kOldestNode.join('.')} or newer is needed.`,
  );
}

/** Runs `npm ci` where node_modules is missing or older than the lock file. */
export async function ensureNodeModules() {
  const lock = path.join(root, 'package-lock.json');
  const mark = path.join(root, 'node_modules/.package-lock.json');
  if (existsSync(mark) && statSync(mark).mtimeMs >= statSync(lock).mtimeMs) return;
  if (existsSync(mark) && sameDependencies(lock, mark)) {
    utimesSync(mark, new Date(), new Date());
    return;
  }
  say('Installing the npm packages of package-lock.json');
  const npm = process.env.npm_execpath;
  const args = ['ci', '--include=dev', '--ignore-scripts', '--no-audit', '--no-fund'];
  if (npm?.endsWith('.js')) await run(process.execPath, [npm, ...args]);
  else await run(process.platform === 'win32' ? 'npm.cmd' : 'npm', args);
  utimesSync(mark, new Date(), new Date());
}

// npm's own record of what is installed lists the same packages as the lock, but those left out on
// this platform and the project itself.
function sameDependencies(lock, mark) {
  const wanted = JSON.parse(readFileSync(lock, 'utf8')).packages;
  const present = JSON.parse(readFileSync(mark, 'utf8')).packages;
  return Object.entries(wanted).every(
    ([name, { version, optional }]) =>
      name === '' || present[name]?.version === version || (optional && !present[name]),
  );
}

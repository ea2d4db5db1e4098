// The arrows between the parts of soapfilm, and a reader of the imports and includes that must
// follow them.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import path from 'node:path';

/** What the files of each folder of wasm/src may include besides their own folder: all that stands below it. */
const kCore: Readonly<Partial<Record<string, readonly string[]>>> = (() => {
  const base = ['base'];
  const triangles = [...base, 'triangles'];
  const problem = [...base, 'delaunay', 'loops/problem'];
  const domains = [...problem, 'loops/one_loop', 'loops/domains'];
  const bounds = [...domains, 'loops/bounds'];
  const spaces = [...problem, 'loops/spaces'];
  const loops = [...bounds, ...spaces, 'loops/search', 'loops/answer', 'loops'];
  const sweep = [...triangles, 'polygon/input', 'polygon/strips', 'polygon/sweep'];
  const fill = [...sweep, 'polygon/fill'];
  const polygon = [...fill, 'polygon/session', 'polygon/repair', 'polygon'];
  return {
    base: [],
    delaunay: base,
    triangles: base,
    'loops/problem': problem,
    'loops/one_loop': problem,
    'loops/spaces': spaces,
    'loops/answer': spaces,
    'loops/domains': domains,
    'loops/bounds': domains,
    'loops/search': bounds,
    loops,
    mesh: [...loops, 'triangles'],
    'polygon/input': base,
    'polygon/strips': triangles,
    'polygon/sweep': sweep,
    'polygon/fill': sweep,
    'polygon/session': fill,
    'polygon/repair': fill,
    polygon,
    surface: polygon,
    tin: triangles,
    // Features are entered from above.
    abi: [...base, 'loops', 'mesh', 'polygon', 'polygon/input', 'polygon/session', 'surface', 'tin'],
  };
})();

/** What the folders of web/src may import besides their own: all that stands below. Modes are in folders of their own. */
const kPage: Readonly<Partial<Record<string, readonly string[]>>> = (() => {
  const state = ['shapes'];
  const scene = ['state', ...state];
  const app = ['scene', ...scene];
  return { shapes: [], state, scene, app, mode: ['app', ...app], modes: ['app', 'mode'], '': ['app', 'modes', ...app] };
})();

/** Names by which code outside wasm/ may know the library. */
const kPublic = [
  'soapfilm',
  'soapfilm/worker',
  'soapfilm/files',
  'soapfilm/surfaces',
  'soapfilm/loops.wasm',
  'soapfilm/polygons.wasm',
  'soapfilm/meshes.wasm',
  'soapfilm/surfaces.wasm',
  'soapfilm/package.json',
];

/** Packages that the build bundles into a module of wasm/ts. */
const kBundled: Readonly<Partial<Record<string, readonly string[]>>> = { glb: ['@gltf-transform/core'] };

/** Words that only wasm/ts/runtime.ts has a use for. */
const kMemory = /\bmemory\.buffer\b|\bWebAssembly\.(Instance|Memory|instantiate)\b|\bsf_(alloc|free|result_\w+)\b/;

export interface SourceFile {
  /** From the root of the repository, with forward slashes. */
  readonly path: string;
  readonly text: string;
}

/** All text files below the folders that may hold code. */
export function readSources(root: string, folders: readonly string[]): SourceFile[] {
  const skipped = new Set(['node_modules', 'dist', 'build', 'fixtures']);
  const found: SourceFile[] = [];
  const visit = (relative: string): void => {
    for (const name of readdirSync(path.join(root, relative)).sort()) {
      const below = `${relative}/${name}`;
      if (skipped.has(name)) continue;
      if (statSync(path.join(root, below)).isDirectory()) visit(below);
      else if (/\.(cpp|h|ts|tsx|mjs|js)$/.test(name)) {
        found.push({ path: below, text: readFileSync(path.join(root, below), 'utf8') });
      }
    }
  };
  folders.forEach(visit);
  return found;
}

/** Every breach of the arrows in the files, as `path: reason`; empty when all is well. */
export function breaches(files: readonly SourceFile[]): string[] {
  return files.flatMap((file) => judge(file).map((reason) => `${file.path}: ${reason}`));
}

function judge(file: SourceFile): string[] {
  if (/\.(cpp|h)$/.test(file.path)) return judgeIncludes(file);
  if (file.path.startsWith('wasm/ts/')) return judgeLibrary(file);
  if (file.path.startsWith('wasm/')) return [];
  return judgeOutside(file);
}

/** Names in quotes that a C++ file includes, less what is in its own folder. */
function includes(text: string): string[] {
  return [...text.matchAll(/^\s*#\s*include\s*"([^"]+)"/gm)].map((match) => match[1]);
}

/** Modules that a script imports, statically or not. */
function imports(text: string): string[] {
  const code = text.replace(/\/\*[\s\S]*?\*\/|(^|\s)\/\/.*$/gm, '$1');
  const pattern = /(?:\bfrom|\bimport)\s*\(?\s*['"]([^'"]+)['"]/g;
  return [...code.matchAll(pattern)].map((match) => match[1]);
}

function judgeIncludes({ path: file, text }: SourceFile): string[] {
  const names = includes(text);
  if (!file.startsWith('wasm/src/')) {
    const sees = file.startsWith('tests/cpp/') || file.startsWith('tests/bench/');
    if (sees || file.startsWith('wasm/include/')) return [];
    return names.filter((name) => name !== 'soapfilm.h').map((name) => `includes "${name}"`);
  }
  const folder = path.posix.dirname(file).slice('wasm/src/'.length);
  const allowed = kCore[folder];
  if (!allowed) return [`wasm/src/${folder} has no place among the layers`];
  return names.flatMap((name) => {
    if (name === 'soapfilm.h') return folder === 'abi' ? [] : ['only abi includes soapfilm.h'];
    // What a call ends with is the same inside and outside.
    if (name === 'soapfilm_tables.h' && file === 'wasm/src/base/status.h') return [];
    const target = path.posix.dirname(name);
    if (!name.includes('/') || name.startsWith('.')) {
      return [`includes "${name}" without its folder`];
    }
    return target === folder || allowed.includes(target)
      ? []
      : [`${folder} includes "${name}", against the arrows`];
  });
}

function judgeLibrary({ path: file, text }: SourceFile): string[] {
  const name = path.posix.basename(file).replace(/(\.d)?\.ts$/, '');
  const reasons: string[] = [];
  for (const target of imports(text)) {
    if (target.startsWith('node:')) {
      if (!/(^|_)node(_|$)/.test(name)) reasons.push(`imports ${target} outside a Node file`);
    } else if (kBundled[name]?.includes(target)) {
      continue;
    } else if (!/^\.\/[a-z_]+\.js$/.test(target)) {
      reasons.push(`imports ${target}, which is not a module of wasm/ts`);
    } else if (/^\.\/(index|node)\.js$/.test(target) && !/^(index|node|worker_node)$/.test(name)) {
      reasons.push(`imports ${target}, against the arrows`);
    }
  }
  if (name !== 'runtime' && kMemory.test(text.replace(/\/\*[\s\S]*?\*\/|\/\/.*$/gm, ''))) {
    reasons.push('knows the memory of the core, which is for runtime.ts alone');
  }
  return reasons;
}

/**
 * Where a file of the page stands: in a folder of its core; in the folder of one mode, as `mode`; in the registry of
 * the modes, as `modes`; or above all, as the empty string.
 */
function placeInPage(file: string): { readonly layer: string; readonly mode?: string } {
  const [folder, name, ...below] = file.slice('web/src/'.length).split('/');
  if (!file.slice('web/src/'.length).includes('/')) return { layer: '' };
  if (folder !== 'modes') return { layer: folder };
  return below.length === 0 ? { layer: 'modes' } : { layer: 'mode', mode: name };
}

/** A mode imports the core and itself; only the registry imports a mode; nothing but the top imports the registry. */
function judgePage(file: string, target: string): string[] {
  const [from, to] = [placeInPage(file), placeInPage(target)];
  if (from.mode !== undefined && to.mode !== undefined && from.mode !== to.mode) {
    return [`is of the mode ${from.mode} and imports ${target}, of the mode ${to.mode}`];
  }
  if (from.layer === 'mode' && to.layer === '') return [`imports ${target}, against the arrows`];
  const allowed = kPage[from.layer];
  if (!allowed) return [`web/src/${from.layer} has no place among the layers`];
  return from.layer === to.layer || allowed.includes(to.layer) ? [] : [`${from.layer} imports ${target}, against the arrows`];
}

function judgeOutside({ path: file, text }: SourceFile): string[] {
  const top = file.split('/')[0];
  return imports(text).flatMap((target) => {
    if (target.startsWith('.')) {
      const resolved = path.posix.join(path.posix.dirname(file), target);
      if (file.startsWith('web/src/') && /^web\/src\/.*\.tsx?$/.test(resolved)) return judgePage(file, resolved);
      if (resolved.startsWith('wasm/')) return [`imports ${target} instead of 'soapfilm'`];
      const other = resolved.split('/')[0];
      const crosses = other !== top && !(top === 'tests' && ['examples', 'web'].includes(other));
      return crosses ? [`imports ${target} from another part`] : [];
    }
    if (/^soapfilm(\/|$)/.test(target) && !kPublic.includes(target)) {
      return [`imports ${target}, which is not public`];
    }
    return [];
  });
}

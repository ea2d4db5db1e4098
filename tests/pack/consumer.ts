// What a user of the packed package has: the tarball installed in an empty folder, away from the
// repository, below a path that is hard on careless URL handling.
import { execFile } from 'node:child_process';
import { mkdir, mkdtemp, readdir, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';

const execFileAsync = promisify(execFile);

export const repository = path.resolve(import.meta.dirname, '../..');

export interface Consumer {
  readonly folder: string;
  readonly tarball: string;
  /** Paths of the files in the tarball, sorted. */
  readonly files: readonly string[];
  /** Writes a script into the folder and runs it with Node; resolves to what it prints. */
  run(name: string, source: string): Promise<string>;
  remove(): Promise<void>;
}

interface PackReport {
  readonly filename: string;
  readonly files: readonly { readonly path: string }[];
}

/** Starts a program; resolves to what it prints, throws with all of its output if it fails. */
export async function execute(program: string, args: string[], cwd: string): Promise<string> {
  try {
    const { stdout } = await execFileAsync(program, args, { cwd, maxBuffer: 2 ** 26 });
    return stdout;
  } catch (error) {
    const { stdout, stderr } = error as { stdout?: string; stderr?: string };
    throw new Error(`${program} ${args.join(' ')}\n${stdout ?? ''}${stderr ?? String(error)}`, {
      cause: error,
    });
  }
}

/** Runs a script of one of the repository's development tools. */
export function executeTool(script: string, args: string[], cwd: string): Promise<string> {
  return execute(process.execPath, [path.join(repository, 'node_modules', script), ...args], cwd);
}

export async function packAndInstall(): Promise<Consumer> {
  const base = await mkdtemp(path.join(tmpdir(), 'soapfilm-'));
  const folder = path.join(base, 'an app, größer');
  await mkdir(folder);
  // The library is built already; what the scripts of npm print would spoil the report.
  const pack = ['pack', '--json', '--ignore-scripts', '--pack-destination', base];
  const [report] = JSON.parse(await execute('npm', pack, repository)) as [PackReport];
  const tarball = path.join(base, report.filename);
  await writeFile(
    path.join(folder, 'package.json'),
    JSON.stringify({ name: 'consumer', private: true, type: 'module' }),
  );
  const install = ['install', tarball, '--offline', '--ignore-scripts', '--no-audit', '--no-fund'];
  await execute('npm', install, folder);
  return {
    folder,
    tarball,
    files: report.files.map((file) => file.path).sort(),
    async run(name, source) {
      await writeFile(path.join(folder, name), source);
      return execute(process.execPath, [name], folder);
    },
    remove: () => rm(base, { recursive: true, force: true }),
  };
}

/** The names below a folder, sorted. */
export async function list(folder: string): Promise<string[]> {
  const entries = await readdir(folder, { recursive: true });
  return entries.sort();
}

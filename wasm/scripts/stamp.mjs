// Steps that are left out while nothing that they read has changed.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { buildRoot, root, say } from './run.mjs';

/** All files below the given files and folders (relative to the repository), sorted. */
export function listFiles(entries, wanted = () => true) {
  const found = [];
  const skipped = new Set(['node_modules', 'dist', 'build', '.git', 'test-results']);
  const visit = (relative) => {
    const full = path.join(root, relative);
    if (!existsSync(full)) return;
    if (!statSync(full).isDirectory()) {
      if (wanted(relative)) found.push(relative);
      return;
    }
    for (const name of readdirSync(full).sort()) {
      if (!skipped.has(name)) visit(path.posix.join(relative, name));
    }
  };
  for (const entry of entries) visit(entry);
  return found;
}

/** A digest of the wanted files below some files and folders, of this Node's version and of `facts`. */
export function digest(entries, facts, wanted) {
  const hash = createHash('sha256').update(JSON.stringify([process.version, facts]));
  for (const file of listFiles(entries, wanted)) {
    hash.update(`\0${file}\0`).update(readFileSync(path.join(root, file)));
  }
  return hash.digest('hex');
}

/**
 * Runs `step` unless it ran before on the same inputs and its outputs still stand.
 *   inputs   files and folders, `facts` anything else that it depends on
 *   outputs  files that it leaves behind
 */
export async function unlessUpToDate(name, { inputs, facts = null, outputs }, step) {
  const stampFile = path.join(buildRoot, 'stamps', name);
  const before = digest(inputs, facts);
  const fresh =
    existsSync(stampFile) &&
    readFileSync(stampFile, 'utf8') === before &&
    outputs.every((file) => existsSync(path.join(root, file)));
  if (fresh) return false;
  rmSync(stampFile, { force: true });
  say(`· ${name}`);
  await step();
  mkdirSync(path.dirname(stampFile), { recursive: true });
  // The inputs as they were when the step began: an edit made meanwhile leads to another run.
  writeFileSync(stampFile, before);
  return true;
}

/** Writes a file unless it holds that content already, so that watchers and make see no change. */
export function writeIfChanged(file, content) {
  const data = Buffer.from(content);
  if (existsSync(file) && readFileSync(file).equals(data)) return;
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, data);
}

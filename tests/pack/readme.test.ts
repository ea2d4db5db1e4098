// The README's snippets, each a program of its own: what people copy has to compile, and to run.
import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { executeTool, packAndInstall, repository, type Consumer } from './consumer.ts';

let consumer: Consumer;
beforeAll(async () => {
  consumer = await packAndInstall();
});
afterAll(() => consumer.remove());

interface Snippet {
  readonly title: string;
  readonly language: string;
  readonly code: string;
}

/** The code blocks of a Markdown text that are marked as scripts. */
async function snippetsIn(file: string): Promise<Snippet[]> {
  const text = await readFile(path.join(repository, file), 'utf8');
  return [...text.matchAll(/^```(\w+)\n([\s\S]*?)^```$/gm)]
    .map(([, language, code], i) => ({ title: `${file}, code block ${i + 1}`, language, code }))
    .filter(({ language }) => ['js', 'ts'].includes(language));
}

const snippets = [...(await snippetsIn('README.md')), ...(await snippetsIn('examples/README.md'))];

test('the README: has snippets, and none in a language that is not looked at', async () => {
  expect(snippets.length).toBeGreaterThanOrEqual(3);
  const text = await readFile(path.join(repository, 'README.md'), 'utf8');
  const languages = [...text.matchAll(/^```(\w+)$/gm)].map(([, language]) => language);
  expect(new Set(languages)).toEqual(new Set(['js', 'sh']));
});

test('all: compile in strict TypeScript, each a module of its own', async () => {
  const files = snippets.map((_, i) => `snippet${i}.ts`);
  await Promise.all(files.map((file, i) => writeFile(path.join(consumer.folder, file), snippets[i].code)));
  const compilerOptions = {
    module: 'nodenext',
    moduleDetection: 'force',
    target: 'es2022',
    lib: ['es2022', 'dom', 'esnext.disposable'],
    strict: true,
    noUncheckedIndexedAccess: true,
    exactOptionalPropertyTypes: true,
    noEmit: true,
    types: [],
  };
  const project = path.join(consumer.folder, 'tsconfig.json');
  await writeFile(project, JSON.stringify({ compilerOptions, files }));
  await executeTool('typescript/bin/tsc', ['-p', project], consumer.folder);
});

test.each(snippets.filter(({ language }) => language === 'js'))('$title: runs', async ({ code }) => {
  const printed = await consumer.run('snippet.mjs', code);
  expect(printed).toMatch(code.includes('console.log') ? /\d/ : /^$/);
});

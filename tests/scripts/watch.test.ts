// The watch over a suite's programs: who stands still is ended, who is slow is not.
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { describe, expect, test } from 'vitest';

interface Outcome {
  readonly code: number;
  readonly output: string;
}
interface Limits {
  readonly still?: number;
  readonly processor?: number;
  readonly every?: number;
}
interface Scripts {
  readonly run: (command: string, args: string[], options: object) => Promise<Outcome>;
  readonly metered: <T>(body: () => Promise<T>) => Promise<{ value: T; processor: number }>;
}

const file = path.resolve(import.meta.dirname, '../../wasm/scripts/run.mjs');
const { run, metered } = (await import(pathToFileURL(file).href)) as Scripts;

/** A program of Node under short limits; the rest of `options` is that of `run`. */
const watched = (program: string, limits: Limits, options: object = {}): Promise<Outcome> =>
  run(process.execPath, ['-e', program], { capture: true, allowFailure: true, watched: { every: 0.1, ...limits }, ...options });

describe('watch', () => {
  test('a program that waits for ever: ended, and the output says why', async () => {
    const { code, output } = await watched("console.log('begun'); setInterval(() => {}, 1e6)", { still: 5 });
    expect(code).not.toBe(0);
    expect(output).toContain('begun');
    expect(output).toMatch(/was stopped: for 5 s it neither wrote a line nor used the processor/);
  });

  test('a program that computes for ever: ended by the processor time it used', async () => {
    const { code, output } = await watched('for (;;);', { still: 1000, processor: 0.5 });
    expect(code).not.toBe(0);
    expect(output).toMatch(/was stopped: it used 0.5 s of processor time without writing a line/);
  });

  test('a child of the program: ended with it', async () => {
    const program = `require('node:child_process').spawn(process.execPath, ['-e', 'setInterval(() => {}, 1e6)'], { stdio: 'inherit' });`;
    // The child holds the output open: this would not end if it were left.
    const { output } = await watched(program, { still: 5 });
    expect(output).toContain('was stopped');
  });

  test('a program that says something now and then: left alone, however long it takes', async () => {
    const program = 'let i = 0; const t = setInterval(() => { console.log(i); if (++i === 20) clearInterval(t); }, 100)';
    expect(await watched(program, { still: 1000, processor: 1000 })).toMatchObject({ code: 0 });
  });

  test('a process over its own limit of processor time: ended, others not', async () => {
    const { value, processor } = await metered(() => watched('for (;;);', {}, { processor: 1 }));
    expect(value.code).toBeGreaterThan(128);
    expect(processor).toBeGreaterThan(0.5);
  });

  test('metered: counts the processor time of what was run, children included', async () => {
    const burn = 'while (process.cpuUsage().user < 3e5);';
    const program = `require('node:child_process').execFileSync(process.execPath, ['-e', ${JSON.stringify(burn)}]);`;
    const { value, processor } = await metered(() => watched(program, {}));
    expect(value.code).toBe(0);
    expect(processor).toBeGreaterThan(0.29);
  });
});

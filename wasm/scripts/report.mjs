// What a suite comes to, and where the tools leave their reports.
import { existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import path from 'node:path';
import { buildRoot } from './run.mjs';

const reports = path.join(buildRoot, 'reports');

/** Where a tool is to write its report; nothing is there. */
export function reportFile(name) {
  mkdirSync(reports, { recursive: true });
  const file = path.join(reports, name);
  rmSync(file, { force: true });
  return file;
}

/** A report in JSON; `{}` where there is none. */
export function readReport(file) {
  return existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : {};
}

/** What a suite resolves to. `notes` are told in the summary whatever the counts are. */
export function result(passed, failed, output = '', notes = []) {
  if (passed + failed === 0) {
    return { passed, failed: 1, output: `${output}\nNo test was run.\n`, notes };
  }
  return { passed, failed, output, notes };
}

/** A failed test case of doctest's XML in words: file, name, and the lines that failed. */
export function describeCase(text) {
  const plain = (s) => s.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&amp;/g, '&');
  const attribute = (name) => plain(new RegExp(`${name}="([^"]*)"`).exec(text)?.[1] ?? '?');
  const faults = [...text.matchAll(/<Expression success="false"[\s\S]*?<\/Expression>/g)].map(([fault]) => {
    const lines = fault.replace(/<[^>]*>/g, '').split('\n').map((line) => line.trim()).filter(Boolean);
    const line = /line="(\d+)"/.exec(fault)?.[1] ?? '?';
    return `    line ${line}: ${lines.map(plain).join('\n      ')}\n`;
  });
  for (const [, line, fault] of text.matchAll(/<Message type="(?:FATAL )?ERROR"[^>]*? line="(\d+)"[^>]*>([\s\S]*?)<\/Message>/g)) {
    faults.push(`    line ${line}: ${plain(fault.replace(/<[^>]*>/g, '').trim())}\n`);
  }
  const shown = faults.slice(0, 10).join('');
  const exception = /<Exception[^>]*>([\s\S]*?)<\/Exception>/.exec(text)?.[1];
  const rest = faults.length > 10 ? `    and ${faults.length - 10} more\n` : '';
  return `  ${attribute('filename')}: ${attribute('name')}\n${shown}${rest}${exception ? `    ${plain(exception.trim())}\n` : ''}`;
}

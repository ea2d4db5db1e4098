// wasm/include/soapfilm_tables.h → wasm/ts/border.ts: the tables of the C ABI, for TypeScript.
// `node wasm/scripts/border.mjs` prints the module.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from './run.mjs';
import { writeIfChanged } from './stamp.mjs';

const header = path.join(root, 'wasm/include/soapfilm_tables.h');

/** Writes the module, if it is not up to date. */
export function writeBorder() {
  writeIfChanged(path.join(root, 'wasm/ts/border.ts'), borderModule(readFileSync(header, 'utf8')));
}

/** The module for a header's text. Throws an Error for tables that are not of the form it tells of. */
export function borderModule(text) {
  const tables = readTables(text);
  const numberOf = (type) => {
    if (kNumbers[type]) return kNumbers[type];
    const record = tables.find(({ name, kind }) => kind === 'RECORD' && `Sf${camel(name)}` === type);
    if (!record) throw new Error(`${type} is neither a number nor a record`);
    return numberOf(record.entries[0][0]);
  };
  return [kHead, ...tables.map((table) => kWriters[table.kind](table, numberOf))].join('\n');
}

const kHead = `// Made by wasm/scripts/border.mjs from wasm/include/soapfilm_tables.h, which says more: do not edit.

/** Hands over the array of that number of a result. */
export interface ArrayReader {
  (array: number, type: Float64ArrayConstructor): Float64Array;
  (array: number, type: Float32ArrayConstructor): Float32Array;
  (array: number, type: Uint32ArrayConstructor): Uint32Array;
}
`;

const kNumbers = { double: 'Float64Array', float: 'Float32Array', uint32_t: 'Uint32Array' };

/** The tables of the header: `{ name: 'SPAN', kind: 'ARRAYS', entries: [[type, name, meaning], …] }`. */
function readTables(text) {
  const whole = text.replace(/\/\*[\s\S]*?\*\/|\/\/.*$/gm, '').replace(/\\\n/g, ' ');
  const tables = [...whole.matchAll(/^[ \t]*#define SF_(\w+)\(X\)(.*)$/gm)].map(([, full, body]) => {
    const [, name, kind] = /^(?:(\w+)_)?(STATUSES|CHOICES|SETTINGS|RECORD|ARRAYS)$/.exec(full) ?? [];
    if (!kind) throw new Error(`SF_${full} is no kind of table`);
    const pattern = /\s*X\(\s*(\w+),\s*(\w+),\s*((?:"[^"\\]*"\s*)+)\)/y;
    const entries = [];
    let end = 0;
    for (let match; (match = pattern.exec(body)); end = pattern.lastIndex) {
      const [, first, second, strings] = match;
      entries.push([first, second, [...strings.matchAll(/"([^"]*)"/g)].map(([, s]) => s).join('')]);
    }
    if (entries.length === 0 || body.slice(end).trim() !== '') {
      throw new Error(`SF_${full} cannot be read from here on: ${body.slice(end).trim()}`);
    }
    return { name: name ?? '', kind, entries };
  });
  if (tables.length === 0) throw new Error('There are no tables');
  return tables;
}

const camel = (name) => name.toLowerCase().replace(/(?:^|_)([a-z])/g, (_, letter) => letter.toUpperCase());
const note = (meaning) => (meaning === '' ? '' : `  /** ${meaning} */\n`);
const lines = (entries, line) => entries.map(line).join('');

function typesOf({ name, entries }) {
  const types = new Set(entries.map(([type]) => type));
  if (types.size !== 1 || !kNumbers[entries[0][0]]) throw new Error(`SF_${name} is of several types`);
  return kNumbers[entries[0][0]];
}

const interfaceOf = (title, entries) =>
  `export interface ${title} {\n` +
  lines(entries, ([, field, meaning]) => `${note(meaning)}  readonly ${field}: number;\n`) +
  '}\n';

/** How each kind of table is written. */
const kWriters = {
  STATUSES: ({ entries }) =>
    '/** What a call of the core ends with. */\nexport const Status = {\n' +
    lines(entries, ([name, value, meaning]) => `${note(meaning)}  ${name}: ${value},\n`) +
    '} as const;\n',

  /** A list in which each choice has its number for index. */
  CHOICES: ({ name, entries }) => {
    entries.forEach(([, value], i) => {
      if (Number(value) !== i) throw new Error(`SF_${name}_CHOICES are not numbered from 0`);
    });
    const list = entries.map(([, , text]) => `'${text}'`).join(', ');
    return `export const k${camel(name)}Choices = [${list}] as const;\n`;
  },

  SETTINGS: ({ name, entries }) => {
    const title = `${camel(name)}Settings`;
    const type = typesOf({ name, entries });
    return (
      `${interfaceOf(title, entries)}\n` +
      `export const pack${title} = (settings: ${title}): ${type} =>\n  ${type}.of(\n` +
      lines(entries, ([, field]) => `    settings.${field},\n`) +
      '  );\n'
    );
  },

  RECORD: ({ name, entries }) => {
    const title = camel(name);
    typesOf({ name, entries });
    return (
      `${interfaceOf(title, entries)}\n` +
      `/** How many numbers of an array make one. */\nexport const k${title}Length = ${entries.length};\n\n` +
      `/** The one that begins at index \`at\`. */\n` +
      `export const read${title} = (from: ArrayLike<number>, at = 0): ${title} => ({\n` +
      lines(entries, ([, field], i) => `  ${field}: from[at${i > 0 ? ` + ${i}` : ''}],\n`) +
      '});\n'
    );
  },

  ARRAYS: ({ name, entries }, numberOf) => {
    const title = camel(name);
    return (
      `export interface ${title}Arrays {\n` +
      lines(entries, ([type, field, meaning]) => {
        const record = kNumbers[type] ? '' : `${type.slice(2)}: `;
        return `${note(record + meaning)}  readonly ${field}: ${numberOf(type)};\n`;
      }) +
      `}\n\nexport const read${title}Arrays = (array: ArrayReader): ${title}Arrays => ({\n` +
      lines(entries, ([type, field], i) => `  ${field}: array(${i}, ${numberOf(type)}),\n`) +
      '});\n'
    );
  },
};

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  process.stdout.write(borderModule(readFileSync(process.argv[2] ?? header, 'utf8')));
}

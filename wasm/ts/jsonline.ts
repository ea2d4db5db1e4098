// Finds lines in JSON. Engines differ in whether and how they say where a text is wrong.

const kSpace = /[ \t\r\n]*/y;
const kToken =
  /([[\]{}:,])|(?:-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][+-]?\d+)?|true|false|null)(?![\w.+-])/y;

type Awaited = 'value' | 'key' | 'colon' | 'comma';

/**
 * The line of the value at `path`; or of the first place that is not JSON, if that comes earlier;
 * undefined if there is neither. Linear time, no recursion.
 * @param path keys and indices from the root
 */
export function jsonLine(
  text: string,
  path?: readonly (string | number)[],
): number | undefined {
  const lineAt = (offset: number): number => text.slice(0, offset).split(/\r\n?|\n/).length;
  // Containers around the current place: the key, or the index, of the value within each.
  const keys: (string | number)[] = [];
  let awaited = 'value' as Awaited;
  let empty = false;
  let place = 0;
  for (;;) {
    kSpace.lastIndex = place;
    kSpace.exec(text);
    place = kSpace.lastIndex;
    kToken.lastIndex = place;
    const match: readonly (string | undefined)[] | null = kToken.exec(text);
    const string = match ? undefined : stringAt(text, place);
    if (!match && string === undefined) {
      const whole = place === text.length && awaited === 'comma' && keys.length === 0;
      return whole ? undefined : lineAt(place);
    }
    const mark = match?.[1];
    const begin = place;
    place = string === undefined ? kToken.lastIndex : place + string.length;
    const top = keys[keys.length - 1];
    const closes = (mark === ']' && typeof top === 'number') || (mark === '}' && typeof top === 'string');
    if (closes && (awaited === 'comma' || empty)) {
      keys.pop();
      awaited = 'comma';
      empty = false;
      continue;
    }
    if (awaited === 'comma' && mark === ',' && keys.length > 0) {
      if (typeof top === 'number') keys[keys.length - 1] = top + 1;
      awaited = typeof top === 'number' ? 'value' : 'key';
    } else if (awaited === 'colon' && mark === ':') {
      awaited = 'value';
    } else if (awaited === 'key' && string !== undefined) {
      keys[keys.length - 1] = JSON.parse(string) as string;
      awaited = 'colon';
    } else if (awaited === 'value' && (mark === undefined || mark === '[' || mark === '{')) {
      if (path?.length === keys.length && path.every((key, i) => key === keys[i])) {
        return lineAt(begin);
      }
      empty = mark !== undefined;
      if (mark === '[') keys.push(0);
      if (mark === '{') keys.push('');
      awaited = mark === '{' ? 'key' : mark === '[' ? 'value' : 'comma';
      continue;
    } else {
      return lineAt(begin);
    }
    empty = false;
  }
}

/** The string literal that begins at an offset, if there is one. No RegExp: long literals defeat it. */
function stringAt(text: string, offset: number): string | undefined {
  if (text[offset] !== '"') return undefined;
  let end = offset;
  let escaped: boolean;
  do {
    end = text.indexOf('"', end + 1);
    if (end < 0) return undefined;
    let before = end;
    while (text[before - 1] === '\\') before--;
    escaped = (end - before) % 2 === 1;
  } while (escaped);
  const literal = text.slice(offset, end + 1);
  try {
    JSON.parse(literal);
    return literal;
  } catch {
    return undefined;
  }
}

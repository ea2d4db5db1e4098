// Words and numbers of a text, line by line. No line is cut out before it is needed: files have millions.
import { SoapfilmError } from 'soapfilm';

export const bad = (reason: string, line?: number): SoapfilmError =>
  new SoapfilmError('bad-file', line === undefined ? reason : `Line ${line}: ${reason}`);

/** An array that grows. */
export class Growing<T extends Float32Array | Uint32Array> {
  length = 0;

  constructor(private items: T) {}

  push(value: number): void {
    if (this.length === this.items.length) {
      const larger = new (this.items.constructor as new (length: number) => T)(2 * this.length);
      larger.set(this.items);
      this.items = larger;
    }
    this.items[this.length++] = value;
  }

  at(index: number): number {
    return this.items[index];
  }

  taken(): T {
    return this.items.slice(0, this.length) as T;
  }
}

export class Scanner {
  /** From 1. */
  line = 1;
  private at: number;

  constructor(
    private readonly text: string,
    from = 0,
    line = 1,
  ) {
    this.at = from;
    this.line = line;
  }

  get isAtEnd(): boolean {
    return this.at >= this.text.length;
  }

  /** The next word of the line; empty at its end. */
  word(): string {
    const { text } = this;
    let { at } = this;
    while (at < text.length && isBlank(text.charCodeAt(at))) at++;
    const from = at;
    while (at < text.length && text.charCodeAt(at) > 32) at++;
    this.at = at;
    return text.slice(from, at);
  }

  /** The next word, in whatever line; empty at the end of the text. */
  nextWord(): string {
    for (;;) {
      const word = this.word();
      if (word !== '' || !this.nextLine()) return word;
    }
  }

  /** @param what what it is of, for the error */
  number(what: string, word = this.word()): number {
    const value = Number(word);
    if (word !== '' && Number.isFinite(Math.fround(value))) return value;
    throw bad(word === '' ? `a number of ${what} is missing` : `“${word.slice(0, 30)}” is not a finite number`, this.line);
  }

  /** Goes to the beginning of the next line, after a line feed or a carriage return or both; says whether there is any. */
  nextLine(): boolean {
    const { text } = this;
    let { at } = this;
    while (at < text.length && text.charCodeAt(at) !== 10 && text.charCodeAt(at) !== 13) at++;
    if (text.charCodeAt(at) === 13 && text.charCodeAt(at + 1) === 10) at++;
    this.at = at + 1;
    this.line++;
    return !this.isAtEnd;
  }
}

/** Of a line: not its end. */
const isBlank = (code: number): boolean => code <= 32 && code !== 10 && code !== 13;

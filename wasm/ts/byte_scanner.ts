// Words and numbers of a text in bytes, line by line. No text is made of them but of single words: files have hundreds of
// megabytes.
import { badFile } from './mesh_file.js';

const [kTab, kLineFeed, kReturn, kBlank, kHash, kPlus, kMinus, kPoint, kBackslash] = [9, 10, 13, 32, 35, 43, 45, 46, 92];

/** Exact as doubles. */
const kPowers = Array.from({ length: 23 }, (_, k) => Number(`1e${k}`));

export class ByteScanner {
  /** From 1. */
  line: number;
  at: number;

  /** @param hasComments whether a word that begins with `#` ends its line, and a backslash at its end goes on in the next */
  constructor(
    private readonly bytes: Uint8Array,
    private readonly hasComments: boolean,
    from = 0,
    line = 1,
  ) {
    this.at = from;
    this.line = line;
  }

  get isAtEnd(): boolean {
    return this.at >= this.bytes.length;
  }

  /** Goes to the next word of the line; says whether there is any. */
  toWord(): boolean {
    const { bytes } = this;
    for (;;) {
      const code = bytes[this.at];
      if (code === kBlank || code === kTab || (code < kBlank && code !== kLineFeed && code !== kReturn)) this.at++;
      else if (code === kBackslash && this.hasComments && this.isLineEnd(this.at + 1)) {
        this.at++;
        this.passLineEnd();
      } else return code > kBlank && !(code === kHash && this.hasComments);
    }
  }

  /** The code at the place, or after it; 0 beyond the end. */
  peek(after = 0): number {
    return this.bytes[this.at + after] ?? 0;
  }

  /** Whether a word ends before the place so far after this one. */
  isWordEnd(after = 0): boolean {
    return this.isEnd(this.at + after);
  }

  /** The next word of the line; empty at its end. */
  word(): string {
    if (!this.toWord()) return '';
    const from = this.at;
    while (!this.isWordEnd()) this.at++;
    return this.textFrom(from);
  }

  /** A finite number of single precision's range, as exact as a double is. @param what what it is of, for the error */
  number(what: string): number {
    const value = this.value(what);
    if (Number.isFinite(Math.fround(value))) return value;
    throw badFile(`a number of ${what} is not finite`, { line: this.line });
  }

  /** A number; perhaps NaN or infinite, if the file says so. */
  value(what: string): number {
    if (!this.toWord()) throw badFile(`a number of ${what} is missing`, { line: this.line });
    const from = this.at;
    const { bytes } = this;
    let at = from;
    let code = bytes[at];
    const isNegative = code === kMinus;
    if (isNegative || code === kPlus) code = bytes[++at];
    let [mantissa, digits, scale] = [0, 0, 0];
    let hasDigits = false;
    for (let isBehind = false; ; code = bytes[++at]) {
      const digit = code - 48;
      if (digit >= 0 && digit <= 9) {
        hasDigits = true;
        mantissa = 10 * mantissa + digit;
        if (mantissa > 0) digits++;
        if (isBehind) scale--;
      } else if (code === kPoint && !isBehind) isBehind = true;
      else break;
    }
    if ((code === 101 || code === 69) && hasDigits) {
      code = bytes[++at];
      const isSmall = code === kMinus;
      if (isSmall || code === kPlus) code = bytes[++at];
      let exponent = 0;
      hasDigits = false;
      for (; code >= 48 && code <= 57; code = bytes[++at]) {
        hasDigits = true;
        exponent = Math.min(9999, 10 * exponent + code - 48);
      }
      scale += isSmall ? -exponent : exponent;
    }
    if (!hasDigits || !this.isEnd(at)) return this.otherValue(from);
    this.at = at;
    // Both exact, so that dividing or multiplying rounds once, as reading the text would (Clinger 1990).
    if (digits <= 15 && scale >= -22 && scale <= 22) {
      const size = scale < 0 ? mantissa / kPowers[-scale] : mantissa * kPowers[scale];
      return isNegative ? -size : size;
    }
    return Number(this.textFrom(from));
  }

  /** A whole number, up to a sign or a digit that is none; NaN where there is none. */
  integer(): number {
    const { bytes } = this;
    const isNegative = bytes[this.at] === kMinus;
    if (isNegative || bytes[this.at] === kPlus) this.at++;
    const from = this.at;
    let value = 0;
    for (let code = bytes[this.at]; code >= 48 && code <= 57; code = bytes[++this.at]) value = 10 * value + code - 48;
    return this.at === from ? NaN : isNegative ? -value : value;
  }

  /** Goes to the beginning of the next line, after a line feed or a carriage return or both; says whether there is any. */
  nextLine(): boolean {
    const { bytes } = this;
    while (this.at < bytes.length && !this.isLineEnd(this.at)) this.at++;
    this.passLineEnd();
    return !this.isAtEnd;
  }

  /** The word at a place as text, cut where it is long. */
  wordAt(at: number): string {
    let end = at;
    while (this.bytes[end] > kBlank && end < at + 30) end++;
    return new TextDecoder().decode(this.bytes.subarray(at, end));
  }

  private otherValue(from: number): number {
    const word = this.wordAt(from);
    this.at = from + word.length;
    if (/^[-+]?nan$/i.test(word)) return NaN;
    if (/^[-+]?inf(inity)?$/i.test(word)) return word.startsWith('-') ? -Infinity : Infinity;
    throw badFile(`“${word}” is not a number`, { line: this.line });
  }

  private textFrom(from: number): string {
    let text = '';
    for (let i = from; i < this.at; i++) text += String.fromCharCode(this.bytes[i]);
    return text;
  }

  private isEnd(at: number): boolean {
    const code = this.bytes[at];
    return !(code > kBlank) || (code === kBackslash && this.hasComments && this.isLineEnd(at + 1));
  }

  private isLineEnd(at: number): boolean {
    return this.bytes[at] === kLineFeed || this.bytes[at] === kReturn;
  }

  private passLineEnd(): void {
    if (this.bytes[this.at] === kReturn && this.bytes[this.at + 1] === kLineFeed) this.at++;
    this.at++;
    this.line++;
  }
}

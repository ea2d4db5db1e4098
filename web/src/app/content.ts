// The content of a file, in the forms that telling its format and reading it need; each made once.

/** Enough to tell a format by its beginning. */
const kHeadBytes = 4096;

/** Space, tab, line feed and carriage return. */
const kBlanks: readonly number[] = [32, 9, 10, 13];

/** Encodings besides UTF-8, by the two bytes that such a text begins with. */
const kEncodings: readonly (readonly [first: number, second: number, name: string])[] = [
  [0xff, 0xfe, 'utf-16le'],
  [0xfe, 0xff, 'utf-16be'],
];

export class Content {
  #head: string | undefined;
  #text: string | undefined;
  #json: { readonly value: unknown } | null | undefined;

  constructor(
    readonly bytes: Uint8Array,
    /** Without its extension. */
    readonly stem: string,
  ) {}

  /** The beginning, as text, without leading white space. */
  get head(): string {
    if (this.#head === undefined) {
      // White space of any length, in one byte a character or two; the byte mark stays.
      let first = 0;
      while (first < this.bytes.length && kBlanks.includes(this.bytes[first])) first++;
      const from = first < kHeadBytes ? 0 : first & ~1;
      this.#head = this.#decode(this.bytes.subarray(from, from + 2 * kHeadBytes)).trimStart();
    }
    return this.#head;
  }

  /** The beginning without `#` comments, and without the white space before what is left. */
  get start(): string {
    return this.head.replace(/#.*/g, '').trimStart();
  }

  /** All of it, in whatever encoding it is; reading takes this rather than the bytes. */
  get text(): string {
    this.#text ??= this.#decode(this.bytes);
    return this.#text;
  }

  /** Whether it is text, as far as its beginning tells. */
  get isText(): boolean {
    return !this.head.includes('\0');
  }

  /** Undefined where it is not JSON. */
  get json(): unknown {
    if (this.#json === undefined) {
      this.#json = null;
      if (/^[{[]/.test(this.head)) {
        try {
          this.#json = { value: JSON.parse(this.text) };
        } catch {
          // Whoever reads it says what is wrong, and in which line.
        }
      }
    }
    return this.#json?.value;
  }

  /** Whether the bytes from `at` on are those of the letters. */
  hasMark(letters: string, at = 0): boolean {
    return Array.from(letters).every((letter, i) => this.bytes[at + i] === letter.charCodeAt(0));
  }

  /** Whether it looks like JSON, broken or not. */
  get isJson(): boolean {
    return this.isText && /^[{[]/.test(this.head);
  }

  /** The `type` of a JSON object. */
  get jsonType(): string | undefined {
    const type = this.#jsonObject?.type;
    return typeof type === 'string' ? type : undefined;
  }

  /** Whether it is a JSON object with such a key. */
  hasKey(key: string): boolean {
    return this.#jsonObject !== null && key in this.#jsonObject;
  }

  /** Whether any line is a statement of an OBJ file: its name, then numbers. */
  hasStatement(name: string): boolean {
    return this.isText && new RegExp(`^[ \\t]*${name}[ \\t]+[-+.\\d]`, 'm').test(this.text);
  }

  get #jsonObject(): Record<string, unknown> | null {
    const { json } = this;
    return typeof json === 'object' && json !== null ? (json as Record<string, unknown>) : null;
  }

  #decode(bytes: Uint8Array): string {
    const [first, second] = this.bytes;
    const encoding = kEncodings.find((each) => each[0] === first && each[1] === second);
    return new TextDecoder(encoding?.[2]).decode(bytes);
  }
}

// The content of a file, in the forms that telling its format and reading it need; each made once.

export class Content {
  #text: string | undefined;
  #json: { readonly value: unknown } | null | undefined;

  constructor(
    readonly bytes: Uint8Array,
    /** Without its extension. */
    readonly stem: string,
  ) {}

  /** The beginning, as text, without leading white space. */
  get head(): string {
    return new TextDecoder().decode(this.bytes.subarray(0, 4096)).trimStart();
  }

  get text(): string {
    this.#text ??= new TextDecoder().decode(this.bytes);
    return this.#text;
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

  /** Whether it looks like JSON, broken or not. */
  get isJson(): boolean {
    return this.json !== undefined || /^[{[]/.test(this.head);
  }

  /** The `type` of a JSON object. */
  get jsonType(): string | undefined {
    const { json } = this;
    const type = typeof json === 'object' && json !== null && 'type' in json ? json.type : undefined;
    return typeof type === 'string' ? type : undefined;
  }

  /** Whether any line of an OBJ file begins with a statement. */
  hasStatement(name: string): boolean {
    return new RegExp(`^\\s*${name}\\s`, 'm').test(this.text);
  }
}

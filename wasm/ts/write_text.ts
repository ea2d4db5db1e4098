// Text in bytes, piece by piece: a text of all lines may be larger than a text can be.

/** About as many characters are kept as text before they become bytes. */
const kPiece = 1 << 16;

export class TextWriter {
  private bytes = new Uint8Array(1 << 20);
  private length = 0;
  private text = '';

  add(line: string): void {
    this.text += line;
    if (this.text.length >= kPiece) this.flush();
  }

  taken(): Uint8Array<ArrayBuffer> {
    this.flush();
    return this.bytes.slice(0, this.length);
  }

  private flush(): void {
    // A character has three bytes at most; those of two units have four.
    const needed = this.length + 3 * this.text.length;
    if (needed > this.bytes.length) {
      const larger = new Uint8Array(Math.max(needed, 2 * this.bytes.length));
      larger.set(this.bytes);
      this.bytes = larger;
    }
    this.length += new TextEncoder().encodeInto(this.text, this.bytes.subarray(this.length)).written;
    this.text = '';
  }
}

/** As many digits as give the number back as it was: nine for single precision. */
export const digitsOf = (array: Float32Array | Float64Array): ((x: number) => string) =>
  array instanceof Float64Array ? String : (x) => String(Number(x.toPrecision(9)));

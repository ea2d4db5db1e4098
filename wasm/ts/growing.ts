type Kind = Float32Array | Float64Array | Uint32Array;

/** An array that grows. */
export class Growing<T extends Kind> {
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

  /** Sets one that there is. */
  set(index: number, value: number): void {
    this.items[index] = value;
  }

  /** Copies all to where they begin in another array. */
  copyTo(target: Kind, begin: number): void {
    target.set(this.items.subarray(0, this.length), begin);
  }

  taken(): T {
    return this.items.slice(0, this.length) as T;
  }
}

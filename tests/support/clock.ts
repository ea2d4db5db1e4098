// A clock that counts how often it is looked at, so that limits in seconds end work at the same place on every machine.
import { vi } from 'vitest';

export interface CountingClock {
  /** Milliseconds since it began; does not count as a look. */
  now(): number;
  /** Gives `performance.now` its own time back. */
  restore(): void;
}

/** `performance.now` goes on by one millisecond with each look at it, until `restore`. */
export function countingClock(): CountingClock {
  const began = performance.now();
  let elapsed = 0;
  const spy = vi.spyOn(performance, 'now').mockImplementation(() => began + ++elapsed);
  return {
    now: () => elapsed,
    restore() {
      spy.mockRestore();
    },
  };
}

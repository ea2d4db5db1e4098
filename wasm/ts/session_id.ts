// How sessions are named, those in this thread and those in threads of a pool.
import { SoapfilmError } from './errors.js';

let count = 0;

/** The number of a new session: 1 for the first that this thread opens. */
export const newSessionId = (): number => ++count;

export const sessionDisposed = (id: number): SoapfilmError =>
  new SoapfilmError('disposed', `Session ${id} is disposed of`);

/** The ids of sessions that are lost together with one, as the end of a message about that one. */
export function lostWith(id: number, all: Iterable<number>, shared: string): string {
  const others = [...all].filter((other) => other !== id);
  const more = others.length > 0 ? `, and what shared its ${shared}: session ${others.join(', ')}` : '';
  return `; session ${id} is lost${more}`;
}

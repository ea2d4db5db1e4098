// A passing remark to the user. Errors of work are kept with the work; these are about what was just done.
import { signal } from '@preact/signals';

/** What a remark is about: it goes once that is tried anew, or no longer so. */
export type Cause = 'stroke' | 'plane' | 'file' | 'export' | 'mode' | 'dialog' | 'draft' | 'other';

export interface Notice {
  readonly kind: 'info' | 'error';
  readonly text: string;
  readonly cause: Cause;
  /** What can be done about it. */
  readonly action?: { readonly label: string; readonly run: () => void };
}

export const notice = signal<Notice | null>(null);

const kInfoMs = 4500;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Shows a remark: an error until its cause goes, anything else for a few seconds unless it asks for something. */
export function say(text: string, cause: Cause, rest: Partial<Pick<Notice, 'kind' | 'action'>> = {}): void {
  clearTimeout(timer);
  const { kind = 'info', action } = rest;
  notice.value = { kind, text, cause, ...(action && { action }) };
  if (kind === 'info' && action === undefined) timer = setTimeout(dismissNotice, kInfoMs);
}

export const complain = (text: string, cause: Cause, action?: Notice['action']): void => {
  say(text, cause, { kind: 'error', ...(action && { action }) });
};

export function dismissNotice(): void {
  clearTimeout(timer);
  notice.value = null;
}

/** These causes are gone. */
export function settle(...causes: readonly Cause[]): void {
  const now = notice.peek();
  if (now !== null && causes.includes(now.cause)) dismissNotice();
}

// Which dialog is open. The dialogs themselves are fetched when one is first wanted.
import { useEffect, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import { complain, settle } from '../state/notice.ts';
import type { Action } from './actions.ts';

/** `help`, or one that a mode brings. */
export const openDialog = signal<string | null>(null);

type SheetsModule = typeof import('./sheets.tsx');

export function Dialogs({ actions }: { actions: readonly Action[] }) {
  const [found, setFound] = useState<SheetsModule | null>(null);
  const isWanted = openDialog.value !== null;
  useEffect(() => {
    if (!isWanted || found) return;
    settle('dialog');
    import('./sheets.tsx').then(setFound, () => {
      openDialog.value = null;
      complain('This dialog could not be loaded.', 'dialog');
    });
  }, [isWanted]);
  return found && <found.Sheets actions={actions} />;
}

// Which dialog is open. The dialogs themselves are fetched when one is first wanted.
import { useEffect, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import { say } from '../state/store.ts';

export type DialogId = 'gallery' | 'help';
export const openDialog = signal<DialogId | null>(null);

type SheetsModule = typeof import('./sheets.tsx');

export function Dialogs() {
  const [found, setFound] = useState<SheetsModule | null>(null);
  const isWanted = openDialog.value !== null;
  useEffect(() => {
    if (!isWanted || found) return;
    import('./sheets.tsx').then(setFound, () => {
      openDialog.value = null;
      say('This dialog could not be loaded.', 'error');
    });
  }, [isWanted]);
  return found && <found.Sheets />;
}

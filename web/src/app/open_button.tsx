// The button that opens files, with the file input that it stands for; `chooseFile` opens the browser's dialog for it.
import type { Action } from './actions.ts';
import { ActionButton } from './bars.tsx';

let fileInput: HTMLInputElement | null = null;
export function chooseFile(): void {
  fileInput?.click();
}

interface OpenButtonProps {
  readonly action: Action;
  /** What the files hold. */
  readonly of: string;
  /** Their extensions, with dots and commas. */
  readonly accept: string;
  readonly open: (files: readonly File[]) => Promise<void>;
}

export function OpenButton({ action, of, accept, open }: OpenButtonProps) {
  return (
    <>
      <ActionButton action={action} />
      <input
        ref={(element) => {
          if (element) fileInput = element;
        }}
        type="file"
        multiple
        hidden
        accept={accept}
        aria-label={`File of ${of}`}
        onChange={(event) => {
          const input = event.currentTarget;
          // So that the same file can be opened again.
          void open([...(input.files ?? [])]).finally(() => (input.value = ''));
        }}
      />
    </>
  );
}

// The file input in the page; `chooseFile` opens the browser's dialog for it.
import { IconButton } from './bars.tsx';

let fileInput: HTMLInputElement | null = null;
export function chooseFile(): void {
  fileInput?.click();
}

interface OpenButtonProps {
  /** What the files hold. */
  readonly of: string;
  /** Their extensions, with dots and commas. */
  readonly accept: string;
  readonly open: (files: readonly File[]) => Promise<void>;
}

export function OpenButton({ of, accept, open }: OpenButtonProps) {
  return (
    <>
      <IconButton icon="open" label="Open a file" text="Open" keys="Ctrl O" onClick={chooseFile} />
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

// The gallery and the help sheet, as dialogs; what stands in them is fetched when it is first wanted.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import { Icon } from './icons.tsx';

type DialogId = 'gallery' | 'help';
export const openDialog = signal<DialogId | null>(null);

interface DialogProps {
  readonly id: DialogId;
  readonly title: string;
  readonly children: ComponentChildren;
}

function Dialog({ id, title, children }: DialogProps) {
  const ref = useRef<HTMLDialogElement>(null);
  const isOpen = openDialog.value === id;
  useLayoutEffect(() => {
    if (isOpen) ref.current?.showModal();
    else ref.current?.close();
  }, [isOpen]);
  const close = () => {
    if (openDialog.peek() === id) openDialog.value = null;
  };
  return (
    <dialog
      ref={ref}
      class={`dialog ${id}`}
      aria-labelledby={`${id}-title`}
      onClose={() => {
        // The event comes late: by then the dialog may have been opened again.
        if (ref.current?.open === false) close();
      }}
      onClick={(event) => {
        // On the backdrop, which counts as the dialog itself.
        if (event.target === event.currentTarget) close();
      }}
    >
      <div class="dialog-body">
        <header>
          <h2 id={`${id}-title`}>{title}</h2>
          <button type="button" class="icon-button" aria-label="Close" onClick={close}>
            <Icon name="close" />
          </button>
        </header>
        {isOpen && children}
      </div>
    </dialog>
  );
}

type Sheets = typeof import('./sheets.tsx');

export function Dialogs() {
  const [sheets, setSheets] = useState<Sheets | null>(null);
  const [problem, setProblem] = useState('Loading…');
  const isWanted = openDialog.value !== null;
  useEffect(() => {
    if (!isWanted || sheets) return;
    import('./sheets.tsx').then(setSheets, () => {
      setProblem('This could not be loaded.');
    });
  }, [isWanted]);
  return (
    <>
      <Dialog id="gallery" title="Gallery">
        {sheets ? <sheets.Gallery /> : problem}
      </Dialog>
      <Dialog id="help" title="Keys and gestures">
        {sheets ? <sheets.Help /> : problem}
      </Dialog>
    </>
  );
}

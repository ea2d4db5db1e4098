// The dialogs: those of modes, and what keys and gestures do in the mode that is shown.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { keysOf, labelOf, type Action } from './actions.ts';
import { coreHelp } from './core_actions.ts';
import { openDialog } from './dialogs.tsx';
import { Icon } from './icons.tsx';
import { current } from './rooms.ts';
import '../styles/dialogs.css';

export function Sheets({ actions }: { actions: readonly Action[] }) {
  return (
    <>
      {current.value?.room.dialogs?.map(({ id, title, Body }) => (
        <Dialog key={id} id={id} title={title}>
          <Body />
        </Dialog>
      ))}
      <Dialog id="help" title="Keys and gestures">
        <Help actions={actions} />
      </Dialog>
    </>
  );
}

interface DialogProps {
  readonly id: string;
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

/** In this order, and then those of the mode. */
const kSections = ['Tools', 'View', 'Edit', 'File'];

function Help({ actions }: { actions: readonly Action[] }) {
  const room = current.value?.room;
  const ofActions = actions.flatMap((action) => {
    const keys = keysOf(action);
    return action.section && keys ? [{ section: action.section, keys, what: action.help ?? labelOf(action) }] : [];
  });
  const rows = [...ofActions, ...(room ? coreHelp(room) : []), ...(room?.help.rows ?? [])];
  const sections = [...new Set([...kSections, ...rows.map(({ section }) => section)])].filter((title) => rows.some(({ section }) => section === title));
  return (
    <>
      <p class="muted">{room?.help.about} On a Mac, Ctrl is ⌘.</p>
      <div class="help-columns">
        {sections.map((title) => (
          <section key={title}>
            <h3>{title}</h3>
            <dl>
              {rows.filter(({ section }) => section === title).map(({ keys, what }) => (
                <div key={`${keys} ${what}`}>
                  <dt>
                    <kbd>{keys}</kbd>
                  </dt>
                  <dd>{what}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </>
  );
}

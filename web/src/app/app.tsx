// The page: the bar at the top, the scene with all that floats over it, the panel beside it, dialogs.
import { useId, useState } from 'preact/hooks';
import type { Stage } from '../scene/stage.ts';
import { group, tool } from '../state/store.ts';
import type { Action } from './actions.ts';
import { ActionButton, ExportMenu, HistoryButtons, inBar, ToolBar, ViewBar } from './bars.tsx';
import { Busy } from './busy.tsx';
import { Dialogs } from './dialogs.tsx';
import { DropZone } from './drop_zone.tsx';
import { FaultLabels } from './fault_labels.tsx';
import { openFiles } from './files.ts';
import { Gizmo } from './gizmo.tsx';
import { Icon, Logo } from './icons.tsx';
import type { Mode, Room } from './mode.ts';
import { ModeSwitch } from './mode_switch.tsx';
import { OpenButton } from './open_button.tsx';
import { current, firstMode, goTo } from './rooms.ts';
import { Toast } from './toast.tsx';

interface AppProps {
  readonly modes: readonly Mode[];
  readonly stage: Stage;
  readonly scene: HTMLElement;
  /** Those of the mode that the page is in; read as a signal is. */
  readonly actions: () => readonly Action[];
}

export function App({ modes, stage, scene, actions }: AppProps) {
  const now = current.value;
  const all = actions();
  const open = (files: readonly File[]) => openIn(modes, files);
  return (
    <>
      <header class="top-bar">
        <h1>
          <Logo />
          <span>soapfilm</span>
        </h1>
        <ModeSwitch modes={modes} />
        {now && (
          <nav aria-label="Document">
            {inBar(all, 'document').map((action) => (
              <ActionButton key={action.id} action={action} />
            ))}
            {inBar(all, 'open').map((action) => (
              <OpenButton key={action.id} action={action} of={now.room.fileNoun ?? now.room.nouns[1]} accept={acceptOf(now.mode)} open={open} />
            ))}
            <ExportMenu actions={all} />
            <HistoryButtons actions={all} />
          </nav>
        )}
        <span class="document-name">{group.value?.name}</span>
        {inBar(all, 'help').map((action) => (
          <ActionButton key={action.id} action={action} />
        ))}
      </header>
      <main>
        <div class="viewport">
          <div
            ref={(element) => {
              if (element && scene.parentElement !== element) element.append(scene);
            }}
          />
          {now && <Floating room={now.room} stage={stage} actions={all} />}
          <Toast />
        </div>
        {now && <Panel key={now.mode.id} room={now.room} />}
      </main>
      <DropZone mode={now?.mode ?? null} open={(files) => void open(files)} />
      <Dialogs actions={all} />
    </>
  );
}

/** What floats over the scene. */
function Floating({ room, stage, actions }: { room: Room; stage: Stage; actions: readonly Action[] }) {
  const { Overlay } = room;
  return (
    <>
      {group.value?.items.length === 0 && room.hint && <Hint hint={room.hint} actions={actions} />}
      <ToolBar actions={actions} />
      {Overlay && <Overlay />}
      {room.dimension === 3 && <Gizmo view={stage.view} viewpoint={() => stage.current.peek()?.viewpoint} />}
      <ViewBar actions={actions} />
      <FaultLabels stage={stage} failures={room.failures.value} />
      <Busy />
    </>
  );
}

/** The panel beside the scene; on narrow screens a sheet below it. */
function Panel({ room: { Panel: Body, panelLabel, summary } }: { room: Room }) {
  const id = useId();
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      <aside class={isOpen ? 'panel open' : 'panel'} aria-label={panelLabel}>
        <button
          type="button"
          class="panel-handle"
          aria-expanded={isOpen}
          aria-controls={id}
          onClick={() => {
            setOpen(!isOpen);
          }}
        >
          <span>{summary.value}</span>
          <Icon name="chevron" />
        </button>
        <div class="panel-body" id={id}>
          <Body />
        </div>
      </aside>
      <p class="visually-hidden" role="status" aria-live="polite">
        {summary.value}
      </p>
    </>
  );
}

/** How to begin, over a scene with nothing in it. */
function Hint({ hint, actions }: { hint: NonNullable<Room['hint']>; actions: readonly Action[] }) {
  return (
    <div class="hint">
      {tool.value === 'draw' ? (
        <p>{hint.drawing}</p>
      ) : (
        <>
          <p>Nothing here yet.</p>
          <div class="hint-actions">
            <button type="button" class="button primary" onClick={() => (tool.value = 'draw')}>
              {hint.draw}
            </button>
            {inBar(actions, 'document').map((action) => (
              <button key={action.id} type="button" class="button" onClick={() => { action.run(); }}>
                {action.help}
              </button>
            ))}
          </div>
        </>
      )}
    </div>
  );
}

async function openIn(modes: readonly Mode[], files: readonly File[]): Promise<void> {
  // Files that come before the page is there wait for it.
  if (files.length > 0) await openFiles(files, { ...(current.peek() ?? (await firstMode())), modes, go: goTo });
}

const acceptOf = ({ files }: Mode): string => [...new Set(files.flatMap(({ extensions }) => extensions))].join(',');

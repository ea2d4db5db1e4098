// The page: bars, scene, panel, dialogs.
import { useEffect, useState } from 'preact/hooks';
import { computed } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import { countOf, openFile } from '../state/files.ts';
import { endSpan, solve, surface } from '../state/solving.ts';
import { dismissNotice, doc, notice, tool } from '../state/store.ts';
import { PenBar, ToolBar, TopBar, ViewBar } from './bars.tsx';
import { Gallery, Help, openDialog } from './dialogs.tsx';
import { Gizmo } from './gizmo.tsx';
import { Icon } from './icons.tsx';
import { Inspector } from './inspector.tsx';
import { figure } from './result.tsx';

/** One line on how things stand: heard by screen readers, seen at the head of the panel on phones. */
export const summary = computed(() => {
  const state = solve.value;
  switch (state.phase) {
    case 'idle':
      return 'No curves yet';
    case 'running':
      return 'Spanning…';
    case 'none':
      return 'No surface in this space';
    case 'failed':
      return state.message;
    case 'cancelled':
      return 'Cancelled';
    case 'done': {
      const span = surface.value?.span;
      return span ? `Cost ${figure(span.cost)}, ${countOf(span.triangles.length / 3, 'triangle')}` : '';
    }
  }
});

export function App({ stage, scene }: { stage: Stage; scene: HTMLElement }) {
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      <TopBar stage={stage} />
      <main>
        <div
          class="viewport"
          ref={(element) => {
            if (element && scene.parentElement !== element) element.prepend(scene);
          }}
        >
          <Hint />
          <ToolBar />
          <PenBar stage={stage} />
          <Gizmo stage={stage} />
          <ViewBar stage={stage} />
          <Toast />
          <Busy />
        </div>
        <aside class={isOpen ? 'panel open' : 'panel'} aria-label="Film">
          <button
            type="button"
            class="panel-handle"
            aria-expanded={isOpen}
            aria-controls="panel-body"
            onClick={() => {
              setOpen(!isOpen);
            }}
          >
            <span>{summary.value}</span>
            <Icon name="chevron" />
          </button>
          <div class="panel-body" id="panel-body">
            <Inspector />
          </div>
        </aside>
      </main>
      <p class="visually-hidden" role="status" aria-live="polite">
        {summary.value}
      </p>
      <DropZone />
      <Gallery />
      <Help />
    </>
  );
}

function Hint() {
  if (doc.value.curves.length > 0) return null;
  return (
    <div class="hint">
      {tool.value === 'draw' ? (
        <p>Draw one stroke all the way round: it closes when you let go.</p>
      ) : (
        <>
          <p>Nothing here yet.</p>
          <div class="hint-actions">
            <button type="button" class="button primary" onClick={() => (tool.value = 'draw')}>
              Draw a curve
            </button>
            <button type="button" class="button" onClick={() => (openDialog.value = 'gallery')}>
              Open the gallery
            </button>
          </div>
        </>
      )}
    </div>
  );
}

function Toast() {
  const current = notice.value;
  return (
    <div class="toast-place" aria-live="polite">
      {current && (
        <div class={`toast floating ${current.kind}`}>
          <span>{current.text}</span>
          <button type="button" class="icon-button small" aria-label="Dismiss" onClick={dismissNotice}>
            <Icon name="close" />
          </button>
        </div>
      )}
    </div>
  );
}

const kBusyAfterMs = 400;

/** The progress over the scene, for spans that take long enough to be noticed. */
function Busy() {
  const state = solve.value;
  const since = state.phase === 'running' ? state.since : null;
  const [late, setLate] = useState<number | null>(null);
  useEffect(() => {
    if (since === null) return;
    const timer = setTimeout(() => {
      setLate(since);
    }, kBusyAfterMs);
    return () => {
      clearTimeout(timer);
    };
  }, [since]);
  if (state.phase !== 'running' || late !== since) return null;
  return (
    <div class="busy floating">
      <progress aria-label="Spanning, over the scene" max={1} value={state.fraction} />
      <span>{Math.floor(100 * state.fraction)} %</span>
      <button type="button" class="button small" onClick={endSpan}>
        Cancel
      </button>
    </div>
  );
}

/** Takes a file dropped anywhere on the page. */
function DropZone() {
  const [over, setOver] = useState(false);
  useEffect(() => {
    let depth = 0;
    const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    const onEnter = (event: DragEvent) => {
      if (!hasFile(event)) return;
      depth++;
      setOver(true);
    };
    const onLeave = (event: DragEvent) => {
      if (hasFile(event) && --depth <= 0) setOver(false);
    };
    const onOver = (event: DragEvent) => {
      if (hasFile(event)) event.preventDefault();
    };
    const onDrop = (event: DragEvent) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      depth = 0;
      setOver(false);
      const file = event.dataTransfer?.files[0];
      if (file) void openFile(file);
    };
    window.addEventListener('dragenter', onEnter);
    window.addEventListener('dragleave', onLeave);
    window.addEventListener('dragover', onOver);
    window.addEventListener('drop', onDrop);
    return () => {
      window.removeEventListener('dragenter', onEnter);
      window.removeEventListener('dragleave', onLeave);
      window.removeEventListener('dragover', onOver);
      window.removeEventListener('drop', onDrop);
    };
  }, []);
  return over ? <div class="drop-zone">Drop a .curve, JSON or OBJ file</div> : null;
}

// The page: bars, scene, panel, dialogs.
import { useEffect, useState } from 'preact/hooks';
import { computed } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import { countOf, openFile } from '../state/files.ts';
import { endSpan, solve, surface } from '../state/solving.ts';
import { doc, mode, tool } from '../state/store.ts';
import { PenBar, ToolBar, TopBar, ViewBar } from './bars.tsx';
import { Gallery, Help, openDialog } from './dialogs.tsx';
import { Gizmo } from './gizmo.tsx';
import { Icon } from './icons.tsx';
import { Inspector } from './inspector.tsx';
import { polygonModule } from './modes.tsx';
import { figure } from './result.tsx';
import { Toast } from './toast.tsx';

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
      <main hidden={mode.value !== 'film'}>
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
          {mode.value === 'film' && <Toast />}
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
      {polygonModule.value && (
        <main hidden={mode.value !== 'polygon'}>
          <polygonModule.value.PolygonMode />
        </main>
      )}
      <p class="visually-hidden" role="status" aria-live="polite">
        {mode.value === 'film' && summary.value}
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
      const open = mode.peek() === 'film' ? openFile : polygonModule.peek()?.openPolygonFile;
      if (file) void open?.(file);
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
  const kinds = mode.value === 'film' ? '.curve, JSON or OBJ' : 'GeoJSON, .curve, JSON or OBJ';
  return over ? <div class="drop-zone">Drop a {kinds} file</div> : null;
}

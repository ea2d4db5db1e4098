// The page's first mode: curves in space, drawn or opened, spanned as they change.
import { useEffect, useRef, useState } from 'preact/hooks';
import { computed, signal } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import type { PlaneKind } from '../shapes/plane.ts';
import { countOf, openFile, saveLoops, savePicture, saveSurface } from '../state/files.ts';
import { endSpan, isStale, solve, surface } from '../state/solving.ts';
import { dispatch, doc, drawing, history, isGrowing, selection, tool, type Drawing } from '../state/store.ts';
import { addCircle, deleteSelected } from './actions.ts';
import { HistoryButtons, IconButton, OpenButton, PenFields, ToolBar, ViewBar } from './bars.tsx';
import { linear, NumberField, Segments, type Choice } from './controls.tsx';
import { openDialog } from './dialogs.tsx';
import { Frame, Hint } from './frame.tsx';
import { Gizmo } from './gizmo.tsx';
import { Icon } from './icons.tsx';
import { Inspector } from './inspector.tsx';
import { figure } from './result.tsx';

const summary = computed(() => {
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

export function FilmMode({ stage, scene }: { stage: Stage; scene: HTMLElement }) {
  const playing = isGrowing.value;
  return (
    <Frame of="film" label="Film" summary={summary.value} panel={<Inspector />}>
      <div
        ref={(element) => {
          if (element && scene.parentElement !== element) element.append(scene);
        }}
      />
      {doc.value.curves.length === 0 && (
        <Hint tool={tool} drawing="Draw one stroke all the way round: it closes when you let go." draw="Draw a curve">
          <button type="button" class="button" onClick={() => (openDialog.value = 'gallery')}>
            Open the gallery
          </button>
        </Hint>
      )}
      <ToolBar
        tool={tool}
        bin={{ label: 'Delete the chosen curve', disabled: selection.value === null, onClick: deleteSelected }}
        clear={{
          label: 'Clear all curves',
          disabled: doc.value.curves.length === 0,
          onClick: () => {
            dispatch({ type: 'clear' });
          },
        }}
      >
        <IconButton icon="circle" label="Add a circle" keys="A" onClick={addCircle} />
      </ToolBar>
      <PenBar stage={stage} />
      <Gizmo stage={stage} />
      <ViewBar
        play={{
          isOn: playing,
          label: playing ? 'Show the whole surface now' : 'Let the surface appear again',
          disabled: !playing && surface.value === null,
          onClick: () => {
            if (playing) stage.skipGrowth();
            else stage.replay();
          },
        }}
        frameAll={() => {
          stage.frameAll();
        }}
      >
        <IconButton
          icon="face"
          label="Face the drawing plane"
          keys="P"
          onClick={() => {
            stage.facePlane();
          }}
        />
      </ViewBar>
      <Busy />
    </Frame>
  );
}

/** The buttons of the bar at the top that are this mode's own. */
export function FilmNav({ stage }: { stage: Stage }) {
  return (
    <nav aria-label="Document">
      <IconButton icon="gallery" label="Gallery" text="Gallery" keys="G" onClick={() => (openDialog.value = 'gallery')} />
      <OpenButton of="loops" accept=".curve,.json,.obj,.txt" open={openFile} />
      <ExportMenu stage={stage} />
      <HistoryButtons of={history} />
    </nav>
  );
}

const isMenuOpen = signal(false);

function ExportMenu({ stage }: { stage: Stage }) {
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const onPress = (event: Event) => {
      if (!root.current?.contains(event.target as Node)) isMenuOpen.value = false;
    };
    window.addEventListener('pointerdown', onPress, { capture: true });
    return () => {
      window.removeEventListener('pointerdown', onPress, { capture: true });
    };
  }, []);
  const hasSurface = surface.value !== null && !isStale.value;
  const hasCurves = doc.value.curves.length > 0;
  const items: readonly { label: string; note: string; enabled: boolean; run: () => unknown }[] = [
    { label: 'Surface', note: 'OBJ', enabled: hasSurface, run: saveSurface },
    { label: 'Curves', note: '.curve', enabled: hasCurves, run: () => saveLoops('curve') },
    { label: 'Curves', note: 'JSON', enabled: hasCurves, run: () => saveLoops('json') },
    { label: 'Picture', note: 'PNG', enabled: true, run: () => stage.view.picture().then(savePicture) },
  ];
  return (
    <div
      class="menu-root"
      ref={root}
      onKeyDown={(event) => {
        if (event.key !== 'Escape' || !isMenuOpen.peek()) return;
        isMenuOpen.value = false;
        root.current?.querySelector('button')?.focus();
        event.stopPropagation();
      }}
    >
      <button
        type="button"
        class="icon-button with-text"
        aria-label="Export"
        title="Export"
        aria-expanded={isMenuOpen.value}
        onClick={() => (isMenuOpen.value = !isMenuOpen.peek())}
      >
        <Icon name="save" />
        <span class="button-text">Export</span>
      </button>
      {isMenuOpen.value && (
        <div class="menu">
          {items.map(({ label, note, enabled, run }) => (
            <button
              key={note}
              type="button"
              disabled={!enabled}
              onClick={() => {
                isMenuOpen.value = false;
                run();
              }}
            >
              <span>{label}</span>
              <span class="muted">{note}</span>
            </button>
          ))}
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

const kPlanes: readonly Choice<PlaneKind>[] = [
  { value: 'xy', label: 'XY' },
  { value: 'yz', label: 'YZ' },
  { value: 'zx', label: 'ZX' },
  { value: 'view', label: 'View', title: 'Facing you, through the point that the view turns about' },
];
const kDrag: readonly Choice<Drawing['dragIn']>[] = [
  { value: 'view', label: 'Screen', title: 'Vertices move in the plane of the screen' },
  { value: 'plane', label: 'Drawing plane', title: 'Vertices move along the drawing plane' },
];

/** The settings of the tool in hand. */
function PenBar({ stage }: { stage: Stage }) {
  // Folds on narrow screens only, where it would cover what is drawn.
  const [isFolded, setFolded] = useState(true);
  const { plane, offset, count, smoothing, dragIn } = drawing.value;
  const change = (next: Partial<Drawing>) => {
    drawing.value = { ...drawing.peek(), ...next };
  };
  const isDrawing = tool.value === 'draw';
  if (!isDrawing && selection.value === null) return null;
  const needsPlane = isDrawing || dragIn === 'plane';
  const { radius } = stage.view;
  return (
    <div class={isFolded ? 'pen-bar floating folded' : 'pen-bar floating'} role="group" aria-label={isDrawing ? 'Pen' : 'Dragging'}>
      {isDrawing && (
        <button
          type="button"
          class="icon-button pen-fold"
          aria-label="Pen settings"
          aria-expanded={!isFolded}
          onClick={() => {
            setFolded(!isFolded);
          }}
        >
          <Icon name="chevron" />
        </button>
      )}
      {!isDrawing && (
        <Segments label="Drag in" choices={kDrag} value={dragIn} onChange={(value) => { change({ dragIn: value }); }} />
      )}
      {needsPlane && (
        <Segments label="Plane" choices={kPlanes} value={plane} onChange={(value) => { change({ plane: value }); }} />
      )}
      {isDrawing && (
        <div class="stack">
          <NumberField
            label="Offset"
            title="Of the plane along its normal"
            value={offset}
            min={-Infinity}
            scale={linear(-2 * radius, 2 * radius)}
            onChange={(value) => { change({ offset: value }); }}
          />
          <PenFields pen={{ count, smoothing }} of="curve" onChange={change} />
        </div>
      )}
    </div>
  );
}

// The page's other mode: polygons with holes, drawn or opened, triangulated as they change.
import { useEffect, useRef, useState } from 'preact/hooks';
import { computed } from '@preact/signals';
import type { SoapfilmError } from 'soapfilm';
import { attachPolygonPointer } from '../scene/polygon_pointer.ts';
import { PolygonView } from '../scene/polygon_view.ts';
import { countOf } from '../state/files.ts';
import {
  flooding,
  history,
  loadError,
  polygonDoc,
  polygonTool,
  ringPen,
  selectedRing,
  startPolygons,
  triangulated,
  type PolygonSettings,
  type Triangulated,
} from '../state/polygon.ts';
import { kPolygonExamples, onFrame, openPolygonExample, openPolygonFile } from '../state/polygon_files.ts';
import { mode, shown, type Shown } from '../state/store.ts';
import { IconButton } from './bars.tsx';
import { linear, NumberField, Section, Segments, Switch, type Choice } from './controls.tsx';
import { Icon } from './icons.tsx';
import { attachPolygonKeys, deleteChosen, toggleFlooding } from './polygon_keys.ts';
import { Toast } from './toast.tsx';
import '../styles/polygon.css';

export { openPolygonFile };

let fileInput: HTMLInputElement | null = null;
const chooseFile = (): void => {
  fileInput?.click();
};

const summary = computed(() => {
  const found = triangulated.value;
  if (loadError.value !== null) return `soapfilm could not be loaded: ${loadError.value}`;
  if (found === null) return 'Loading…';
  if (polygonDoc.value.polygons.length === 0) return 'No polygons yet';
  if (found.errors.length > 0) return wordsFor(found.errors[0]);
  return `${countOf(found.triangles.length / 3, 'triangle')}, ${milliseconds(found.seconds)}`;
});

/** What is wrong with a polygon in the words of the page: polygons and rings count from 1. */
function wordsFor({ code, message, polygon = 0, loop = 0, vertex, otherLoop = 0 }: SoapfilmError): string {
  const of = polygonDoc.value.polygons.length > 1 ? `Polygon ${polygon + 1}: ` : '';
  const ring = (r: number): string => (r === 0 ? 'the outer ring' : `hole ${r}`);
  const words: Partial<Record<typeof code, string>> = {
    'self-intersecting': `${ring(loop)} crosses or overlaps itself.`,
    'holes-overlap': `${ring(loop)} and ${ring(otherLoop)} cross or overlap.`,
    'hole-outside': `${ring(loop)} is not inside the outer ring.`,
    'nested-hole': `${ring(loop)} lies inside ${ring(otherLoop)}.`,
    degenerate:
      vertex === undefined
        ? `${ring(loop)} has fewer than three distinct points.`
        : `${ring(loop)} has a spike.`,
    'not-finite': `a coordinate of ${ring(loop)} is larger than can be reckoned with.`,
  };
  const text = of + (words[code] ?? message);
  return text[0].toUpperCase() + text.slice(1);
}

const milliseconds = (seconds: number): string =>
  `${Number((1000 * seconds).toPrecision(2)).toLocaleString('en')} ms`;

export function PolygonMode() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [view, setView] = useState<PolygonView | null>(null);
  const [isOpen, setOpen] = useState(false);
  useEffect(() => {
    if (canvas.current === null) return;
    const made = new PolygonView(canvas.current);
    onFrame(() => {
      made.frameAll();
    });
    attachPolygonKeys(made, attachPolygonPointer(made), chooseFile);
    setView(made);
    if (polygonDoc.peek().polygons.length === 0) {
      openPolygonExample(kPolygonExamples[0]);
      history.forgetHistory();
    }
    void startPolygons();
    exposeForInspection(made);
  }, []);
  return (
    <>
      <div class="viewport">
        <div class="scene">
          <canvas
            ref={canvas}
            tabIndex={0}
            role="application"
            aria-label="Polygons. Arrows move the view or the chosen vertex; comma and full stop choose a vertex."
            data-tool={polygonTool.value}
          />
        </div>
        {polygonDoc.value.polygons.length === 0 && (
          <div class="hint">
            <p>Draw one stroke all the way round: it closes when you let go. A ring drawn inside another is a hole.</p>
          </div>
        )}
        <Tools />
        {view && <ViewBar view={view} />}
        {flooding.value && <Step />}
        {mode.value === 'polygon' && <Toast />}
      </div>
      <aside class={isOpen ? 'panel open' : 'panel'} aria-label="Polygons">
        <button
          type="button"
          class="panel-handle"
          aria-expanded={isOpen}
          aria-controls="polygon-panel-body"
          onClick={() => {
            setOpen(!isOpen);
          }}
        >
          <span>{summary.value}</span>
          <Icon name="chevron" />
        </button>
        <div class="panel-body" id="polygon-panel-body">
          <Result />
          <Triangulation />
          <Examples />
          <Show />
        </div>
      </aside>
      <p class="visually-hidden" role="status" aria-live="polite">
        {summary.value}
      </p>
    </>
  );
}

/** The buttons of the bar at the top that are this mode's own. */
export function PolygonNav() {
  const { undo, redo, canUndo, canRedo } = history;
  return (
    <nav aria-label="Document">
      <IconButton icon="open" label="Open a file" text="Open" keys="Ctrl O" onClick={chooseFile} />
      <input
        ref={(element) => {
          fileInput = element;
        }}
        type="file"
        hidden
        accept=".geojson,.json,.curve,.obj,.txt"
        aria-label="File of polygons"
        onChange={(event) => {
          const input = event.currentTarget;
          const file = input.files?.[0];
          if (file) void openPolygonFile(file).finally(() => (input.value = ''));
        }}
      />
      <span class="rule" aria-hidden="true" />
      <IconButton icon="undo" label="Undo" keys="Ctrl Z" disabled={!canUndo.value} onClick={undo} />
      <IconButton icon="redo" label="Redo" keys="Ctrl Shift Z" disabled={!canRedo.value} onClick={redo} />
    </nav>
  );
}

function Tools() {
  return (
    <div class="tool-bar floating" role="toolbar" aria-label="Tools" aria-orientation="vertical">
      <IconButton icon="select" label="Select" keys="V" pressed={polygonTool.value === 'select'} onClick={() => (polygonTool.value = 'select')} />
      <IconButton icon="draw" label="Draw" keys="D" pressed={polygonTool.value === 'draw'} onClick={() => (polygonTool.value = 'draw')} />
      <span class="rule" aria-hidden="true" />
      <IconButton icon="trash" label="Delete what is chosen" keys="Del" disabled={selectedRing.value === null} onClick={deleteChosen} />
      <IconButton
        icon="clear"
        label="Clear all polygons"
        disabled={polygonDoc.value.polygons.length === 0}
        onClick={() => {
          history.dispatch({ type: 'clear' });
        }}
      />
    </div>
  );
}

function ViewBar({ view }: { view: PolygonView }) {
  return (
    <div class="view-bar floating" role="toolbar" aria-label="View">
      <IconButton
        icon={flooding.value ? 'skip' : 'play'}
        label={flooding.value ? 'Stop flooding' : 'Flood step by step'}
        keys="Space"
        disabled={polygonDoc.value.polygons.length === 0}
        onClick={toggleFlooding}
      />
      <IconButton
        icon="fit"
        label="All in view"
        keys="F"
        onClick={() => {
          view.frameAll();
        }}
      />
    </div>
  );
}

const kActions = {
  start: 'Start at a bottom',
  raise: 'Raise the water',
  fill: 'Fill the gorge',
  bridge: 'Bridge to a sag',
  spill: 'Spill over a top',
  jump: 'Jump to the other bank',
};

function Step() {
  const now = flooding.value;
  if (now === null) return null;
  const { action, triangles } = now.steps[now.taken];
  return (
    <div class="flood-step floating" aria-hidden="true">
      <strong>{kActions[action]}</strong>
      <span class="muted">{countOf(triangles, 'triangle')}</span>
    </div>
  );
}

function Result() {
  const found = triangulated.value;
  return (
    <Section title="Result">
      {loadError.value !== null && <p class="message error">{loadError.value}</p>}
      {found?.errors.slice(0, 3).map((error) => (
        <div class="message error" key={error.polygon}>
          <p>{wordsFor(error)}</p>
          <p class="muted">
            The place is marked in red. {polygonDoc.value.settings.repair === 'none' && 'Repair would make the best of it.'}
          </p>
        </div>
      ))}
      {found && polygonDoc.value.polygons.length > 0 && <Figures found={found} />}
    </Section>
  );
}

function Figures({ found }: { found: Triangulated }) {
  const count = found.triangles.length / 3;
  const strips = found.stripStarts.length - 1;
  const rows: readonly (readonly [string, string])[] = [
    ['Vertices', String(found.positions.length / 2 - found.added)],
    ['Triangles', String(count)],
    ...(found.added > 0 ? [['Added', String(found.added)] as const] : []),
    ...(strips > 0 ? [['Strips', String(strips)] as const, ['Index ratio', (found.strips.length / count).toFixed(2)] as const] : []),
    ['Time', milliseconds(found.seconds)],
  ];
  return (
    <div class="figures">
      <dl>
        {rows.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}

const kMethods: readonly Choice<PolygonSettings['method']>[] = [
  { value: 'flooding', label: 'Flooding', title: 'As water rises between the banks (Ronfard, Rossignac)' },
  { value: 'trapezoids', label: 'Trapezoids', title: 'By horizontal lines of sight, for better angles (Kumar)' },
];
const kOutputs: readonly Choice<PolygonSettings['output']>[] = [
  { value: 'triangles', label: 'Triangles' },
  { value: 'strips', label: 'Strips', title: 'Each strip in a colour of its own' },
];
const kQualities: readonly Choice<PolygonSettings['quality']>[] = [
  { value: 'fast', label: 'Fast' },
  { value: 'delaunay', label: 'Delaunay', title: 'Edges are flipped until no circle holds a vertex that is seen' },
];
const kRepairs: readonly Choice<PolygonSettings['repair']>[] = [
  { value: 'none', label: 'Off', title: 'What is wrong with a polygon is shown' },
  { value: 'even-odd', label: 'Even-odd', title: 'Inside is where rings wind an odd number of times' },
  { value: 'nonzero', label: 'Nonzero', title: 'Inside is where rings wind at all' },
];

function Triangulation() {
  const { settings } = polygonDoc.value;
  const set = (change: Partial<PolygonSettings>): void => {
    history.dispatch({ type: 'set', settings: change });
  };
  const { count, smoothing } = ringPen.value;
  return (
    <Section title="Triangulation">
      <Segments label="Method" choices={kMethods} value={settings.method} onChange={(method) => { set({ method }); }} />
      <Segments label="Output" choices={kOutputs} value={settings.output} onChange={(output) => { set({ output }); }} />
      <Segments label="Quality" choices={kQualities} value={settings.quality} onChange={(quality) => { set({ quality }); }} />
      <Segments label="Repair" choices={kRepairs} value={settings.repair} onChange={(repair) => { set({ repair }); }} />
      {polygonTool.value === 'draw' && (
        <div class="stack">
          <NumberField
            label="Vertices"
            title="Of a drawn ring"
            value={count}
            min={3}
            max={500}
            whole
            scale={linear(6, 100)}
            onChange={(value) => (ringPen.value = { ...ringPen.peek(), count: value })}
          />
          <NumberField
            label="Smoothing"
            value={smoothing}
            min={0}
            max={1}
            scale={linear(0, 1)}
            onChange={(value) => (ringPen.value = { ...ringPen.peek(), smoothing: value })}
          />
        </div>
      )}
    </Section>
  );
}

function Examples() {
  return (
    <Section title="Examples">
      <div class="polygon-examples">
        {kPolygonExamples.map((example) => (
          <button
            key={example.title}
            type="button"
            class="button"
            onClick={() => {
              openPolygonExample(example);
            }}
          >
            {example.title}
          </button>
        ))}
      </div>
    </Section>
  );
}

const kShown: readonly { key: keyof Shown; label: string }[] = [
  { key: 'surface', label: 'Triangles' },
  { key: 'wires', label: 'Edges' },
  { key: 'vertices', label: 'Vertices' },
];

function Show() {
  return (
    <Section title="Show">
      <div class="switches">
        {kShown.map(({ key, label }) => (
          <Switch
            key={key}
            label={label}
            checked={shown.value[key]}
            onChange={(checked) => (shown.value = { ...shown.peek(), [key]: checked })}
          />
        ))}
      </div>
    </Section>
  );
}

function exposeForInspection(view: PolygonView): void {
  window.__polygons = {
    get document() {
      return polygonDoc.peek();
    },
    get triangulated() {
      return triangulated.peek();
    },
    get flooding() {
      return flooding.peek();
    },
    get selection() {
      return selectedRing.peek();
    },
    whereIs(point) {
      const [x, y] = view.toScreen(point);
      const box = view.canvas.getBoundingClientRect();
      return { x: box.left + x, y: box.top + y };
    },
  };
}

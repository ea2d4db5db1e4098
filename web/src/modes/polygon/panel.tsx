// The page's other mode: polygons with holes, drawn or opened, triangulated as they change.
import { useEffect, useRef, useState } from 'preact/hooks';
import { computed } from '@preact/signals';
import type { SoapfilmError } from 'soapfilm';
import { inWindow, valuesOf } from '../inspection.ts';
import { attachPolygonPointer } from '../scene/polygon_pointer.ts';
import { PolygonView } from '../scene/polygon_view.ts';
import type { Point2 } from '../shapes/plane.ts';
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
import { HistoryButtons, OpenButton, PenFields, ToolBar, ViewBar } from './bars.tsx';
import { Section, Segments, type Choice } from './controls.tsx';
import { Frame, Hint, Show } from './frame.tsx';
import { attachPolygonKeys, deleteChosen, toggleFlooding } from './polygon_keys.ts';
import { Row } from './result.tsx';
import '../styles/polygon.css';

export { openPolygonFile, polygonDoc };

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
  const isEmpty = polygonDoc.value.polygons.length === 0;
  useEffect(() => {
    if (canvas.current === null) return;
    const made = new PolygonView(canvas.current);
    onFrame(() => {
      made.frameAll();
    });
    attachPolygonKeys(made, attachPolygonPointer(made));
    setView(made);
    if (polygonDoc.peek().polygons.length === 0) {
      openPolygonExample(kPolygonExamples[0]);
      history.forgetHistory();
    }
    void startPolygons();
    exposeForInspection(made);
  }, []);
  return (
    <Frame
      of="polygon"
      label="Polygons"
      summary={summary.value}
      panel={
        <>
          <Result />
          <Triangulation />
          {polygonTool.value === 'draw' && (
            <Section title="Pen">
              <div class="stack">
                <PenFields pen={ringPen.value} of="ring" onChange={(change) => (ringPen.value = { ...ringPen.peek(), ...change })} />
              </div>
            </Section>
          )}
          <Examples />
          <Show labels={{ surface: 'Triangles', wires: 'Edges', vertices: 'Vertices' }} />
        </>
      }
    >
      <div class="scene">
        <canvas
          ref={canvas}
          tabIndex={0}
          role="application"
          aria-label="Polygons. Arrows move the view or the chosen vertex; comma and full stop choose a vertex."
          data-tool={polygonTool.value}
        />
      </div>
      {isEmpty && (
        <Hint
          tool={polygonTool}
          drawing="Draw one stroke all the way round: it closes when you let go. A ring drawn inside another is a hole."
          draw="Draw a polygon"
        />
      )}
      <ToolBar
        tool={polygonTool}
        bin={{ label: 'Delete what is chosen', disabled: selectedRing.value === null, onClick: deleteChosen }}
        clear={{
          label: 'Clear all polygons',
          disabled: isEmpty,
          onClick: () => {
            history.dispatch({ type: 'clear' });
          },
        }}
      />
      {view && (
        <ViewBar
          play={{
            isOn: flooding.value !== null,
            label: flooding.value ? 'Stop flooding' : 'Flood step by step',
            disabled: isEmpty,
            onClick: toggleFlooding,
          }}
          frameAll={() => {
            view.frameAll();
          }}
        />
      )}
      <Step />
    </Frame>
  );
}

/** The buttons of the bar at the top that are this mode's own. */
export function PolygonNav() {
  return (
    <nav aria-label="Document">
      <OpenButton of="polygons" accept=".geojson,.json,.curve,.obj,.txt" open={openPolygonFile} />
      <HistoryButtons of={history} />
    </nav>
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
            The place is marked in red. {polygonDoc.value.settings.repair === 'none' && 'With Repair on, it is triangulated all the same.'}
          </p>
        </div>
      ))}
      {polygonDoc.value.polygons.length === 0 ? (
        <p class="muted">No polygons yet. Draw one, open a file, or take an example.</p>
      ) : (
        found && <Figures found={found} />
      )}
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
          <Row key={name} name={name} value={value} />
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
  return (
    <Section title="Triangulation">
      <Segments label="Method" choices={kMethods} value={settings.method} onChange={(method) => { set({ method }); }} />
      <Segments label="Output" choices={kOutputs} value={settings.output} onChange={(output) => { set({ output }); }} />
      <Segments label="Quality" choices={kQualities} value={settings.quality} onChange={(quality) => { set({ quality }); }} />
      <Segments label="Repair" choices={kRepairs} value={settings.repair} onChange={(repair) => { set({ repair }); }} />
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

function exposeForInspection(view: PolygonView): void {
  window.__polygons = Object.assign(valuesOf({ document: polygonDoc, triangulated, flooding, selection: selectedRing }), {
    whereIs: (point: Point2) => inWindow(view.canvas, ...view.toScreen(point)),
  });
}

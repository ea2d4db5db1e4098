// The panel of the mode: what triangulating came to, how it is done, the pen, examples.
import { computed } from '@preact/signals';
import { PenFields } from '../../app/pen_fields.tsx';
import { Section, Segments, type Choice } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { Examples, Flags, Row, Show, Trouble } from '../../app/panel_parts.tsx';
import { setIn, shown, tool } from '../../state/store.ts';
import { openExample } from './actions.ts';
import { kExamples } from './examples.ts';
import { flooding } from './flooding.ts';
import { ringPen } from './pen.ts';
import { polygonGroup, type PolygonSettings } from './polygons.ts';
import { failures, triangulated, work } from './triangulating.ts';
import type { Triangulation } from './triangulation.ts';
import './polygon.css';

/** More faults than this are only marked. */
const kMostFaults = 3;

const isEmpty = computed(() => polygonGroup.value.items.length === 0);
const settings = computed(() => polygonGroup.value.settings);

export const summary = computed(() => {
  if (isEmpty.value) return 'No polygons yet';
  const state = work.state.value;
  if (state.phase === 'failed') return state.message;
  if (state.phase === 'cancelled') return 'Cancelled';
  const found = triangulated.value;
  if (found === null) return 'Loading…';
  if (failures.value.length > 0) return failures.value[0].message;
  return `${countOf(found.triangles.length / 3, 'triangle')}, ${milliseconds(found.seconds)}`;
});

const milliseconds = (seconds: number): string =>
  `${Number((1000 * seconds).toPrecision(2)).toLocaleString('en')} ms`;

export function Panel() {
  return (
    <>
      <Result />
      <Triangulating />
      {tool.value === 'draw' && (
        <Section title="Pen">
          <div class="stack">
            <PenFields pen={ringPen.value} of="ring" onChange={(change) => (ringPen.value = { ...ringPen.peek(), ...change })} />
          </div>
        </Section>
      )}
      <Examples of={kExamples} open={openExample} />
      <Show>
        <Flags of={shown} labels={{ surface: 'Triangles', wires: 'Edges', vertices: 'Vertices' }} />
      </Show>
    </>
  );
}

function Result() {
  const found = triangulated.value;
  return (
    <Section title="Result">
      <Trouble work={work} />
      {failures.value.slice(0, kMostFaults).map(({ message }, i) => (
        <div class="message error" key={i}>
          <p>{message}</p>
          <p class="muted">
            The place is marked in red. {settings.value.repair === 'none' && 'With Repair on, it is triangulated all the same.'}
          </p>
        </div>
      ))}
      {isEmpty.value ? (
        <p class="muted">No polygons yet. Draw one, open a file, or take an example.</p>
      ) : (
        found && <Figures found={found} />
      )}
    </Section>
  );
}

function Figures({ found }: { found: Triangulation }) {
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

function Triangulating() {
  const { method, output, quality, repair } = settings.value;
  return (
    <Section title="Triangulation">
      <Segments label="Method" choices={kMethods} value={method} onChange={(value) => { set({ method: value }); }} />
      <Segments label="Output" choices={kOutputs} value={output} onChange={(value) => { set({ output: value }); }} />
      <Segments label="Quality" choices={kQualities} value={quality} onChange={(value) => { set({ quality: value }); }} />
      <Segments label="Repair" choices={kRepairs} value={repair} onChange={(value) => { set({ repair: value }); }} />
    </Section>
  );
}

const set = (change: Partial<PolygonSettings>): void => { setIn(polygonGroup.peek(), change); };

const kSteps = {
  start: 'Start at a bottom',
  raise: 'Raise the water',
  fill: 'Fill the gorge',
  bridge: 'Bridge to a sag',
  spill: 'Spill over a top',
  jump: 'Jump to the other bank',
};

/** The step of the flood that is shown, over the scene. */
export function Step() {
  const now = flooding.value;
  if (now === null) return null;
  const { action, triangles } = now.flood.steps[now.taken];
  return (
    <div class="flood-step floating" aria-hidden="true">
      <strong>{kSteps[action]}</strong>
      <span class="muted">{countOf(triangles, 'triangle')}</span>
    </div>
  );
}

// The panel of the mode: how things stand, how fine the mesh is, what is shown, examples.
import { computed } from '@preact/signals';
import { decades, linear, NumberField, Section, Segments, Switch, type Choice } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { Examples, Flags, Row, Show, Trouble } from '../../app/panel_parts.tsx';
import { setIn, shown } from '../../state/store.ts';
import { openExample } from './actions.ts';
import { uploaded } from './drawing.ts';
import { kExamples } from './examples.ts';
import { coloring, kBandColor, kCellColor, kDeviationRamp, view, type Coloring } from './looks.ts';
import { frozen, meshed, meshing, model, settings } from './meshing.ts';
import './surface.css';
import { kMaxAngle, kMaxAspect, kMaxPixels, kMaxRelative, kMinRelative, surfaceGroup, type SurfaceSettings } from './settings.ts';

/** Without the room that faces have to grow. */
const triangles = computed(() => {
  const all = meshed.value?.change.mesh.triangles;
  if (!all) return 0;
  let count = 0;
  for (let i = 0; i < all.length; i += 3) if (all[i] !== all[i + 1]) count++;
  return count;
});

export const summary = computed(() => {
  if (model.value === null) return 'No model yet';
  const { state } = meshing;
  if (state.value.phase === 'failed') return state.value.message;
  if (meshed.value === null) return state.value.phase === 'cancelled' ? 'Cancelled' : 'Meshing…';
  const faces = meshed.value.change.mesh.faceStarts.length - 1;
  return `${countOf(faces, 'face')}, ${countOf(triangles.value, 'triangle')}`;
});

const set = (next: Partial<SurfaceSettings>, gesture?: string, passing = false): void => {
  setIn(surfaceGroup.peek(), next, gesture, passing);
};

export function SurfacePanel() {
  return (
    <>
      <Result />
      <Fineness />
      <Section title="Colours">
        <Segments label="Colours" hideLabel choices={kColorings} value={coloring.value} onChange={(value) => (coloring.value = value)} />
        <Key />
      </Section>
      <Show>
        <Flags of={view} labels={{ edges: 'Outlines', smooth: 'Smooth', ...(settings.value.follows && { second: 'Second view' }) }} />
        <Flags of={shown} labels={{ wires: 'Triangles', vertices: 'Poles', grid: 'Grid' }} />
      </Show>
      <Examples of={kExamples} open={openExample} />
    </>
  );
}

const kColorings: readonly Choice<Coloring>[] = [
  { value: 'plain', label: 'Plain', title: 'Both sides in the colours of films' },
  { value: 'faces', label: 'Faces', title: 'Each face in a colour of its own' },
  { value: 'strips', label: 'Strips', title: 'Each triangle strip in a colour of its own: long ones are of the grid, short ones of the band along trimming curves' },
  { value: 'cells', label: 'Cells', title: 'Cells of the grid, and the band between them and the trimming curves' },
  { value: 'deviation', label: 'Error', title: 'How far each triangle is off its surface' },
  { value: 'checks', label: 'UV', title: 'The surfaces’ parameters, as squares' },
];

/** What colours say. */
function Key() {
  const largest = meshed.value?.change.mesh.deviation ?? 0;
  if (coloring.value === 'cells') {
    return (
      <p class="surface-key">
        <i style={{ background: kCellColor }} /> Grid <i style={{ background: kBandColor }} /> Band
      </p>
    );
  }
  if (coloring.value !== 'deviation') return null;
  return (
    <p class="surface-key">
      0 <i class="ramp" style={{ background: `linear-gradient(to right, ${kDeviationRamp.join(', ')})` }} /> {short(largest)}
    </p>
  );
}

const short = (value: number): string => (value === 0 ? '0' : value.toPrecision(2));

function Result() {
  const now = meshed.value;
  const mesh = now?.change.mesh;
  return (
    <Section title="Result">
      <p class="surface-summary">{summary.value}</p>
      <Trouble work={meshing} />
      {now && mesh && (
        <div class="figures">
          <dl>
            <Row name="Off by" value={short(mesh.deviation)} />
            <Row name="Took" value={`${now.took.toFixed(0)} ms`} />
            <Row name="Changed" value={countOf(now.change.faces.length, 'face')} />
            <Row name="Sent" value={`${Math.ceil(uploaded.value / 1024).toLocaleString('en')} KB`} />
          </dl>
        </div>
      )}
      {mesh?.reports.slice(0, 6).map((report, i) => (
        <p class="muted" key={i}>
          {wordsFor(report)}
        </p>
      ))}
      {mesh && mesh.reports.length > 6 && <p class="muted">And {mesh.reports.length - 6} more.</p>}
      {model.value === null && <p class="muted">Drop a model on the page, open a file, or take an example.</p>}
    </Section>
  );
}

type Report = NonNullable<typeof meshed.value>['change']['mesh']['reports'][number];

function wordsFor(report: Report): string {
  switch (report.report) {
    case 'left-out':
      return `Left out. ${report.message}.`;
    case 'crossing-samples':
      return `Trimming curves came so near to each other that ${countOf(report.count, 'interval')} of them had to be halved.`;
    case 'tolerance-raised':
      return `The tolerance was raised to ${short(report.tolerance)}.`;
    case 'above-tolerance':
      return `Face ${report.face} is off by ${short(report.deviation)}.`;
    case 'time-over':
      return 'The time was over: the mesh is coarser than asked for.';
  }
}

const kRelative = decades(kMinRelative, kMaxRelative);
const kAngle = linear(1, kMaxAngle);
const kAspect = linear(0, kMaxAspect);
const kPixels = decades(0.1, kMaxPixels);

function Fineness() {
  const { relative, angle, aspect, follows, pixels, skips } = settings.value;
  return (
    <Section title="Fineness">
      <Switch
        label="Follow the camera"
        title="The mesh is as fine as the picture needs it, and coarse where it is not seen"
        checked={follows}
        onChange={(checked) => {
          frozen.value = false;
          set({ follows: checked });
        }}
      />
      {follows ? (
        <>
          <NumberField label="Pixels" title="Most distance of mesh and surface on the screen" value={pixels} min={0.1} max={kMaxPixels} scale={kPixels} onChange={(value, passing) => { set({ pixels: value }, 'pixels', passing); }} />
          <Switch label="Freeze" title="The mesh stays as it is, and can be looked at from elsewhere" checked={frozen.value} onChange={(checked) => (frozen.value = checked)} />
        </>
      ) : (
        <>
          <NumberField label="Tolerance" title="Most distance of mesh and surface, as a share of the model’s size" value={relative} min={kMinRelative} max={kMaxRelative} scale={kRelative} onChange={(value, passing) => { set({ relative: value }, 'tolerance', passing); }} />
          <NumberField label="Angle" title="Most turn along an edge, in degrees" value={angle} min={1} max={kMaxAngle} scale={kAngle} onChange={(value, passing) => { set({ angle: value }, 'angle', passing); }} />
        </>
      )}
      <NumberField label="Aspect" title="How long cells may be for their width; 0: any length, which gives fewest triangles" value={aspect} min={0} max={kMaxAspect} scale={kAspect} onChange={(value, passing) => { set({ aspect: value < 0.5 ? 0 : Math.max(1, value) }, 'aspect', passing); }} />
      <Switch label="Leave faulty faces out" title="Else a fault in one face is an error of the model" checked={skips} onChange={(checked) => { set({ skips: checked }); }} />
    </Section>
  );
}

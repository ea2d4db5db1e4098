// The panel of the mode: how things stand, the list of holes, how they are filled, what is shown, examples.
import { computed } from '@preact/signals';
import { linear, NumberField, Section, Segments, Switch, type Choice } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { Examples, Flags, Show, Trouble } from '../../app/panel_parts.tsx';
import { shown } from '../../state/store.ts';
import { openExample } from './actions.ts';
import { colorsOf } from './attributes.ts';
import { kExamples } from './examples.ts';
import { filling, isSettled, patches } from './filling.ts';
import { Holes } from './hole_list.tsx';
import { finding, found, holes, set, settings, twins, weldAll, whole } from './holes.ts';
import { view } from './looks.ts';
import { kMaxCrease, kMaxDensity, kMinCrease, type MeshSettings } from './settings.ts';
import { isFilled, wordsForDefect } from './wording.ts';
import './mesh.css';

const hasColors = computed(() => whole.value !== null && colorsOf(whole.value) !== null);
const filledCount = computed(() => patches.value.filter(isFilled).length);
const triangles = computed(() => patches.value.reduce((sum, { faces }) => sum + faces.length / 3, 0));

export const summary = computed(() => {
  if (whole.value === null) return 'No mesh yet';
  for (const { state } of [finding, filling]) if (state.value.phase === 'failed') return state.value.message;
  if (found.value === null) return finding.state.value.phase === 'cancelled' ? 'Cancelled' : 'Looking for holes…';
  const all = holes.value.length;
  if (all === 0) return 'No holes: the mesh is closed';
  const words = `${filledCount.value.toLocaleString('en')} of ${countOf(all, 'hole')} filled`;
  return triangles.value > 0 ? `${words}, ${countOf(triangles.value, 'triangle')}` : words;
});

export function MeshPanel() {
  return (
    <>
      <Result />
      <Holes />
      <Filling />
      <Show>
        <Flags of={view} labels={{ rims: 'Rims', zebra: 'Zebra stripes', smooth: 'Smooth shading', ...(hasColors.value && { colored: 'Colours' }) }} />
        <Flags of={shown} labels={{ wires: 'Edges', grid: 'Grid' }} />
      </Show>
      <Examples of={kExamples} open={openExample} />
    </>
  );
}

function Result() {
  const report = found.value?.report;
  return (
    <Section title="Result">
      <p class="mesh-summary">{summary.value}</p>
      <Trouble work={finding} />
      {!isSettled.value && <Trouble work={filling} again="Go on" />}
      {whole.value !== null && (
        <p class="muted">
          {countOf(whole.value.positions.length / 3, 'vertex', 'vertices')}, {countOf(whole.value.faces.length / 3, 'face')}
        </p>
      )}
      {report?.defects.map((defect) => (
        <p class="muted" key={defect.kind}>
          {wordsForDefect(defect)}
        </p>
      ))}
      {twins.value > 0 && (
        <div class="message">
          <p class="muted">{countOf(twins.value, 'vertex', 'vertices')} on rims {twins.value === 1 ? 'lies' : 'lie'} where another does: such rims are seams, not holes.</p>
          <button type="button" class="button small" title="Vertices at the same place become one" onClick={weldAll}>
            Weld the seams
          </button>
        </div>
      )}
      {whole.value === null && <p class="muted">Drop a mesh on the page, open a file, or take an example.</p>}
    </Section>
  );
}

const kSmoothness: readonly Choice<MeshSettings['smoothness']>[] = [
  { value: 'none', label: 'None', title: 'As it is spanned' },
  { value: 'direction', label: 'Direction', title: 'The patch goes on in the direction of what is around it' },
  { value: 'curvature', label: 'Curvature', title: 'It goes on in curvature too' },
  { value: 'auto', label: 'Auto', title: 'Curvature, but direction where the surroundings are rough' },
];
const kCandidates: readonly Choice<MeshSettings['candidates']>[] = [
  { value: 'auto', label: 'Auto', title: 'All triangles for small rims, else Delaunay' },
  { value: 'delaunay', label: 'Delaunay', title: 'The facets of the Delaunay tetrahedralization of the rims' },
  { value: 'near', label: 'Near', title: 'Delaunay facets, and triangles of surfaces near the best one' },
  { value: 'all', label: 'All', title: 'Every triple of the rims’ vertices: for small holes' },
];
const kDensity = linear(0, kMaxDensity);
const kCreaseAngle = linear(kMinCrease, kMaxCrease);

function Filling() {
  const { smoothness, density, candidates, creases, creaseAngle } = settings.value;
  return (
    <Section title="Filling">
      <Segments label="Smoothness" choices={kSmoothness} value={smoothness} onChange={(value) => { set({ smoothness: value }); }} />
      <NumberField
        label="Density"
        title="How much denser than its surroundings a patch is; 0: no new vertices"
        value={density}
        min={0}
        max={kMaxDensity}
        scale={kDensity}
        onChange={(value, passing) => { set({ density: value }, 'density', passing); }}
      />
      <Switch
        label="Creases go on"
        title="Sharp edges that end at a rim go on through the hole, where their ends fit"
        checked={creases}
        onChange={(checked) => { set({ creases: checked }); }}
      />
      {creases && (
        <NumberField
          label="From angle"
          title="Between faces, in degrees: edges that are sharper are creases"
          value={creaseAngle}
          min={kMinCrease}
          max={kMaxCrease}
          scale={kCreaseAngle}
          onChange={(value, passing) => { set({ creaseAngle: value }, 'crease angle', passing); }}
        />
      )}
      <Segments label="Triangles from" choices={kCandidates} value={candidates} onChange={(value) => { set({ candidates: value }); }} />
    </Section>
  );
}

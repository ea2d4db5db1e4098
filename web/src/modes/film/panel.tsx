// The panel: what the span should be, what it came to, what is shown.
import { useState } from 'preact/hooks';
import type { CandidateSpace } from 'soapfilm';
import { kPresets, presetOf, type RelativeWeights, type Settings } from '../state/document.ts';
import { countOf } from '../state/files.ts';
import { auto, setLive, solve, startSpan } from '../state/solving.ts';
import { dispatch, doc, endGesture, selection } from '../state/store.ts';
import { decades, NumberField, Section, Segments, Switch, type Choice } from './controls.tsx';
import { Show } from './frame.tsx';
import { Icon } from './icons.tsx';
import { Result } from './result.tsx';

export function Inspector() {
  return (
    <>
      <Result />
      <Film />
      <Curves />
      <Show labels={{ surface: 'Surface', wires: 'Edges', vertices: 'Vertices', grid: 'Grid' }} />
    </>
  );
}

const change = (settings: Partial<Settings>) => {
  dispatch({ type: 'set', settings });
};

const kSpaces: readonly Choice<CandidateSpace>[] = [
  { value: 'auto', label: 'Auto', title: 'All triangles while that is quick, else Delaunay, then wider spaces' },
  { value: 'delaunay', label: 'Delaunay', title: 'The facets of the Delaunay tetrahedralization: fast, never crosses itself' },
  { value: 'near', label: 'Near', title: 'Delaunay facets, and triangles of surfaces near the best one' },
  { value: 'all', label: 'All', title: 'Every triple of vertices: the true optimum, for small curves' },
];

const kObjectives: readonly Choice<Settings['objective']>[] = [
  { value: 'sum', label: 'Sum', title: 'The least weighted sum' },
  { value: 'worst-dihedral', label: 'Worst angle', title: 'The least largest angle between neighbours; ties by the sum' },
];

const kWeights: readonly { key: keyof RelativeWeights; label: string; title: string }[] = [
  { key: 'area', label: 'Area', title: 'Cost of the area, in units of the squared size of all curves' },
  { key: 'perimeter', label: 'Perimeter', title: 'Cost of the triangles’ perimeters, in units of the size of all curves' },
  { key: 'dihedral', label: 'Bending', title: 'Cost of the angle between neighbours, a radian (dihedral)' },
];
const kWeightScale = decades(0.001, 1000);

function Film() {
  const { settings } = doc.value;
  const preset = presetOf(settings.weights);
  const setWeight = (key: keyof RelativeWeights, value: number, passing: boolean) => {
    const weights = { ...settings.weights, [key]: value };
    // A span needs something to minimise.
    if (weights.area + weights.perimeter + weights.dihedral === 0) return;
    setLive(passing);
    dispatch({ type: 'set', settings: { weights } }, `weight ${key}`);
    if (!passing) {
      endGesture();
      setLive(false);
    }
  };
  return (
    <Section
      title="Film"
      aside={
        <Switch
          label="Auto"
          title="Span again whenever something changes"
          checked={auto.value}
          onChange={(checked) => (auto.value = checked)}
        />
      }
    >
      <Segments
        label="Preset"
        hideLabel
        choices={kPresets.map(({ id, label, title }) => ({ value: id, label, title }))}
        value={preset?.id ?? null}
        onChange={(id) => {
          const chosen = kPresets.find((p) => p.id === id);
          if (chosen) change({ weights: chosen.weights });
        }}
      />
      <div class="stack">
        {kWeights.map(({ key, label, title }) => (
          <NumberField
            key={key}
            label={label}
            title={title}
            value={settings.weights[key]}
            min={0}
            scale={kWeightScale}
            onChange={(value, passing) => {
              setWeight(key, value, passing);
            }}
          />
        ))}
      </div>
      <Segments
        label="Minimise"
        choices={kObjectives}
        value={settings.objective}
        onChange={(objective) => {
          change({ objective });
        }}
      />
      <Segments
        label="Triangles from"
        choices={kSpaces}
        value={settings.candidates}
        onChange={(candidates) => {
          change({ candidates });
        }}
      />
      {!auto.value && (
        <button
          type="button"
          class="button primary wide"
          disabled={doc.value.curves.length === 0 || solve.value.phase === 'running'}
          onClick={startSpan}
        >
          Span the curves
        </button>
      )}
    </Section>
  );
}

const kManyCurves = 12;

function Curves() {
  const { curves } = doc.value;
  const [all, setAll] = useState(false);
  if (curves.length === 0) return null;
  const listed = all ? curves : curves.slice(0, kManyCurves);
  return (
    <Section title="Curves" aside={<span class="count">{curves.length}</span>}>
      <ul class="curves">
        {listed.map((curve, c) => (
          <li key={c} class={selection.value?.curve === c ? 'chosen' : ''}>
            <button
              type="button"
              class="curve"
              aria-pressed={selection.value?.curve === c}
              onClick={() => (selection.value = selection.peek()?.curve === c ? null : { curve: c, vertex: null })}
            >
              <span>Curve {c + 1}</span>
              <span class="count">{countOf(curve.length, 'vertex', 'vertices')}</span>
            </button>
            <button
              type="button"
              class="icon-button small"
              aria-label={`Delete curve ${c + 1}`}
              title="Delete"
              onClick={() => {
                dispatch({ type: 'delete-curve', curve: c });
              }}
            >
              <Icon name="trash" />
            </button>
          </li>
        ))}
      </ul>
      {curves.length > listed.length && (
        <button
          type="button"
          class="button wide"
          onClick={() => {
            setAll(true);
          }}
        >
          Show all {curves.length}
        </button>
      )}
    </Section>
  );
}

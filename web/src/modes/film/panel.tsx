// The panel: what the span should be, what it came to, what is shown.
import { useState } from 'preact/hooks';
import type { CandidateSpace } from 'soapfilm';
import { decades, NumberField, Section, Segments, Switch, type Choice } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { Icon } from '../../app/icons.tsx';
import { Flags, Show } from '../../app/panel_parts.tsx';
import { pointCount } from '../../shapes/lines.ts';
import { choose, chosen, dispatch, endGesture, shown } from '../../state/store.ts';
import { film, setFilm } from './film.ts';
import { Result } from './result.tsx';
import { curvesOf, kPresets, presetOf, type FilmSettings, type RelativeWeights } from './settings.ts';
import { auto, spanning } from './spanning.ts';

export function FilmPanel() {
  return (
    <>
      <Result />
      <Film />
      <Curves />
      <Show>
        <Flags of={shown} labels={{ surface: 'Surface', wires: 'Edges', vertices: 'Vertices', grid: 'Grid' }} />
      </Show>
    </>
  );
}

const kSpaces: readonly Choice<CandidateSpace>[] = [
  { value: 'auto', label: 'Auto', title: 'All triangles while that is quick, else Delaunay, then wider spaces' },
  { value: 'delaunay', label: 'Delaunay', title: 'The facets of the Delaunay tetrahedralization: fast, never crosses itself' },
  { value: 'near', label: 'Near', title: 'Delaunay facets, and triangles of surfaces near the best one' },
  { value: 'all', label: 'All', title: 'Every triple of vertices: the true optimum, for small curves' },
];

const kObjectives: readonly Choice<FilmSettings['objective']>[] = [
  { value: 'sum', label: 'Sum', title: 'The least weighted sum' },
  { value: 'worst-dihedral', label: 'Worst angle', title: 'The least largest angle between neighbours; ties by the sum' },
];

const kSmooths: readonly Choice<FilmSettings['smooth']>[] = [
  { value: 'none', label: 'As is', title: 'The triangles as they were spanned' },
  { value: 'soap-film', label: 'Film', title: 'The surface of least area between the curves, as a soap film is' },
  { value: 'thin-plate', label: 'Plate', title: 'The surface that bends least' },
  { value: 'curvature', label: 'Fair', title: 'The surface whose curvature varies least' },
];

const kWeights: readonly { key: keyof RelativeWeights; label: string; title: string }[] = [
  { key: 'area', label: 'Area', title: 'Cost of the area, in units of the squared size of all curves' },
  { key: 'perimeter', label: 'Perimeter', title: 'Cost of the triangles’ perimeters, in units of the size of all curves' },
  { key: 'dihedral', label: 'Bending', title: 'Cost of the angle between neighbours, a radian (dihedral)' },
];
const kWeightScale = decades(0.001, 1000);

function Film() {
  const { settings } = film.value;
  const preset = presetOf(settings.weights);
  const setWeight = (key: keyof RelativeWeights, value: number, passing: boolean) => {
    const weights = { ...settings.weights, [key]: value };
    // A span needs something to minimise.
    if (weights.area + weights.perimeter + weights.dihedral === 0) {
      endGesture();
      return;
    }
    setFilm({ weights }, `weight ${key}`, passing);
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
          const found = kPresets.find((each) => each.id === id);
          if (found) setFilm({ weights: found.weights });
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
          setFilm({ objective });
        }}
      />
      <Segments
        label="Triangles from"
        choices={kSpaces}
        value={settings.candidates}
        onChange={(candidates) => {
          setFilm({ candidates });
        }}
      />
      <Segments label="Then" choices={kSmooths} value={settings.smooth} onChange={(smooth) => { setFilm({ smooth }); }} />
      {!auto.value && (
        <button
          type="button"
          class="button primary wide"
          disabled={film.value.items.length === 0 || spanning.state.value.phase === 'running'}
          onClick={spanning.start}
        >
          Span the curves
        </button>
      )}
    </Section>
  );
}

const kManyCurves = 12;

function Curves() {
  const { id: group, items } = film.value;
  const curves = curvesOf(film.value);
  const state = spanning.state.value;
  const [all, setAll] = useState(false);
  if (items.length === 0) return null;
  const listed = all ? items : items.slice(0, kManyCurves);
  return (
    <Section title="Curves" aside={<span class="count">{items.length}</span>}>
      <ul class="curves">
        {listed.map(({ id }, c) => {
          const place = { item: id, part: 0, handle: null };
          const isThis = chosen.value?.item === id;
          const isFaulty = state.phase === 'failed' && state.faults.some((fault) => fault.place.item === id);
          return (
            <li key={id} class={`${isThis ? 'chosen' : ''} ${isFaulty ? 'faulty' : ''}`}>
              <button type="button" class="curve" aria-pressed={isThis} onClick={() => { choose(isThis ? null : place); }}>
                <span>Curve {c + 1}</span>
                <span class="count">{countOf(pointCount(curves[c]), 'vertex', 'vertices')}</span>
              </button>
              <button
                type="button"
                class="icon-button small"
                aria-label={`Delete curve ${c + 1}`}
                title="Delete"
                onClick={() => {
                  dispatch({ type: 'delete', group, places: [place] });
                }}
              >
                <Icon name="trash" />
              </button>
            </li>
          );
        })}
      </ul>
      {items.length > listed.length && (
        <button
          type="button"
          class="button wide"
          onClick={() => {
            setAll(true);
          }}
        >
          Show all {items.length}
        </button>
      )}
    </Section>
  );
}

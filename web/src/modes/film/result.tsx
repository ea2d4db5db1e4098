// What came of the span: cost and figures, or in words why there is none.
import { useEffect, useState } from 'preact/hooks';
import type { CandidateSpace, Span, SpaceUsed } from 'soapfilm';
import { Section } from '../../app/controls.tsx';
import { Icon } from '../../app/icons.tsx';
import { Row, Trouble } from '../../app/panel_parts.tsx';
import type { Failure, WorkState } from '../../state/work.ts';
import { film, setFilm } from './film.ts';
import { isSmoothing, smoothed, smoothing } from './smoothing.ts';
import { isStale, none, spanning, surface, type Bounds } from './spanning.ts';

type StateIn<Phase> = Extract<WorkState<Bounds>, { readonly phase: Phase }>;

const kSpaceNames: Record<SpaceUsed, string> = {
  all: 'all triangles',
  delaunay: 'Delaunay triangles',
  near: 'near triangles',
  given: 'the given triangles',
};

const kWider: Partial<Record<SpaceUsed, { space: CandidateSpace; label: string }>> = {
  delaunay: { space: 'near', label: 'Try near triangles' },
  near: { space: 'all', label: 'Try all triangles' },
};

export function Result() {
  const state = spanning.state.value;
  const span = surface.value?.span;
  return (
    <Section title="Result">
      {state.phase === 'running' && <Running state={state} />}
      <Trouble work={spanning}>{state.phase === 'failed' && isTooMuch(state) && <TakeLess />}</Trouble>
      {state.phase === 'done' && none.value && <None candidates={none.value.candidates} />}
      {state.phase === 'idle' && <p class="muted">Nothing to span yet. Draw a closed curve, open a file, or take one from the gallery.</p>}
      {span && <Figures span={span} faded={isStale.value} />}
      <SmoothFigures />
    </Section>
  );
}

function Running({ state }: { state: StateIn<'running'> }) {
  const elapsed = useSecondsSince(state.since);
  const { bestCost = Infinity, lowerBound = 0 } = state.detail ?? {};
  const hasBest = bestCost < Infinity && elapsed > 0;
  return (
    <div class="running">
      <div class="running-head">
        <span>Spanning…</span>
        <span class="count">
          {Math.floor(100 * state.fraction)} %{elapsed > 0 && `, ${elapsed} s`}
        </span>
        <button type="button" class="button small" onClick={spanning.end}>
          {hasBest ? 'Stop' : 'Cancel'}
        </button>
      </div>
      <progress aria-label="Spanning" max={1} value={state.fraction} />
      {hasBest && (
        <p class="muted">
          Best so far {figure(bestCost)}
          {lowerBound > 0 && `, at least ${figure(lowerBound)}`}
        </p>
      )}
    </div>
  );
}

/** Whole seconds since a `performance.now()`, counting on. */
function useSecondsSince(since: number): number {
  const [now, setNow] = useState(since);
  useEffect(() => {
    const timer = setInterval(() => {
      setNow(performance.now());
    }, 250);
    return () => {
      clearInterval(timer);
    };
  }, [since]);
  return Math.max(0, Math.floor((now - since) / 1000));
}

/** Whether fewer candidates may do. */
const isTooMuch = ({ code }: Failure): boolean =>
  ['too-large', 'out-of-memory', 'crashed'].includes(code) && film.value.settings.candidates !== 'delaunay';

function TakeLess() {
  return (
    <button
      type="button"
      class="button small"
      onClick={() => {
        setFilm({ candidates: 'delaunay' });
        spanning.start();
      }}
    >
      Take Delaunay triangles
    </button>
  );
}

function None({ candidates }: { candidates: SpaceUsed }) {
  const wider = kWider[candidates];
  return (
    <div class="message">
      <p>
        <strong>No surface in this space.</strong> No manifold surface on {film.value.items.length === 1 ? 'this curve' : 'these curves'} can
        be made of {kSpaceNames[candidates]} alone.
      </p>
      {wider && (
        <button
          type="button"
          class="button primary"
          onClick={() => {
            setFilm({ candidates: wider.space });
            spanning.start();
          }}
        >
          {wider.label}
        </button>
      )}
    </div>
  );
}

function Figures({ span, faded }: { span: Span; faded: boolean }) {
  const { terms, stats } = span;
  const inserted = span.inserted.length;
  return (
    <div class={faded ? 'figures faded' : 'figures'}>
      <div class="cost">
        <span class="label">Cost</span>
        <output class="cost-value">{figure(span.cost)}</output>
        {span.optimal ? (
          <span class="badge good" title={`Proven: no surface of ${kSpaceNames[span.candidates]} costs less`}>
            <Icon name="check" /> optimal
          </span>
        ) : (
          <span class="badge" title={`No surface costs less than ${figure(span.lowerBound)}`}>
            {span.lowerBound > 0 ? `within ${(100 * (span.cost / span.lowerBound - 1)).toFixed(1)} %` : 'not proven'}
          </span>
        )}
      </div>
      <p class="muted">among {kSpaceNames[span.candidates]}</p>
      <dl>
        <Row name="Area" value={figure(terms.area)} />
        <Row name="Perimeters" value={figure(terms.perimeter)} />
        <Row name="Bending" value={`${figure(terms.dihedral)} rad`} />
        <Row name="Worst angle" value={`${((terms.worstDihedral * 180) / Math.PI).toFixed(1)}°`} />
        <Row name="Vertices" value={whole(span.positions.length / 3)} />
        <Row name="Triangles" value={whole(span.triangles.length / 3)} />
        <Row name="Candidates" value={whole(stats.candidates)} />
        <Row name="Domains" value={whole(stats.domains)} />
        <Row name="Memory" value={bytes(stats.peakBytes)} />
        <Row name="Time" value={seconds(stats.seconds)} />
        {inserted > 0 && <Row name="Inserted" value={whole(inserted)} />}
      </dl>
    </div>
  );
}

/** What smoothing came to. */
function SmoothFigures() {
  const found = smoothed.value;
  if (film.value.settings.smooth === 'none' || surface.value === null) return null;
  if (found === null) return isSmoothing.value ? <p class="muted">Smoothing…</p> : <Trouble work={smoothing} />;
  const { area, collapsed, triangles } = found.surface;
  return (
    <div class={isSmoothing.value ? 'figures faded' : 'figures'}>
      {collapsed.length > 0 && (
        <p class="message">There is no soap film between these curves: its neck has shrunk to a thread. Move them closer.</p>
      )}
      <dl>
        <Row name="Smoothed to" value={whole(triangles.length / 3)} />
        <Row name="Its area" value={figure(area)} />
        <Row name="Smoothing" value={seconds(found.seconds)} />
      </dl>
    </div>
  );
}

const kPlain = new Intl.NumberFormat('en', { maximumSignificantDigits: 4 });
const kEngineering = new Intl.NumberFormat('en', { maximumSignificantDigits: 4, notation: 'engineering' });

/** Four significant digits; the very small and large with an exponent that is a multiple of 3. */
export function figure(value: number): string {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  const isPlain = size === 0 || (size >= 1e-3 && size < 1e5);
  return isPlain ? kPlain.format(value) : kEngineering.format(value).replace('E', 'e');
}

const whole = (value: number): string => Math.round(value).toLocaleString('en');

function bytes(count: number): string {
  if (count < 1e3) return `${count} B`;
  if (count < 1e6) return `${(count / 1e3).toFixed(0)} kB`;
  return count < 1e9 ? `${(count / 1e6).toFixed(1)} MB` : `${(count / 1e9).toFixed(2)} GB`;
}

const seconds = (value: number): string =>
  value < 1 ? `${(value * 1000).toFixed(value < 0.01 ? 1 : 0)} ms` : `${value.toFixed(2)} s`;

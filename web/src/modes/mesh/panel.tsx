// The panel of the mode: how things stand, the list of holes, how they are filled, what is shown, examples.
import { useState } from 'preact/hooks';
import { computed, useComputed } from '@preact/signals';
import { linear, NumberField, Section, Segments, Switch, type Choice } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { Examples, Flags, Show, Trouble } from '../../app/panel_parts.tsx';
import { boundsOf } from '../../shapes/vec.ts';
import { boxOfGroup } from '../../state/document.ts';
import { shown } from '../../state/store.ts';
import { chosen, lookAt, openExample } from './actions.ts';
import { kExamples } from './examples.ts';
import { filling, isSettled, patches, patchOf } from './filling.ts';
import type { Hole } from './grouping.ts';
import {
  chosenHoles,
  chooseHoles,
  fill,
  fillAll,
  finding,
  found,
  holes,
  hoveredHole,
  hoverHole,
  isAnyLeft,
  joinHoles,
  leave,
  openAll,
  set,
  setOpenRims,
  settings,
  splitHole,
  twins,
  weldAll,
  whole,
  wishFor,
} from './holes.ts';
import { hueOf, view } from './looks.ts';
import { kMaxDensity, meshGroup, type MeshSettings } from './settings.ts';
import { isFilled, kindOfHole, reasonIn, wordsForDefect } from './wording.ts';
import './mesh.css';

/** More holes than this are listed only when asked for. */
const kManyHoles = 100;

const diagonal = computed(() => boundsOf(boxOfGroup(meshGroup.value)).diagonal || 1);
const filledCount = computed(() => patches.value.filter(isFilled).length);
const triangles = computed(() => patches.value.reduce((sum, { faces }) => sum + faces.length / 3, 0));

export const summary = computed(() => {
  if (whole.value === null) return 'No mesh yet';
  for (const { state } of [finding, filling]) if (state.value.phase === 'failed') return state.value.message;
  if (found.value === null) return finding.state.value.phase === 'cancelled' ? 'Cancelled' : 'Looking for holes…';
  const all = holes.value.length;
  if (all === 0) return 'No holes: the mesh is closed';
  const words = `${filledCount.value} of ${countOf(all, 'hole')} filled`;
  return triangles.value > 0 ? `${words}, ${countOf(triangles.value, 'triangle')}` : words;
});

export function MeshPanel() {
  return (
    <>
      <Result />
      <Holes />
      <Filling />
      <Show>
        <Flags of={view} labels={{ rims: 'Rims', zebra: 'Zebra stripes', smooth: 'Smooth shading' }} />
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

function Holes() {
  const all = holes.value;
  const [isAll, setAll] = useState(false);
  if (all.length === 0) return null;
  const listed = isAll ? all : all.slice(0, kManyHoles);
  const hasOpenRims = all.some(({ isOpenRim }) => isOpenRim);
  return (
    <Section title="Holes" aside={<span class="count">{all.length}</span>}>
      <div class="pairs">
        <button type="button" class="button primary" disabled={!isAnyLeft.value} onClick={fillAll}>
          Fill all
        </button>
        <button type="button" class="button" disabled={!all.some((hole) => wishFor(hole) !== null)} onClick={openAll}>
          Open all again
        </button>
      </div>
      {hasOpenRims && (
        <Switch label="Fill open rims too" title="Rims that are meant to be open, such as a scan’s outer edge" checked={settings.value.openRims} onChange={setOpenRims} />
      )}
      <Chosen />
      <ul class="mesh-holes" onPointerLeave={() => { hoverHole(null); }}>
        {listed.map((hole, h) => (
          <HoleRow key={hole.loops[0]} hole={hole} number={h} />
        ))}
      </ul>
      {all.length > listed.length && (
        <button type="button" class="button wide" onClick={() => { setAll(true); }}>
          Show all {all.length}
        </button>
      )}
    </Section>
  );
}

/** What can be done with the holes that are chosen. */
function Chosen() {
  const of = chosen.value;
  const isFillable = of.some((hole) => wishFor(hole) !== 'fill');
  const name = of.length === 1 ? `Hole ${chosenHoles.value[0] + 1}` : countOf(of.length, 'hole');
  return (
    <div class="mesh-chosen" role="group" aria-label="Chosen holes">
      {of.length === 0 ? (
        <p class="muted">Click a rim, or a hole in the list; with Shift more than one.</p>
      ) : (
        <>
          <span class="label">{name}</span>
          <button type="button" class="button small" disabled={!isFillable} onClick={() => { fill(...of); }}>
            Fill
          </button>
          <button type="button" class="button small" onClick={() => { leave(...of); }}>
            Leave
          </button>
          {of.length === 1 && of[0].loops.length > 1 && (
            <button type="button" class="button small" title="Each rim is a hole of its own" onClick={() => { splitHole(of[0]); }}>
              Split
            </button>
          )}
          {of.length > 1 && (
            <button type="button" class="button small" title="One surface through all these rims" onClick={() => { joinHoles(of); }}>
              Join
            </button>
          )}
        </>
      )}
    </div>
  );
}

/** Not read as the work's state, which changes with every step of its progress. */
const isFilling = computed(() => filling.state.value.phase === 'running');

type Status = readonly [word: string, tone: '' | 'good' | 'bad', reason?: string];

function statusOf(hole: Hole): Status {
  const wish = wishFor(hole);
  if (wish === 'leave') return ['left', ''];
  if (wish === null) return ['open', ''];
  const patch = patchOf(hole);
  if (patch === null) return isFilling.value ? ['filling…', ''] : ['not filled', 'bad'];
  if (!isFilled(patch)) return ['failed', 'bad', reasonIn(patch)];
  return patch.result.status === 'self-intersecting' ? ['filled', 'bad', 'it crosses something: marked in red'] : ['filled', 'good'];
}

function HoleRow({ hole, number }: { hole: Hole; number: number }) {
  // There may be hundreds of rows: one is made anew only when something about it changes.
  const isThis = useComputed(() => chosenHoles.value.includes(number)).value;
  const isHovered = useComputed(() => hoveredHole.value === number).value;
  const [word, tone, reason] = statusOf(hole);
  const isOn = wishFor(hole) === 'fill';
  const share = (100 * hole.length) / diagonal.value;
  const classes = ['mesh-hole', isThis && 'chosen', isHovered && 'hovered'].filter(Boolean).join(' ');
  return (
    <li class={classes} onPointerEnter={() => { hoverHole(number); }}>
      <button
        type="button"
        class="mesh-hole-name"
        aria-pressed={isThis}
        onClick={(event) => {
          if (event.shiftKey) {
            const others = chosenHoles.peek().filter((each) => each !== number);
            chooseHoles(...others, ...(isThis ? [] : [number]));
          } else if (isThis && chosenHoles.peek().length === 1) chooseHoles();
          else {
            chooseHoles(number);
            lookAt(hole);
          }
        }}
      >
        <span class={hole.isOpenRim ? 'mesh-dot open' : 'mesh-dot'} style={{ '--hue': hueOf(number) }} aria-hidden="true" />
        <span class="mesh-hole-words">
          <span>
            Hole {number + 1} <span class="muted">{kindOfHole(hole)}</span>
          </span>
          <span class="muted" title="The length of its rims is given in % of the mesh’s diagonal">
            {countOf(hole.vertices, 'vertex', 'vertices')}, {share < 10 ? share.toFixed(1) : share.toFixed(0)} % <span class={`mesh-status ${tone}`}>{word}</span>
          </span>
          {reason !== undefined && <span class="mesh-status bad">{reason}</span>}
        </span>
      </button>
      <button type="button" class="button small" aria-label={`${isOn ? 'Leave' : 'Fill'} hole ${number + 1}`} onClick={() => { (isOn ? leave : fill)(hole); }}>
        {isOn ? 'Leave' : 'Fill'}
      </button>
    </li>
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

function Filling() {
  const { smoothness, density, candidates } = settings.value;
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
      <Segments label="Triangles from" choices={kCandidates} value={candidates} onChange={(value) => { set({ candidates: value }); }} />
    </Section>
  );
}

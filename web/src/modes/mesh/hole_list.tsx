// The list of holes: each with its size, what is to become of it, and what has. By pointer or by keys a hole is chosen,
// filled and left.
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { computed, useComputed } from '@preact/signals';
import { Section, Switch } from '../../app/controls.tsx';
import { countOf } from '../../app/files.ts';
import { boundsOf } from '../../shapes/vec.ts';
import { boxOfGroup } from '../../state/document.ts';
import { chosen, lookAt } from './actions.ts';
import { filling, patchOf } from './filling.ts';
import type { Hole } from './grouping.ts';
import {
  chosenHoles,
  chooseHoles,
  fill,
  fillAll,
  holes,
  hoveredHole,
  hoverHole,
  isAnyLeft,
  joinHoles,
  leave,
  openAll,
  setOpenRims,
  settings,
  splitHole,
  wishFor,
} from './holes.ts';
import { hueOf } from './looks.ts';
import { meshGroup } from './settings.ts';
import { isFilled, kindOfHole, reasonIn } from './wording.ts';

/** More holes than this are listed only when asked for, and then so many at a time as they come near to view. */
const kManyHoles = 200;
/** In CSS pixels: what a row takes, and how far from view rows are made. */
const kRowHeight = 45;
const kAhead = '2000px';

const diagonal = computed(() => boundsOf(boxOfGroup(meshGroup.value)).diagonal || 1);
const hasOpenRims = computed(() => holes.value.some(({ isOpenRim }) => isOpenRim));
const isAnyDecided = computed(() => holes.value.some((hole) => wishFor(hole) !== null));

export function Holes() {
  const all = holes.value;
  const [isAll, setAll] = useState(false);
  const listed = isAll ? all.length : Math.min(all.length, kManyHoles);
  if (all.length === 0) return null;
  return (
    <Section title="Holes" aside={<span class="count">{all.length.toLocaleString('en')}</span>}>
      <div class="pairs">
        <button type="button" class="button primary" disabled={!isAnyLeft.value} onClick={fillAll}>
          Fill all
        </button>
        <button type="button" class="button" disabled={!isAnyDecided.value} onClick={openAll}>
          Open all again
        </button>
      </div>
      {hasOpenRims.value && (
        <Switch label="Fill open rims too" title="Rims that are meant to be open, such as a scan’s outer edge" checked={settings.value.openRims} onChange={setOpenRims} />
      )}
      <Chosen />
      <ul class="mesh-holes" onPointerLeave={() => { hoverHole(null); }} onKeyDown={goByKey}>
        {Array.from({ length: Math.ceil(listed / kManyHoles) }, (_, part) => (
          <Rows key={part} all={all} from={part * kManyHoles} />
        ))}
      </ul>
      {all.length > listed && (
        <button type="button" class="button wide" onClick={() => { setAll(true); }}>
          Show all {all.length.toLocaleString('en')}
        </button>
      )}
    </Section>
  );
}

/** A part of the rows, once it is near to view; until then the room for it. */
function Rows({ all, from }: { all: readonly Hole[]; from: number }) {
  const place = useRef<HTMLLIElement>(null);
  const [isNear, setNear] = useState(from === 0);
  const part = useMemo(() => all.slice(from, from + kManyHoles), [all, from]);
  useEffect(() => {
    if (isNear || place.current === null) return;
    const observer = new IntersectionObserver(
      (entries) => {
        if (entries.some(({ isIntersecting }) => isIntersecting)) setNear(true);
      },
      { root: place.current.closest('.panel-body'), rootMargin: kAhead },
    );
    observer.observe(place.current);
    return () => { observer.disconnect(); };
  }, [isNear]);
  if (!isNear) return <li ref={place} aria-hidden="true" style={{ height: `${part.length * kRowHeight}px` }} />;
  return (
    <>
      {part.map((hole, h) => (
        <HoleRow key={hole.loops[0]} hole={hole} number={from + h} />
      ))}
    </>
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
          <button type="button" class="button small" disabled={!isFillable} onClick={() => { fill(of); }}>
            Fill
          </button>
          <button type="button" class="button small" onClick={() => { leave(of); }}>
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

interface Status {
  readonly word: string;
  readonly tone: '' | 'good' | 'bad';
  readonly reason?: string;
}

// One object for each: a row is made anew only where its hole has another.
const kOpen: Status = { word: 'open', tone: '' };
const kLeft: Status = { word: 'left', tone: '' };
const kFilling: Status = { word: 'filling…', tone: '' };
const kMissing: Status = { word: 'not filled', tone: 'bad' };
const kFilled: Status = { word: 'filled', tone: 'good' };
const kCrossing: Status = { word: 'filled', tone: 'bad', reason: 'it crosses something: marked in red' };
const reasoned = new Map<string, Status>();

function withReason({ word, tone }: Status, reason: string): Status {
  const known = reasoned.get(`${word} ${reason}`);
  if (known) return known;
  const made: Status = { word, tone, reason };
  reasoned.set(`${word} ${reason}`, made);
  return made;
}

function statusOf(hole: Hole): Status {
  const wish = wishFor(hole);
  if (wish !== 'fill') return wish === 'leave' ? kLeft : kOpen;
  const patch = patchOf(hole);
  if (patch === null) return isFilling.value ? kFilling : kMissing;
  if (!isFilled(patch)) return withReason({ word: 'failed', tone: 'bad' }, reasonIn(patch));
  if (patch.result.status === 'self-intersecting') return kCrossing;
  return patch.result.reason === undefined ? kFilled : withReason(kFilled, reasonIn(patch));
}

const chosenNumbers = computed(() => new Set(chosenHoles.value));

function HoleRow({ hole, number }: { hole: Hole; number: number }) {
  const row = useRef<HTMLLIElement>(null);
  // There may be thousands of rows: each follows only what is its own.
  const isThis = useComputed(() => chosenNumbers.value.has(number)).value;
  const isHovered = useComputed(() => hoveredHole.value === number).value;
  const { word, tone, reason } = useComputed(() => statusOf(hole)).value;
  const isOn = useComputed(() => wishFor(hole) === 'fill').value;
  const share = (100 * hole.length) / diagonal.value;
  const classes = ['mesh-hole', isThis && 'chosen', isHovered && 'hovered'].filter(Boolean).join(' ');
  useEffect(() => {
    // Chosen in the scene, perhaps.
    if (isThis && chosenHoles.peek().at(-1) === number) row.current?.scrollIntoView({ block: 'nearest' });
  }, [isThis, number]);
  return (
    <li
      ref={row}
      class={classes}
      data-hole={number}
      onPointerEnter={({ pointerType }) => {
        // A finger that has been lifted points at nothing.
        if (pointerType !== 'touch') hoverHole(number);
      }}
    >
      <button type="button" class="mesh-hole-name" aria-pressed={isThis} onClick={({ shiftKey }) => { toggle(number, shiftKey); }}>
        <span class={hole.isOpenRim ? 'mesh-dot open' : 'mesh-dot'} style={{ '--hue': hueOf(number) }} aria-hidden="true" />
        <span class="mesh-hole-words">
          <span>
            Hole {number + 1} <span class="muted">{kindOfHole(hole)}</span>
          </span>
          <span class="muted" title="The length of its rims is given in % of the mesh’s diagonal">
            {countOf(hole.vertices, 'vertex', 'vertices')}, {share < 10 ? share.toFixed(1) : share.toFixed(0)} % <span class={`mesh-status ${tone}`}>{word}</span>
          </span>
          {reason !== undefined && <span class={tone === 'bad' ? 'mesh-status bad' : 'muted'}>{reason}</span>}
        </span>
      </button>
      <button type="button" class="button small" aria-label={`${isOn ? 'Leave' : 'Fill'} hole ${number + 1}`} onClick={() => { (isOn ? leave : fill)([hole]); }}>
        {isOn ? 'Leave' : 'Fill'}
      </button>
    </li>
  );
}

/** Chooses a hole alone, or no more; with `isMore` besides others. */
function toggle(number: number, isMore: boolean): void {
  const before = chosenHoles.peek();
  const isThis = before.includes(number);
  if (isMore) chooseHoles(...before.filter((each) => each !== number), ...(isThis ? [] : [number]));
  else if (isThis && before.length === 1) chooseHoles();
  else show(number);
}

function show(number: number): void {
  chooseHoles(number);
  const hole = holes.peek().at(number);
  if (hole) lookAt(hole);
}

/** Up and down go from hole to hole; what else a key does to what is chosen, it does to the row that has the focus. */
function goByKey(event: KeyboardEvent): void {
  const row = event.target instanceof Element ? event.target.closest<HTMLElement>('.mesh-hole') : null;
  if (row === null) return;
  const number = Number(row.dataset.hole);
  const isThis = chosenHoles.peek().includes(number);
  if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
    const next = event.key === 'ArrowDown' ? row.nextElementSibling : row.previousElementSibling;
    event.preventDefault();
    if (!(next instanceof HTMLElement)) return;
    next.querySelector('button')?.focus();
    const to = Number(next.dataset.hole);
    if (event.shiftKey) chooseHoles(...new Set([...chosenHoles.peek(), number, to]));
    else show(to);
  } else if ((event.key === 'Delete' || event.key === 'Backspace') && !isThis) chooseHoles(number);
  else if (event.key === 'Enter' && isThis && event.target === row.querySelector('button')) {
    event.preventDefault();
    fill(chosen.peek());
  }
}

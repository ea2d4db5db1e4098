// What can be done with meshes besides what all modes have.
import { computed } from '@preact/signals';
import type { MeshFormat } from 'soapfilm/files';
import type { Action } from '../../app/actions.ts';
import { fileStem, save } from '../../app/files.ts';
import { add, cross, length, normalize, scale, subtract, type Point } from '../../shapes/vec.ts';
import { newItem } from '../../state/document.ts';
import { complain } from '../../state/notice.ts';
import { beginWith, openItems, requestFrame, type Opening } from '../../state/store.ts';
import { kExamples, type Example } from './examples.ts';
import { isSettled, patches } from './filling.ts';
import type { Hole } from './grouping.ts';
import { chosenHoles, fill, fillAll, found, holes, isAnyLeft, leave, whole } from './holes.ts';
import { view } from './looks.ts';
import { meshKind } from './mesh_kind.ts';
import { withPatches } from './patches.ts';
import { meshGroup } from './settings.ts';
import { boxOfLoops, vertexAt } from './whole.ts';
import { isFilled } from './wording.ts';

/** What is about a hole that is looked at, in sizes of the hole. */
const kAround = 2.2;

/** A hole whose rims bound less area together than this share of what they bound singly faces nowhere. */
const kFacing = 0.3;

export const chosen = computed<readonly Hole[]>(() => chosenHoles.value.flatMap((h) => holes.value.at(h) ?? []));

const kExport = (id: string, note: string, type: string, format: MeshFormat): Action => ({
  id,
  label: `Export the filled mesh as ${note}`,
  bar: 'export',
  text: 'Filled mesh',
  note,
  applies: () => whole.value !== null,
  run: () => { saveFilled(format, type); },
});

export const kActions: readonly Action[] = [
  {
    id: 'fill chosen',
    label: 'Fill what is chosen',
    help: 'Fill the chosen holes',
    section: 'Edit',
    keys: ['canvas+enter'],
    applies: () => chosen.value.length > 0,
    run: () => { fill(chosen.peek()); },
  },
  {
    id: 'leave chosen',
    label: 'Leave what is chosen open',
    help: 'Leave the chosen holes open',
    section: 'Edit',
    keys: ['delete', 'backspace'],
    applies: () => chosen.value.length > 0,
    run: () => { leave(chosen.peek()); },
  },
  {
    id: 'fill all',
    label: 'Fill all holes',
    section: 'Edit',
    keys: ['a'],
    bar: 'tools',
    icon: { path: 'M4 6.5c5-3.5 11-3.5 16 0v11c-5 3.5-11 3.5-16 0zM8.5 12.2l2.6 2.6 4.6-5' },
    applies: () => isAnyLeft.value,
    run: fillAll,
  },
  {
    id: 'zebra',
    label: 'Zebra stripes',
    help: 'Zebra stripes: they break where the surface has a kink',
    section: 'View',
    keys: ['z'],
    bar: 'view',
    icon: { path: 'M4 18c4-2 4-10 8-12M9 20c4-3 4-11 8-13M14 20c3-3 3-7 6-9' },
    isOn: () => view.value.zebra,
    run: () => (view.value = { ...view.peek(), zebra: !view.peek().zebra }),
  },
  { ...kExport('save obj', 'OBJ', 'model/obj', 'obj'), section: 'File', keys: ['ctrl+s'] },
  kExport('save ply', 'PLY', 'application/octet-stream', 'ply'),
  kExport('save stl', 'STL', 'model/stl', 'stl'),
  kExport('save glb', 'GLB', 'model/gltf-binary', 'glb'),
];

function saveFilled(format: MeshFormat, type: string): void {
  const of = whole.peek();
  if (of === null) return;
  if (found.peek() === null || !isSettled.peek()) {
    complain('The holes are not filled yet. Export once they are.', 'export');
    return;
  }
  const { name } = meshGroup.peek();
  const filled = patches.peek().filter(isFilled);
  save(`${fileStem(name)}${filled.length > 0 ? '-filled' : ''}.${format}`, type, async () => {
    // Fetched when first wanted.
    const { writeMesh } = await import('soapfilm/files');
    return new Blob([await writeMesh(withPatches(of, filled), format, { name })], { type });
  });
}

/** Brings a hole into view, from outside: from where the eye is, if it has no side of its own, as a missing band. */
export function lookAt({ loops }: Hole): void {
  const now = found.peek();
  if (now === null) return;
  const areas = loops.map((loop) => areaOf(Array.from(now.report.loops[loop].vertices, (vertex) => vertexAt(now.of, vertex))));
  // Islands run the other way round, and take away from it.
  const area = areas.reduce(add);
  const isFacing = length(area) > kFacing * areas.reduce((sum, each) => sum + length(each), 0);
  const { low, high } = boxOfLoops(now, loops);
  const more = scale(subtract(high, low), (kAround - 1) / 2);
  requestFrame(isFacing ? normalize(area) : undefined, false, { low: subtract(low, more), high: add(high, more) });
}

/** Twice the area that a rim bounds, along its normal: Newell's sum, about a point of the rim so that no digits are lost. */
function areaOf(rim: readonly Point[]): Point {
  const arms = rim.map((point) => subtract(point, rim[0]));
  return arms.map((arm, i) => cross(arm, arms[(i + 1) % arms.length])).reduce(add);
}

const openingOf = ({ title, shape, view: direction }: Example): Opening => ({ name: title, items: [newItem(meshKind, shape())], view: direction });

export function openExample(example: Example): void {
  openItems(meshGroup.peek(), openingOf(example));
}

/** The first example, as what was there from the beginning. */
export function beginWithExample(): void {
  beginWith(meshGroup.peek(), openingOf(kExamples[0]));
}


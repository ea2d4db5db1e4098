// What can be done with meshes besides what all modes have.
import { computed } from '@preact/signals';
import type { MeshFormat } from 'soapfilm/files';
import type { Action } from '../../app/actions.ts';
import { fileStem, save } from '../../app/files.ts';
import { add, cross, normalize, scale, subtract } from '../../shapes/vec.ts';
import { newItem } from '../../state/document.ts';
import { complain } from '../../state/notice.ts';
import { choose, dispatch, put, requestFrame } from '../../state/store.ts';
import { kExamples, type Example } from './examples.ts';
import { isSettled, patches, withPatches } from './filling.ts';
import type { Hole } from './grouping.ts';
import { chosenHoles, fill, fillAll, found, holes, isAnyLeft, leave, whole } from './holes.ts';
import { view } from './looks.ts';
import { meshKind } from './mesh_kind.ts';
import { kNoChoices, meshGroup } from './settings.ts';
import { boxOfLoops, vertexAt } from './whole.ts';
import { isFilled } from './wording.ts';

/** What is about a hole that is looked at, in sizes of the hole. */
const kAround = 2.2;

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
    run: () => { fill(...chosen.peek()); },
  },
  {
    id: 'leave chosen',
    label: 'Leave what is chosen open',
    help: 'Leave the chosen holes open',
    section: 'Edit',
    keys: ['delete', 'backspace'],
    applies: () => chosen.value.length > 0,
    run: () => { leave(...chosen.peek()); },
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

/** Brings a hole into view, from outside. */
export function lookAt({ loops }: Hole): void {
  const now = found.peek();
  if (now === null) return;
  const rim = Array.from(now.report.loops[loops[0]].vertices, (vertex) => vertexAt(now.of, vertex));
  // Newell's sum, about a point of the rim so that far from the origin no digits are lost.
  const arms = rim.map((point) => subtract(point, rim[0]));
  const normal = arms.map((arm, i) => cross(arm, arms[(i + 1) % arms.length])).reduce(add);
  const { low, high } = boxOfLoops(now, loops);
  const more = scale(subtract(high, low), (kAround - 1) / 2);
  requestFrame(normalize(normal), false, { low: subtract(low, more), high: add(high, more) });
}

export function openExample({ title, shape, view: direction }: Example): void {
  choose();
  dispatch({
    type: 'open',
    group: meshGroup.peek().id,
    name: title,
    items: [newItem(meshKind, shape())],
    settings: { ...meshGroup.peek().settings, of: [], ...kNoChoices },
  });
  requestFrame(direction);
}

/** The first example, as what was there from the beginning. */
export function beginWithExample(): void {
  const { title, shape, view: direction } = kExamples[0];
  put({ ...meshGroup.peek(), name: title, items: [newItem(meshKind, shape())] });
  requestFrame(direction, true);
}


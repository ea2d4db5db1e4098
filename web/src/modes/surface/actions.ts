// What can be done with models besides what all modes have.
import type { Action } from '../../app/actions.ts';
import { fileStem, save } from '../../app/files.ts';
import { newItem } from '../../state/document.ts';
import { complain } from '../../state/notice.ts';
import { beginWith, openItems, type Opening } from '../../state/store.ts';
import { kExamples, type Example } from './examples.ts';
import { coloring } from './looks.ts';
import { frozen, meshed, model, settings } from './meshing.ts';
import { modelKind } from './model_kind.ts';
import { surfaceGroup } from './settings.ts';

export const kActions: readonly Action[] = [
  {
    id: 'freeze',
    label: 'Freeze the mesh',
    help: 'Freeze the mesh as it is for the camera, to look at it from elsewhere',
    section: 'View',
    keys: ['f'],
    bar: 'view',
    icon: { path: 'M12 3v18M4.5 7.5l15 9M19.5 7.5l-15 9' },
    applies: () => settings.value.follows,
    isOn: () => frozen.value,
    run: () => (frozen.value = !frozen.peek()),
  },
  {
    id: 'strips',
    label: 'Colour the strips',
    section: 'View',
    keys: ['t'],
    bar: 'view',
    icon: { path: 'M3 16l4-8 4 8 4-8 4 8M3 16h16M7 8h12' },
    isOn: () => coloring.value === 'strips',
    run: () => (coloring.value = coloring.peek() === 'strips' ? 'plain' : 'strips'),
  },
  {
    id: 'save glb',
    label: 'Export the mesh as GLB',
    bar: 'export',
    text: 'Mesh',
    note: 'GLB',
    section: 'File',
    keys: ['ctrl+s'],
    applies: () => model.value !== null,
    run: saveMesh,
  },
  {
    id: 'save model',
    label: 'Export the model as JSON',
    bar: 'export',
    text: 'Model',
    note: 'JSON',
    applies: () => model.value !== null,
    run: saveModel,
  },
];

function saveMesh(): void {
  const now = meshed.peek();
  if (now === null || now.of.model !== model.peek()) {
    complain('The model is not meshed yet. Export once it is.', 'export');
    return;
  }
  const { name } = surfaceGroup.peek();
  const { positions, triangles, normals, uvs, origin } = now.change.mesh;
  // Copies: the next update writes into the arrays. Without the room that faces have to grow.
  const at = Float64Array.from(positions, (x, i) => x + origin[i % 3]);
  const drawn = triangles.filter((_, i) => triangles[i - (i % 3)] !== triangles[i - (i % 3) + 1]);
  const attributes = { normal: { data: normals.slice(), size: 3 }, uv: { data: uvs.slice(), size: 2 } };
  save(`${fileStem(name)}.glb`, 'model/gltf-binary', async () => {
    const { writeMesh } = await import('soapfilm/files');
    return new Blob([await writeMesh({ positions: at, faces: drawn, attributes }, 'glb', { name })], { type: 'model/gltf-binary' });
  });
}

function saveModel(): void {
  const of = model.peek();
  if (of === null) return;
  const { name } = surfaceGroup.peek();
  // Typed arrays as lists; what is no number in JSON is null there.
  const plain = (_: string, value: unknown): unknown => (ArrayBuffer.isView(value) ? Array.from(value as Float64Array) : value);
  save(`${fileStem(name)}.json`, 'application/json', () => JSON.stringify({ schema: 'trimmed-nurbs/1', name, ...of }, plain));
}

const openingOf = ({ title, model: made, view }: Example): Opening => ({ name: title, items: [newItem(modelKind, { model: made() })], view });

export function openExample(example: Example): void {
  openItems(surfaceGroup.peek(), openingOf(example));
}

/** The first example, as what was there from the beginning. */
export function beginWithExample(): void {
  beginWith(surfaceGroup.peek(), openingOf(kExamples[0]));
}

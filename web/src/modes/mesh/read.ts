// Meshes from files. What reads a format is fetched with the first file of it.
import type { Content } from '../../app/content.ts';
import type { ReadFile } from '../../app/mode.ts';
import { newItem } from '../../state/document.ts';
import { meshKind } from './mesh_kind.ts';
import type { MeshShape } from './settings.ts';

/** @throws SoapfilmError `bad-file` */
export async function readMesh(kind: string, content: Content): Promise<ReadFile> {
  return { items: [newItem(meshKind, await shapeIn(kind, content))] };
}

async function shapeIn(kind: string, content: Content): Promise<MeshShape> {
  const readers = await import('./readers.ts');
  switch (kind) {
    case 'ply':
      return readers.readPly(content.bytes);
    case 'stl':
      return readers.readStl(content.bytes, content.isText, () => content.text);
    case 'glb':
      return readers.readGlb(content.bytes);
    default:
      return readers.readObj(content.text);
  }
}

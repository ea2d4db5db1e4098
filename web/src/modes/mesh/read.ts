// Meshes from files. What reads them is fetched with the first file.
import type { MeshLike } from 'soapfilm';
import type { Content } from '../../app/content.ts';
import type { ReadFile } from '../../app/mode.ts';
import { newItem } from '../../state/document.ts';
import { meshKind } from './mesh_kind.ts';
import type { MeshShape } from './settings.ts';

/** @throws SoapfilmError `bad-file` */
export async function readMesh(kind: string, content: Content): Promise<ReadFile> {
  const files = await import('soapfilm/files');
  const { warnings, ...mesh } = await files.readMesh(content.bytes, `${content.stem}.${kind}`);
  return { items: [newItem(meshKind, single(mesh))], warnings };
}

/** The mesh in single precision, as it is drawn. */
function single({ positions, faces, attributes }: MeshLike): MeshShape {
  return { positions: positions instanceof Float32Array ? positions : new Float32Array(positions), faces, ...(attributes && { attributes }) };
}

// Holes of meshes: found, grouped with their islands, filled.
import type { Content } from '../../app/content.ts';
import type { Mode } from '../../app/mode.ts';

/** 80 bytes of any kind, the number of triangles, and 50 bytes for each. */
function isBinaryStl({ bytes }: Content): boolean {
  if (bytes.length < 84) return false;
  return bytes.length === 84 + 50 * new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
}

export const mesh: Mode = {
  id: 'mesh',
  label: 'Mesh',
  title: 'Holes of scanned meshes, filled',
  files: [
    { id: 'ply', what: 'a PLY file', label: 'PLY', extensions: ['.ply'], isIt: (content) => content.hasMark('ply\n') || content.hasMark('ply\r') },
    {
      id: 'stl',
      what: 'an STL file',
      label: 'STL',
      extensions: ['.stl'],
      isIt: (content) => (content.isText ? /^solid\b[^]*\bfacet\b/.test(content.head) : isBinaryStl(content)),
    },
    { id: 'glb', what: 'a GLB file', label: 'GLB', extensions: ['.glb'], isIt: (content) => content.hasMark('glTF') },
    {
      id: 'obj',
      what: 'an OBJ file of faces',
      label: 'OBJ',
      extensions: ['.obj'],
      isIt: (content) => content.hasStatement('v') && content.hasStatement('f'),
    },
  ],
  fetch: () => import('./room.tsx'),
};

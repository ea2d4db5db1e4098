// What reads and writes files of meshes, by itself, so that the page need not fetch it before it is wanted.
export { readGlb } from './read_glb.ts';
export { readObj } from './read_obj.ts';
export { readPly } from './read_ply.ts';
export { readStl } from './read_stl.ts';

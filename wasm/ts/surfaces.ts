// The package's entry for trimmed surfaces. `load` of the main entry loads their part, 'surfaces'.
export { TrimmedModel, TrimmedSurface } from './trimmed_model.js';
export type * from './surface_types.js';
export type { Tessellation as Mesh, TessellationReport as Report } from './surface_types.js';

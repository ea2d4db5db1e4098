// The package's entry for trimmed surfaces. `load` of the main entry loads their part, 'surfaces'.
export { fromGeomdl } from './from_geomdl.js';
export { fromOpenCascade, type OpenCascade } from './from_opencascade.js';
export { fromRhino, type FromRhinoOptions, type Rhino, type RhinoBrep } from './from_rhino.js';
export { fromThree, type ThreeSurface } from './from_three.js';
export { parseTrimmedModel } from './model_file.js';
export { TrimmedModel, TrimmedSurface } from './trimmed_model.js';
export type * from './surface_types.js';
export type { Tessellation as Mesh, TessellationReport as Report } from './surface_types.js';

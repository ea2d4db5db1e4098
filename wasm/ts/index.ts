export { load } from './load.js';
export { spanLoops } from './loops.js';
export { triangulatePolygon, triangulatePolygons } from './polygon.js';
export { PolygonSession } from './polygon_session.js';
export { triangulateGeoJSON } from './geojson.js';
export { SoapfilmError } from './errors.js';
export { formatLoops, formatObj, parseLoops, type FormatObjOptions, type LoopFile, type LoopFormat } from './formats.js';
export type * from './errors.js';
export type * from './types.js';

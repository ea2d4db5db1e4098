// Polygons with holes in the plane, triangulated as they change.
import type { Mode } from '../../app/mode.ts';
import { kLoopFiles } from '../../app/loop_files.ts';

const kGeoTypes =
  /^(FeatureCollection|Feature|GeometryCollection|(Multi)?(Point|LineString|Polygon))$/;

export const polygon: Mode = {
  id: 'polygon',
  label: 'Polygon',
  title: 'Triangles of polygons with holes in the plane',
  files: [
    {
      id: 'geojson',
      what: 'a GeoJSON file',
      label: 'GeoJSON',
      extensions: ['.geojson', '.json'],
      isIt: ({ jsonType }) => jsonType !== undefined && kGeoTypes.test(jsonType),
    },
    ...kLoopFiles,
  ],
  fetch: () => import('./room.tsx'),
};

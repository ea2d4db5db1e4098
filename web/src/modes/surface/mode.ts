// Trimmed surfaces of CAD models: meshed to a tolerance or for the camera, their poles dragged.
import type { Mode } from '../../app/mode.ts';

export const surface: Mode = {
  id: 'surface',
  label: 'Surface',
  title: 'Trimmed surfaces of CAD models, meshed without cracks',
  files: [
    {
      id: 'trimmed',
      what: 'a model of trimmed surfaces',
      label: 'trimmed NURBS',
      extensions: ['.json'],
      isIt: (content) => content.isJson && (content.hasKey('instances') || (content.hasKey('faces') && content.hasKey('edges'))),
    },
  ],
  fetch: () => import('./room.tsx'),
};

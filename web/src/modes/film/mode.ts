// Films: surfaces between closed curves in space.
import { kLoopFiles } from '../../app/loop_files.ts';
import type { Mode } from '../../app/mode.ts';

export const film: Mode = {
  id: 'film',
  label: 'Film',
  title: 'Surfaces between curves in space',
  files: kLoopFiles,
  fetch: () => import('./room.tsx'),
};

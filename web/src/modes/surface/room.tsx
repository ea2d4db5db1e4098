// The room of trimmed surfaces: opened, meshed, and edited by their poles.
import { computed } from '@preact/signals';
import type { Room } from '../../app/mode.ts';
import type { Stage } from '../../scene/stage.ts';
import type { Failure } from '../../state/work.ts';
import { beginWithExample, kActions } from './actions.ts';
import { drawSurfaces } from './drawing.ts';
import { exposeForInspection } from './inspection.ts';
import { meshing } from './meshing.ts';
import { modelKind } from './model_kind.ts';
import { SurfacePanel, summary } from './panel.tsx';
import { readModel } from './read.ts';
import { areSurfaceSettings, kSettings, type SurfaceSettings } from './settings.ts';

const failures = computed<readonly Failure[]>(() => (meshing.state.value.phase === 'failed' ? [meshing.state.value] : []));

export const openRoom = (stage: Stage): Room => ({
  dimension: 3,
  kinds: [modelKind],
  nouns: ['model', 'models'],
  fileNoun: 'models',
  partNoun: 'model',
  settings: kSettings,
  areSettings: (settings) => areSurfaceSettings(settings as SurfaceSettings),
  begin: beginWithExample,
  draw: (scene) => {
    drawSurfaces(stage, scene);
    exposeForInspection(stage, scene);
  },
  read: readModel,
  failures,
  actions: kActions,
  help: {
    about: 'A model of trimmed surfaces in, a mesh without cracks out: within a tolerance that is measured, or for the camera.',
    rows: [
      { section: 'View', keys: 'Right drag, two fingers', what: 'Move' },
      { section: 'View', keys: 'Arrows, + −', what: 'Turn and zoom, with the scene in focus' },
      { section: 'Edit', keys: 'Drag a dot', what: 'Move a pole of a surface; a diamond: of a trimming curve' },
    ],
  },
  summary,
  panelLabel: 'Surfaces',
  sceneLabel: 'Scene: trimmed surfaces. Arrows turn the view or move the chosen pole; comma and full stop choose one.',
  Panel: SurfacePanel,
});

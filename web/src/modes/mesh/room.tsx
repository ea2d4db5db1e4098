// The room of meshes: opened, their holes found, and filled one by one or all at once.
import { computed } from '@preact/signals';
import type { Room } from '../../app/mode.ts';
import type { Stage } from '../../scene/stage.ts';
import type { Failure } from '../../state/work.ts';
import { beginWithExample, kActions } from './actions.ts';
import { drawHoles } from './drawing.ts';
import { filling, patchOf } from './filling.ts';
import { finding, found, holes } from './holes.ts';
import { exposeForInspection } from './inspection.ts';
import { meshKind } from './mesh_kind.ts';
import { MeshPanel, summary } from './panel.tsx';
import { readMesh } from './read.ts';
import { areMeshSettings, kSettings, type MeshSettings } from './settings.ts';
import { placeOf, vertexAt } from './whole.ts';
import { isFilled, reasonIn } from './wording.ts';

/** Work that failed, and holes that have no surface. */
const failures = computed<readonly Failure[]>(() => {
  const ofWork = [finding, filling].flatMap(({ state: { value } }) => (value.phase === 'failed' ? value : []));
  const now = found.value;
  if (now === null) return ofWork;
  const ofHoles = holes.value.flatMap((hole, h): Failure[] => {
    const patch = patchOf(hole);
    if (patch === null || isFilled(patch)) return [];
    const place = placeOf(now.of, hole.loops[0]);
    if (place === null) return [];
    const point = vertexAt(now.of, now.report.loops[hole.loops[0]].vertices[0]);
    return [{ code: patch.result.reason ?? 'failed', message: `Hole ${h + 1}: ${reasonIn(patch)}.`, faults: [{ place, isEdge: false }], point }];
  });
  return [...ofWork, ...ofHoles];
});

export const openRoom = (stage: Stage): Room => ({
  dimension: 3,
  kinds: [meshKind],
  nouns: ['mesh', 'meshes'],
  fileNoun: 'meshes',
  partNoun: 'rim',
  settings: kSettings,
  areSettings: (settings) => areMeshSettings(settings as MeshSettings),
  begin: beginWithExample,
  draw: (scene) => {
    drawHoles(stage, scene);
    exposeForInspection(stage, scene);
  },
  read: readMesh,
  failures,
  actions: kActions,
  help: {
    about: 'A mesh with holes in, a closed one out. What was there stays as it is, bit for bit; islands within a hole are kept.',
    rows: [
      { section: 'View', keys: 'Right drag, two fingers', what: 'Move' },
      { section: 'View', keys: 'Arrows, + −', what: 'Turn and zoom, with the scene in focus' },
      { section: 'Edit', keys: 'Click on a rim', what: 'Choose the hole; Shift: more than one' },
      { section: 'Edit', keys: '↑ ↓', what: 'Previous and next hole, in the list; Shift: choose more' },
    ],
  },
  summary,
  panelLabel: 'Holes',
  sceneLabel: 'Scene: mesh, rims and patches. Arrows turn the view; brackets choose a rim, Enter fills its hole.',
  Panel: MeshPanel,
});

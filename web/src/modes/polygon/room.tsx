// The room of polygons with holes in the plane: drawn or opened, triangulated as they change.
import type { Room } from '../../app/mode.ts';
import type { Stage } from '../../scene/stage.ts';
import { beginWithExample, kActions } from './actions.ts';
import { drawTriangulation } from './drawing.ts';
import { endFlooding } from './flooding.ts';
import { exposeForInspection } from './inspection.ts';
import { Panel, Step, summary } from './panel.tsx';
import { penTool } from './pen.ts';
import { arePolygonSettings, kSettings, polygonKind, type PolygonSettings } from './polygons.ts';
import { readPolygons } from './read.ts';
import { failures } from './triangulating.ts';

export const openRoom = (stage: Stage): Room => ({
  dimension: 2,
  kinds: [polygonKind],
  nouns: ['polygon', 'polygons'],
  fileNoun: 'polygons',
  partNoun: 'ring',
  settings: kSettings,
  areSettings: (settings) => arePolygonSettings(settings as PolygonSettings),
  begin: beginWithExample,
  draw: (scene) => {
    drawTriangulation(stage, scene);
    exposeForInspection(stage, scene);
  },
  read: readPolygons,
  pen: penTool,
  failures,
  actions: kActions,
  escape: endFlooding,
  help: {
    about: 'Polygons with holes in, triangles out: they lie inside and cover everything.',
    rows: [
      { section: 'View', keys: 'Right drag, two fingers', what: 'Move, with either tool' },
      { section: 'View', keys: 'Arrows, + −', what: 'Move and zoom, with the drawing in focus' },
    ],
  },
  summary,
  panelLabel: 'Polygons',
  sceneLabel: 'Polygons. Arrows move the view or the chosen vertex; comma and full stop choose a vertex.',
  Panel,
  Overlay: Step,
  hint: {
    drawing: 'Draw one stroke all the way round: it closes when you let go. A ring drawn inside another is a hole.',
    draw: 'Draw a polygon',
  },
});

// The room of films: curves in space, drawn or opened, spanned as they change.
import { computed } from '@preact/signals';
import type { SmoothSurface, Span } from 'soapfilm';
import type { Action } from '../../app/actions.ts';
import { openDialog } from '../../app/dialogs.tsx';
import { countOf, fileStem, save } from '../../app/files.ts';
import type { Room } from '../../app/mode.ts';
import { PenBar } from '../../app/pen_bar.tsx';
import { gridStep } from '../../scene/grid.ts';
import type { Stage } from '../../scene/stage.ts';
import { circleInPlane, toPlane } from '../../shapes/plane.ts';
import { pointAt, pointCount } from '../../shapes/lines.ts';
import { dot, subtract } from '../../shapes/vec.ts';
import { newItem } from '../../state/document.ts';
import { complain, settle } from '../../state/notice.ts';
import { choose, dispatch, requestFrame } from '../../state/store.ts';
import { kCurve } from './curve.ts';
import { beginWithExample, film, pen } from './film.ts';
import { FilmScene, isGrowing } from './film_scene.ts';
import { Gallery } from './gallery_sheet.tsx';
import { exposeFilm } from './inspection.ts';
import { FilmPanel } from './panel.tsx';
import { figure } from './result.tsx';
import { areFilmSettings, curveOf, curvesOf, fromLoopSet, kDefaultSettings, toLoopSet, type FilmSettings } from './settings.ts';
import { isSmoothing, smoothed } from './smoothing.ts';
import { isStale, none, spanning, surface } from './spanning.ts';

/** A vertex nearer to a plane lies in it, in radii of what is in view. */
const kClear = 1e-3;

const fetchFormats = () => import('../../app/formats.ts');

export function openRoom(stage: Stage): Room {
  let scene: FilmScene | null = null;
  return {
    dimension: 3,
    kinds: [kCurve],
    nouns: ['curve', 'curves'],
    fileNoun: 'loops',
    settings: kDefaultSettings,
    areSettings: (settings) => areFilmSettings(settings as FilmSettings),
    begin: beginWithExample,
    draw(modeScene) {
      scene = new FilmScene(stage, modeScene);
      exposeFilm(modeScene.viewpoint, stage.view.canvas);
    },
    async read(_, { text }) {
      const { parseLoops } = await fetchFormats();
      const loops = parseLoops(text);
      const items = fromLoopSet(loops).map((curve) => newItem(kCurve, curve));
      return { items, ...(loops.name !== undefined && { name: loops.name }) };
    },
    pen: {
      noun: 'curve',
      help: 'one stroke all the way round is one closed curve',
      pen: () => pen.peek(),
      add: (points) => {
        dispatch({ type: 'add', group: film.peek().id, items: [newItem(kCurve, curveOf(points))] });
      },
    },
    pressed: () => {
      if (isGrowing.peek()) scene?.skipGrowth();
    },
    failures: computed(() => (spanning.state.value.phase === 'failed' ? [spanning.state.value] : [])),
    actions: [
      {
        id: 'gallery',
        label: 'Gallery',
        help: 'Open the gallery',
        section: 'File',
        keys: ['g'],
        bar: 'document',
        icon: 'gallery',
        text: 'Gallery',
        run: () => (openDialog.value = 'gallery'),
      },
      {
        id: 'circle',
        label: 'Add a circle',
        help: 'Add a circle in the drawing plane',
        section: 'Tools',
        keys: ['a'],
        bar: 'tools',
        icon: 'circle',
        run: () => { addCircle(stage); },
      },
      {
        id: 'replay',
        label: () => (isGrowing.value ? 'Show the whole surface now' : 'Let the surface appear again'),
        help: 'Let the surface appear again',
        section: 'View',
        keys: [' '],
        bar: 'view',
        icon: () => (isGrowing.value ? 'skip' : 'play'),
        applies: () => isGrowing.value || surface.value !== null,
        run: () => {
          if (isGrowing.peek()) scene?.skipGrowth();
          else scene?.replay();
        },
      },
      ...kExports,
    ],
    help: {
      about:
        'Closed curves in, the best surface out: of all manifold triangulations made of the candidate triangles, the one of least cost.',
      rows: [
        { section: 'Tools', keys: '1 2 3 4', what: 'Drawing plane XY, YZ, ZX, facing you' },
        { section: 'View', keys: 'Right drag, two fingers', what: 'Move; while drawing, turn' },
        { section: 'View', keys: 'Alt drag', what: 'Turn, with either tool' },
        { section: 'View', keys: 'Arrows, + −', what: 'Turn and zoom, with the scene in focus' },
      ],
    },
    summary,
    panelLabel: 'Film',
    sceneLabel: 'Scene: curves and surface. Arrows turn the view; comma and full stop choose a vertex.',
    Panel: FilmPanel,
    Overlay: () => <PenBar pen={pen} of="curve" radius={() => stage.current.peek()?.viewpoint.radius ?? 1} />,
    dialogs: [{ id: 'gallery', title: 'Gallery', Body: Gallery }],
    hint: { drawing: 'Draw one stroke all the way round: it closes when you let go.', draw: 'Draw a curve' },
  };
}

const summary = computed(() => {
  const state = spanning.state.value;
  switch (state.phase) {
    case 'idle':
      return 'No curves yet';
    case 'running':
      return 'Spanning…';
    case 'failed':
      return state.message;
    case 'cancelled':
      return 'Cancelled';
    case 'done': {
      if (none.value) return 'No surface in this space';
      const span = surface.value?.span;
      return span ? `Cost ${figure(span.cost)}, ${countOf(span.triangles.length / 3, 'triangle')}` : '';
    }
  }
});

const hasCurves = (): boolean => film.value.items.length > 0;

const kExports: readonly Action[] = [
  {
    id: 'save surface',
    label: 'Export the surface as OBJ',
    section: 'File',
    keys: ['ctrl+s'],
    bar: 'export',
    text: 'Surface',
    note: 'OBJ',
    // By key it says why there is none.
    isOff: () => surface.value === null || isStale.value,
    run: saveSurface,
  },
  {
    id: 'save curves',
    label: 'Export the curves as .curve',
    bar: 'export',
    text: 'Curves',
    note: '.curve',
    applies: hasCurves,
    run: () => { saveCurves('curve'); },
  },
  {
    id: 'save json',
    label: 'Export the curves as JSON',
    bar: 'export',
    text: 'Curves',
    note: 'JSON',
    applies: hasCurves,
    run: () => { saveCurves('json'); },
  },
];

function saveSurface(): void {
  settle('export');
  const present = surface.peek();
  if (present === null || isStale.peek()) {
    complain('There is no surface of these curves to export yet.', 'export');
    return;
  }
  const { name } = film.peek();
  const write = (of: Span | SmoothSurface): void => {
    save(`${fileStem(name)}.obj`, 'model/obj', async () => (await fetchFormats()).formatObj(of, { name }));
  };
  if (isSmoothing.peek()) {
    complain('The surface is still being smoothed.', 'export', { label: 'Export as it was spanned', run: () => { write(present.span); } });
  } else write(smoothed.peek()?.surface ?? present.span);
}

function saveCurves(format: 'curve' | 'json'): void {
  const { name } = film.peek();
  const curves = curvesOf(film.peek());
  const type = format === 'json' ? 'application/json' : 'text/plain';
  const write = async () => (await fetchFormats()).formatLoops({ ...toLoopSet(curves), name }, format);
  save(`${fileStem(name)}.${format}`, type, write);
}

/**
 * Adds a circle in the drawing plane, around the point of it that the view turns about; smaller
 * where a curve has a vertex on that circle already.
 */
function addCircle(stage: Stage): void {
  const viewpoint = stage.current.peek()?.viewpoint;
  if (!viewpoint) return;
  const frame = stage.drawingPlane();
  const { radius, target } = viewpoint;
  const center = toPlane(frame, target);
  const group = film.peek();
  // Distances of the vertices in the plane from the center.
  const taken = curvesOf(group).flatMap((curve) =>
    Array.from({ length: pointCount(curve) }, (_, i) => {
      const point = pointAt(curve, i);
      const [u, v] = toPlane(frame, point);
      const height = dot(subtract(point, frame.origin), frame.normal);
      return Math.abs(height) < kClear * radius ? Math.hypot(u - center[0], v - center[1]) : Infinity;
    }),
  );
  let size = 3 * gridStep(radius);
  while (taken.some((distance) => Math.abs(distance - size) < 0.1 * size)) size *= 0.75;
  const circle = newItem(kCurve, curveOf(circleInPlane(frame, center, size, pen.peek().count)));
  dispatch({ type: 'add', group: group.id, items: [circle] });
  choose({ item: circle.id, part: 0, handle: null });
  if (group.items.length === 0) requestFrame();
}

// The actions that all modes have.
import { nudge } from '../scene/nudge.ts';
import type { Stage } from '../scene/stage.ts';
import type { Tools } from '../scene/tools.ts';
import type { PlaneKind } from '../shapes/plane.ts';
import { dismissNotice, notice } from '../state/notice.ts';
import {
  canRedo,
  canUndo,
  choose,
  chosen,
  dispatch,
  drawingPlane,
  group,
  isMovable,
  redo,
  selection,
  stepHandle,
  stepPart,
  tool,
  undo,
} from '../state/store.ts';
import { endShownWork } from '../state/work.ts';
import type { Action } from './actions.ts';
import { chooseFile } from './open_button.tsx';
import { openDialog } from './dialogs.tsx';
import { fileStem, save } from './files.ts';
import type { HelpRow, Room } from './mode.ts';

/** What a key press enlarges the view by. */
const kCloser = 1.18;
/** How much further an arrow moves with Shift. */
const kFar = 10;

/** Whether nothing in a room can be moved or removed by itself. */
const areAllFixed = ({ kinds }: Room): boolean => kinds.every(({ isFixed }) => isFixed);

const isEmpty = (): boolean => (group.value?.items.length ?? 0) === 0;

/** All actions of the page while it is in a mode, in the order of their buttons. */
export function actionsOf(stage: Stage, tools: Tools, room: Room | undefined): readonly Action[] {
  return [
    ...toolActions(room),
    ...(room?.actions ?? []),
    ...(room && areAllFixed(room) ? [] : handleActions(room)),
    ...coreActions(stage, tools, room),
    ...(room?.dimension === 3 && room.pen ? planeActions(stage) : []),
    pictureAction(stage),
  ];
}

/** The tools, of which modes without a pen have no choice. */
function toolActions(room: Room | undefined): readonly Action[] {
  const pen = room?.pen;
  if (!pen) return [];
  const select: Action = {
    id: 'select',
    label: 'Select',
    help: `Select: drag a vertex, or what is chosen; drag elsewhere to ${room.dimension === 3 ? 'turn' : 'move'} the view`,
    section: 'Tools',
    keys: ['v'],
    bar: 'tools',
    icon: 'select',
    isOn: () => tool.value === 'select',
    run: () => (tool.value = 'select'),
  };
  const draw: Action = {
    id: 'draw',
    label: 'Draw',
    help: `Draw: ${pen.help}`,
    section: 'Tools',
    keys: ['d'],
    bar: 'tools',
    icon: 'draw',
    isOn: () => tool.value === 'draw',
    run: () => (tool.value = 'draw'),
  };
  return [select, draw];
}

const kPlanes: readonly PlaneKind[] = ['xy', 'yz', 'zx', 'view'];

/** Those of modes with a pen in space: the plane that is drawn in. */
function planeActions(stage: Stage): readonly Action[] {
  return [
    ...kPlanes.map(
      (plane, i): Action => ({
        id: `plane ${plane}`,
        label: `Draw in ${plane}`,
        keys: [String(i + 1)],
        run: () => (drawingPlane.value = { ...drawingPlane.peek(), plane }),
      }),
    ),
    {
      id: 'face',
      label: 'Face the drawing plane',
      section: 'Tools',
      keys: ['p'],
      bar: 'view',
      icon: 'face',
      run: () => { stage.facePlane(); },
    },
  ];
}

/** Those of modes whose objects have vertices, or parts, that can be moved and removed. */
function handleActions(room: Room | undefined): readonly Action[] {
  const part = room?.partNoun ?? nounsOf(room)[0];
  return [
    { id: 'handle before', label: 'Previous vertex', keys: [','], run: () => { stepHandle(-1); } },
    { id: 'handle after', label: 'Next vertex', keys: ['.'], run: () => { stepHandle(1); } },
    {
      id: 'delete',
      label: () => (typeof chosen.value?.handle === 'number' ? 'Delete the chosen vertex' : `Delete the chosen ${part}`),
      help: 'Delete the chosen vertex, or all that is chosen',
      section: 'Edit',
      keys: ['delete', 'backspace'],
      bar: 'bin',
      icon: 'trash',
      applies: () => selection.value.some(isMovable),
      run: () => {
        const id = group.peek()?.id;
        if (id !== undefined) dispatch({ type: 'delete', group: id, places: selection.peek() });
      },
    },
  ];
}

const nounsOf = (room: Room | undefined): Room['nouns'] => room?.nouns ?? ['object', 'objects'];

const pictureAction = (stage: Stage): Action => ({
  id: 'picture',
  label: 'Export the picture',
  bar: 'export',
  text: 'Picture',
  note: 'PNG',
  run: () => { save(`${fileStem(group.peek()?.name ?? '')}.png`, 'image/png', () => stage.view.picture()); },
});

function coreActions(stage: Stage, tools: Tools, room: Room | undefined): readonly Action[] {
  const [, many] = nounsOf(room);
  const viewpoint = () => stage.current.peek()?.viewpoint;
  const arrow = (key: string, right: number, up: number): Action => ({
    id: key,
    label: key,
    keys: [`canvas+${key}`, `canvas+shift+${key}`],
    run: (event) => {
      const far = event?.shiftKey ? kFar : 1;
      if (!nudge(stage, far * right, far * up, event?.repeat ?? false)) viewpoint()?.step(right, up);
    },
  });
  return [
    {
      id: 'fit',
      label: 'All in view',
      section: 'View',
      keys: ['f'],
      bar: 'view',
      icon: 'fit',
      run: () => { stage.frame({ atOnce: false }); },
    },
    { id: 'closer', label: 'Zoom in', keys: ['canvas++', 'canvas+='], run: () => viewpoint()?.zoom(kCloser) },
    { id: 'further', label: 'Zoom out', keys: ['canvas+-'], run: () => viewpoint()?.zoom(1 / kCloser) },
    arrow('arrowleft', -1, 0),
    arrow('arrowright', 1, 0),
    arrow('arrowup', 0, 1),
    arrow('arrowdown', 0, -1),
    {
      id: 'undo',
      label: 'Undo',
      help: 'Undo, in whichever mode it was done',
      section: 'Edit',
      keys: ['ctrl+z'],
      bar: 'edit',
      icon: 'undo',
      applies: () => canUndo.value,
      // What the pointer has begun is taken back first.
      run: () => { if (!tools.cancel()) undo(); },
    },
    {
      id: 'redo',
      label: 'Redo',
      section: 'Edit',
      keys: ['ctrl+shift+z', 'ctrl+y'],
      keysShown: 'Ctrl Shift Z, Ctrl Y',
      bar: 'edit',
      icon: 'redo',
      applies: () => canRedo.value,
      run: redo,
    },
    { id: 'part before', label: 'Previous part', keys: ['['], run: () => { stepPart(-1); } },
    { id: 'part after', label: 'Next part', keys: [']'], run: () => { stepPart(1); } },
    {
      id: 'clear',
      label: `Clear all ${many}`,
      bar: 'bin',
      icon: 'clear',
      applies: () => !isEmpty(),
      run: () => {
        const id = group.peek()?.id;
        if (id !== undefined) dispatch({ type: 'clear', group: id });
      },
    },
    {
      id: 'escape',
      label: 'Cancel',
      help: room && areAllFixed(room) ? 'Cancel the work; choose nothing' : 'Cancel the stroke, the drag or the work; choose nothing',
      section: 'Edit',
      keys: ['escape'],
      run: () => {
        if (tools.cancel() || (room?.escape?.() ?? false) || endShownWork()) return;
        if (notice.peek() !== null) dismissNotice();
        else if (selection.peek().length > 0) choose();
        else tool.value = 'select';
      },
    },
    {
      id: 'open',
      label: 'Open a file',
      help: 'Open files; or drop them on the page',
      section: 'File',
      keys: ['ctrl+o'],
      bar: 'open',
      icon: 'open',
      text: 'Open',
      run: chooseFile,
    },
    {
      id: 'help',
      label: 'Keys and gestures',
      keys: ['?'],
      bar: 'help',
      icon: 'help',
      run: () => (openDialog.value = 'help'),
    },
  ];
}

/** Rows of the help sheet for what is no single action. */
export function coreHelp(room: Room): readonly HelpRow[] {
  const ofHandles: readonly HelpRow[] = [
    { section: 'Edit', keys: ', .', what: 'Previous and next vertex' },
    { section: 'Edit', keys: 'Arrows', what: 'Move what is chosen in the screen; Shift: further' },
  ];
  return [
    { section: 'View', keys: 'Wheel, pinch', what: 'Zoom' },
    { section: 'Edit', keys: '[ ]', what: `Previous and next ${room.partNoun ?? room.nouns[0]}` },
    ...(areAllFixed(room) ? [] : ofHandles),
    { section: 'Edit', keys: 'Shift click, Shift drag', what: 'Choose more; all in a box' },
  ];
}

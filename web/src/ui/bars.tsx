// The bar at the top, the tools beside the scene, and the pen's settings.
import { useEffect, useRef, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import type { PlaneKind } from '../shapes/plane.ts';
import { openFile, saveLoops, savePicture, saveSurface } from '../state/files.ts';
import { isStale, surface } from '../state/solving.ts';
import {
  canRedo,
  canUndo,
  dispatch,
  doc,
  drawing,
  isGrowing,
  mode,
  redo,
  selection,
  tool,
  undo,
  type Drawing,
  type Tool,
} from '../state/store.ts';
import { addCircle, deleteSelected } from './actions.ts';
import { linear, NumberField, Segments, type Choice } from './controls.tsx';
import { openDialog } from './dialogs.tsx';
import { Icon, Logo, type IconName } from './icons.tsx';
import { ModeSwitch, polygonModule } from './modes.tsx';

interface ButtonProps {
  readonly icon: IconName;
  readonly label: string;
  /** Shown beside the icon where there is room. */
  readonly text?: string;
  readonly keys?: string;
  readonly disabled?: boolean;
  readonly pressed?: boolean;
  readonly onClick: () => void;
}

export function IconButton({ icon, label, text, keys, disabled, pressed, onClick }: ButtonProps) {
  return (
    <button
      type="button"
      class={text ? 'icon-button with-text' : 'icon-button'}
      aria-label={label}
      aria-pressed={pressed}
      title={keys ? `${label} (${keys})` : label}
      disabled={disabled}
      onClick={onClick}
    >
      <Icon name={icon} />
      {text && <span class="button-text">{text}</span>}
    </button>
  );
}

/** The hidden file input; `chooseFile` opens the browser's dialog for it. */
let fileInput: HTMLInputElement | null = null;
export function chooseFile(): void {
  fileInput?.click();
}

export function TopBar({ stage }: { stage: Stage }) {
  return (
    <header class="top-bar">
      <h1>
        <Logo />
        <span>soapfilm</span>
      </h1>
      <ModeSwitch />
      {mode.value === 'film' ? <FilmNav stage={stage} /> : polygonModule.value && <polygonModule.value.PolygonNav />}
      {mode.value === 'film' && <span class="document-name">{doc.value.name}</span>}
      {mode.value === 'film' && (
        <IconButton icon="help" label="Keys and gestures" keys="?" onClick={() => (openDialog.value = 'help')} />
      )}
    </header>
  );
}

function FilmNav({ stage }: { stage: Stage }) {
  return (
    <nav aria-label="Document">
      <IconButton icon="gallery" label="Gallery" text="Gallery" keys="G" onClick={() => (openDialog.value = 'gallery')} />
      <IconButton icon="open" label="Open a file" text="Open" keys="Ctrl O" onClick={chooseFile} />
      <input
        ref={(element) => {
          fileInput = element;
        }}
        type="file"
        hidden
        accept=".curve,.json,.obj,.txt"
        aria-label="File of loops"
        onChange={(event) => {
          const input = event.currentTarget;
          const file = input.files?.[0];
          // So that the same file can be opened again.
          if (file) void openFile(file).finally(() => (input.value = ''));
        }}
      />
      <ExportMenu stage={stage} />
      <span class="rule" aria-hidden="true" />
      <IconButton icon="undo" label="Undo" keys="Ctrl Z" disabled={!canUndo.value} onClick={undo} />
      <IconButton icon="redo" label="Redo" keys="Ctrl Shift Z" disabled={!canRedo.value} onClick={redo} />
    </nav>
  );
}

const isMenuOpen = signal(false);

function ExportMenu({ stage }: { stage: Stage }) {
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const onPress = (event: Event) => {
      if (!root.current?.contains(event.target as Node)) isMenuOpen.value = false;
    };
    window.addEventListener('pointerdown', onPress, { capture: true });
    return () => {
      window.removeEventListener('pointerdown', onPress, { capture: true });
    };
  }, []);
  const hasSurface = surface.value !== null && !isStale.value;
  const hasCurves = doc.value.curves.length > 0;
  const items: readonly { label: string; note: string; enabled: boolean; run: () => unknown }[] = [
    { label: 'Surface', note: 'OBJ', enabled: hasSurface, run: saveSurface },
    { label: 'Curves', note: '.curve', enabled: hasCurves, run: () => saveLoops('curve') },
    { label: 'Curves', note: 'JSON', enabled: hasCurves, run: () => saveLoops('json') },
    { label: 'Picture', note: 'PNG', enabled: true, run: () => stage.view.picture().then(savePicture) },
  ];
  return (
    <div
      class="menu-root"
      ref={root}
      onKeyDown={(event) => {
        if (event.key !== 'Escape' || !isMenuOpen.peek()) return;
        isMenuOpen.value = false;
        root.current?.querySelector('button')?.focus();
        event.stopPropagation();
      }}
    >
      <button
        type="button"
        class="icon-button with-text"
        aria-label="Export"
        title="Export"
        aria-expanded={isMenuOpen.value}
        onClick={() => (isMenuOpen.value = !isMenuOpen.peek())}
      >
        <Icon name="save" />
        <span class="button-text">Export</span>
      </button>
      {isMenuOpen.value && (
        <div class="menu">
          {items.map(({ label, note, enabled, run }) => (
            <button
              key={note}
              type="button"
              disabled={!enabled}
              onClick={() => {
                isMenuOpen.value = false;
                run();
              }}
            >
              <span>{label}</span>
              <span class="muted">{note}</span>
            </button>
          ))}
        </div>
      )}
    </div>
  );
}

const kTools: readonly { id: Tool; label: string; keys: string }[] = [
  { id: 'select', label: 'Select', keys: 'V' },
  { id: 'draw', label: 'Draw', keys: 'D' },
];

export function ToolBar() {
  const hasCurves = doc.value.curves.length > 0;
  return (
    <div class="tool-bar floating" role="toolbar" aria-label="Tools" aria-orientation="vertical">
      {kTools.map(({ id, label, keys }) => (
        <IconButton
          key={id}
          icon={id}
          label={label}
          keys={keys}
          pressed={tool.value === id}
          onClick={() => (tool.value = id)}
        />
      ))}
      <IconButton icon="circle" label="Add a circle" keys="A" onClick={addCircle} />
      <span class="rule" aria-hidden="true" />
      <IconButton
        icon="trash"
        label="Delete the chosen curve"
        keys="Del"
        disabled={selection.value === null}
        onClick={deleteSelected}
      />
      <IconButton
        icon="clear"
        label="Clear all curves"
        disabled={!hasCurves}
        onClick={() => {
          dispatch({ type: 'clear' });
        }}
      />
    </div>
  );
}

export function ViewBar({ stage }: { stage: Stage }) {
  return (
    <div class="view-bar floating" role="toolbar" aria-label="View">
      {isGrowing.value ? (
        <IconButton
          icon="skip"
          label="Show the whole surface now"
          keys="Space"
          onClick={() => {
            stage.skipGrowth();
          }}
        />
      ) : (
        <IconButton
          icon="play"
          label="Let the surface appear again"
          keys="Space"
          disabled={surface.value === null}
          onClick={() => {
            stage.replay();
          }}
        />
      )}
      <IconButton
        icon="fit"
        label="All in view"
        keys="F"
        onClick={() => {
          stage.frameAll();
        }}
      />
      <IconButton
        icon="face"
        label="Face the drawing plane"
        keys="P"
        onClick={() => {
          stage.facePlane();
        }}
      />
    </div>
  );
}

const kPlanes: readonly Choice<PlaneKind>[] = [
  { value: 'xy', label: 'XY' },
  { value: 'yz', label: 'YZ' },
  { value: 'zx', label: 'ZX' },
  { value: 'view', label: 'View', title: 'Facing you, through the point that the view turns about' },
];
const kDrag: readonly Choice<Drawing['dragIn']>[] = [
  { value: 'view', label: 'Screen', title: 'Vertices move in the plane of the screen' },
  { value: 'plane', label: 'Drawing plane', title: 'Vertices move along the drawing plane' },
];

/** The settings of the tool in hand. */
export function PenBar({ stage }: { stage: Stage }) {
  // Folds on narrow screens only, where it would cover what is drawn.
  const [isFolded, setFolded] = useState(true);
  const { plane, offset, count, smoothing, dragIn } = drawing.value;
  const change = (next: Partial<Drawing>) => {
    drawing.value = { ...drawing.peek(), ...next };
  };
  const isDrawing = tool.value === 'draw';
  if (!isDrawing && selection.value === null) return null;
  const needsPlane = isDrawing || dragIn === 'plane';
  const { radius } = stage.view;
  return (
    <div class={isFolded ? 'pen-bar floating folded' : 'pen-bar floating'} role="group" aria-label={isDrawing ? 'Pen' : 'Dragging'}>
      {isDrawing && (
        <button
          type="button"
          class="icon-button pen-fold"
          aria-label="Pen settings"
          aria-expanded={!isFolded}
          onClick={() => {
            setFolded(!isFolded);
          }}
        >
          <Icon name="chevron" />
        </button>
      )}
      {!isDrawing && (
        <Segments label="Drag in" choices={kDrag} value={dragIn} onChange={(value) => { change({ dragIn: value }); }} />
      )}
      {needsPlane && (
        <Segments label="Plane" choices={kPlanes} value={plane} onChange={(value) => { change({ plane: value }); }} />
      )}
      {isDrawing && (
        <div class="stack">
          <NumberField
            label="Offset"
            title="Of the plane along its normal"
            value={offset}
            min={-Infinity}
            scale={linear(-2 * radius, 2 * radius)}
            onChange={(value) => { change({ offset: value }); }}
          />
          <NumberField
            label="Vertices"
            title="Of a drawn curve"
            value={count}
            min={3}
            max={500}
            whole
            scale={linear(6, 100)}
            onChange={(value) => { change({ count: value }); }}
          />
          <NumberField
            label="Smoothing"
            value={smoothing}
            min={0}
            max={1}
            scale={linear(0, 1)}
            onChange={(value) => { change({ smoothing: value }); }}
          />
        </div>
      )}
    </div>
  );
}

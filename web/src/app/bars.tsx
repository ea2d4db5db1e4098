// What the bars of both modes are made of.
import type { ComponentChildren } from 'preact';
import type { Signal } from '@preact/signals';
import type { History } from '../state/history.ts';
import type { Tool } from '../state/store.ts';
import { linear, NumberField } from './controls.tsx';
import { Icon, type IconName } from './icons.tsx';

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

/** The file input in the page; `chooseFile` opens the browser's dialog for it. */
let fileInput: HTMLInputElement | null = null;
export function chooseFile(): void {
  fileInput?.click();
}

interface OpenButtonProps {
  /** What the files hold. */
  readonly of: string;
  /** Their extensions, with dots and commas. */
  readonly accept: string;
  readonly open: (file: File) => Promise<void>;
}

export function OpenButton({ of, accept, open }: OpenButtonProps) {
  return (
    <>
      <IconButton icon="open" label="Open a file" text="Open" keys="Ctrl O" onClick={chooseFile} />
      <input
        ref={(element) => {
          // The one of the other mode may go only after this one has come.
          if (element) fileInput = element;
        }}
        type="file"
        hidden
        accept={accept}
        aria-label={`File of ${of}`}
        onChange={(event) => {
          const input = event.currentTarget;
          const file = input.files?.[0];
          // So that the same file can be opened again.
          if (file) void open(file).finally(() => (input.value = ''));
        }}
      />
    </>
  );
}

type Steps = Pick<History<unknown, unknown>, 'canUndo' | 'canRedo' | 'undo' | 'redo'>;

export function HistoryButtons({ of: { canUndo, canRedo, undo, redo } }: { of: Steps }) {
  return (
    <>
      <span class="rule" aria-hidden="true" />
      <IconButton icon="undo" label="Undo" keys="Ctrl Z" disabled={!canUndo.value} onClick={undo} />
      <IconButton icon="redo" label="Redo" keys="Ctrl Shift Z" disabled={!canRedo.value} onClick={redo} />
    </>
  );
}

type Deed = Pick<ButtonProps, 'label' | 'disabled' | 'onClick'>;

interface ToolBarProps {
  readonly tool: Signal<Tool>;
  /** Deletes what is chosen. */
  readonly bin: Deed;
  /** Deletes everything. */
  readonly clear: Deed;
  /** Tools that this mode alone has. */
  readonly children?: ComponentChildren;
}

const kTools: readonly { id: Tool; label: string; keys: string }[] = [
  { id: 'select', label: 'Select', keys: 'V' },
  { id: 'draw', label: 'Draw', keys: 'D' },
];

export function ToolBar({ tool, bin, clear, children }: ToolBarProps) {
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
      {children}
      <span class="rule" aria-hidden="true" />
      <IconButton icon="trash" keys="Del" {...bin} />
      <IconButton icon="clear" {...clear} />
    </div>
  );
}

interface ViewBarProps {
  /** What the space bar does as well: begins something that plays, or ends it. */
  readonly play: Deed & { readonly isOn: boolean };
  readonly frameAll: () => void;
  readonly children?: ComponentChildren;
}

export function ViewBar({ play: { isOn, ...play }, frameAll, children }: ViewBarProps) {
  return (
    <div class="view-bar floating" role="toolbar" aria-label="View">
      <IconButton icon={isOn ? 'skip' : 'play'} keys="Space" {...play} />
      <IconButton icon="fit" label="All in view" keys="F" onClick={frameAll} />
      {children}
    </div>
  );
}

interface Pen {
  readonly count: number;
  readonly smoothing: number;
}

interface PenFieldsProps {
  readonly pen: Pen;
  /** What is drawn. */
  readonly of: string;
  readonly onChange: (change: Partial<Pen>) => void;
}

/** How a stroke becomes a closed line. */
export function PenFields({ pen, of, onChange }: PenFieldsProps) {
  return (
    <>
      <NumberField
        label="Vertices"
        title={`Of a drawn ${of}`}
        value={pen.count}
        min={3}
        max={500}
        whole
        scale={linear(6, 100)}
        onChange={(count) => { onChange({ count }); }}
      />
      <NumberField
        label="Smoothing"
        value={pen.smoothing}
        min={0}
        max={1}
        scale={linear(0, 1)}
        onChange={(smoothing) => { onChange({ smoothing }); }}
      />
    </>
  );
}

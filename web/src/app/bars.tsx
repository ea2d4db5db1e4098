// Buttons made from actions, and the bars and the menu that they stand in.
import { useEffect, useRef } from 'preact/hooks';
import { signal } from '@preact/signals';
import type { Pen } from '../state/store.ts';
import { isReady, keysOf, labelOf, type Action, type Bar } from './actions.ts';
import { linear, NumberField } from './controls.tsx';
import { Icon, type IconName } from './icons.tsx';

interface ButtonProps {
  readonly icon: IconName;
  readonly label: string;
  /** Shown beside the icon where there is room. */
  readonly text?: string | undefined;
  readonly keys?: string | undefined;
  readonly disabled?: boolean;
  readonly pressed?: boolean | undefined;
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

export function ActionButton({ action }: { action: Action }) {
  const { icon = 'check', text, isOn, run } = action;
  return (
    <IconButton
      icon={typeof icon === 'string' ? icon : icon()}
      label={labelOf(action)}
      text={text}
      keys={keysOf(action)}
      disabled={!isReady(action)}
      pressed={isOn?.()}
      onClick={() => { run(); }}
    />
  );
}

export const inBar = (actions: readonly Action[], bar: Bar): readonly Action[] => actions.filter((action) => action.bar === bar);

interface BarProps {
  readonly actions: readonly Action[];
}

export function HistoryButtons({ actions }: BarProps) {
  return (
    <>
      <span class="rule" aria-hidden="true" />
      {inBar(actions, 'edit').map((action) => (
        <ActionButton key={action.id} action={action} />
      ))}
    </>
  );
}

/** Tools that can be taken in hand, what a mode adds, and below a rule what takes away. */
export function ToolBar({ actions }: BarProps) {
  const all = inBar(actions, 'tools').filter(({ isOn, applies }) => !isOn || (applies?.() ?? true));
  const isLast = ({ id }: Action) => id === 'delete' || id === 'clear';
  return (
    <div class="tool-bar floating" role="toolbar" aria-label="Tools" aria-orientation="vertical">
      {all.filter((action) => !isLast(action)).map((action) => (
        <ActionButton key={action.id} action={action} />
      ))}
      <span class="rule" aria-hidden="true" />
      {all.filter(isLast).map((action) => (
        <ActionButton key={action.id} action={action} />
      ))}
    </div>
  );
}

export function ViewBar({ actions }: BarProps) {
  return (
    <div class="view-bar floating" role="toolbar" aria-label="View">
      {inBar(actions, 'view').map((action) => (
        <ActionButton key={action.id} action={action} />
      ))}
    </div>
  );
}

const isMenuOpen = signal(false);

export function ExportMenu({ actions }: BarProps) {
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
          {inBar(actions, 'export').map((action) => (
            <button
              key={action.id}
              type="button"
              disabled={!isReady(action)}
              onClick={() => {
                isMenuOpen.value = false;
                action.run();
              }}
            >
              <span>{action.text ?? labelOf(action)}</span>
              <span class="muted">{action.note}</span>
            </button>
          ))}
        </div>
      )}
    </div>
  );
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

// Buttons made from actions, and the bars and the menu that they stand in.
import { useEffect, useRef } from 'preact/hooks';
import { signal } from '@preact/signals';
import { isReady, keysOf, labelOf, type Action, type Bar } from './actions.ts';
import { Icon, type AnyIcon } from './icons.tsx';

interface ButtonProps {
  readonly icon: AnyIcon;
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
      icon={typeof icon === 'function' ? icon() : icon}
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
  return (
    <div class="tool-bar floating" role="toolbar" aria-label="Tools" aria-orientation="vertical">
      {inBar(actions, 'tools').map((action) => (
        <ActionButton key={action.id} action={action} />
      ))}
      <span class="rule" aria-hidden="true" />
      {inBar(actions, 'bin').map((action) => (
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

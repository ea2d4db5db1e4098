// What a mode stands in: the scene with all that floats over it, and the panel beside it.
import type { ComponentChildren } from 'preact';
import { useId, useState } from 'preact/hooks';
import type { Signal } from '@preact/signals';
import { dismissNotice, mode, notice, shown, type Mode, type Shown, type Tool } from '../state/store.ts';
import { Section, Switch } from './controls.tsx';
import { Icon } from './icons.tsx';

interface FrameProps {
  readonly of: Mode;
  /** The panel's name. */
  readonly label: string;
  /** One line on how things stand: heard by screen readers, seen at the head of the panel on phones. */
  readonly summary: string;
  readonly panel: ComponentChildren;
  /** The scene and what floats over it. */
  readonly children: ComponentChildren;
}

export function Frame({ of, label, summary, panel, children }: FrameProps) {
  const id = useId();
  // On narrow screens only, where the panel is a sheet below the scene.
  const [isOpen, setOpen] = useState(false);
  const isCurrent = mode.value === of;
  return (
    <>
      <main hidden={!isCurrent}>
        <div class="viewport">
          {children}
          {isCurrent && <Toast />}
        </div>
        <aside class={isOpen ? 'panel open' : 'panel'} aria-label={label}>
          <button
            type="button"
            class="panel-handle"
            aria-expanded={isOpen}
            aria-controls={id}
            onClick={() => {
              setOpen(!isOpen);
            }}
          >
            <span>{summary}</span>
            <Icon name="chevron" />
          </button>
          <div class="panel-body" id={id}>
            {panel}
          </div>
        </aside>
      </main>
      <p class="visually-hidden" role="status" aria-live="polite">
        {isCurrent && summary}
      </p>
    </>
  );
}

/** A passing remark over the scene. */
function Toast() {
  const current = notice.value;
  return (
    <div class="toast-place" aria-live="polite">
      {current && (
        <div class={`toast floating ${current.kind}`}>
          <span>{current.text}</span>
          <button type="button" class="icon-button small" aria-label="Dismiss" onClick={dismissNotice}>
            <Icon name="close" />
          </button>
        </div>
      )}
    </div>
  );
}

interface HintProps {
  readonly tool: Signal<Tool>;
  /** What to do with the pen in hand. */
  readonly drawing: string;
  /** On the button that puts it there. */
  readonly draw: string;
  /** Other ways to begin. */
  readonly children?: ComponentChildren;
}

/** How to begin, over a scene with nothing in it. */
export function Hint({ tool, drawing, draw, children }: HintProps) {
  return (
    <div class="hint">
      {tool.value === 'draw' ? (
        <p>{drawing}</p>
      ) : (
        <>
          <p>Nothing here yet.</p>
          <div class="hint-actions">
            <button type="button" class="button primary" onClick={() => (tool.value = 'draw')}>
              {draw}
            </button>
            {children}
          </div>
        </>
      )}
    </div>
  );
}

/** Switches for what is shown, each with its label. */
export function Show({ labels }: { labels: Partial<Record<keyof Shown, string>> }) {
  return (
    <Section title="Show">
      <div class="switches">
        {(Object.keys(labels) as (keyof Shown)[]).map((key) => (
          <Switch
            key={key}
            label={labels[key] ?? key}
            checked={shown.value[key]}
            onChange={(checked) => (shown.value = { ...shown.peek(), [key]: checked })}
          />
        ))}
      </div>
    </Section>
  );
}

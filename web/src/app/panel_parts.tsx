// Parts that the panels of several modes have.
import type { ComponentChildren } from 'preact';
import type { Signal } from '@preact/signals';
import type { Work } from '../state/work.ts';
import { Section, Switch } from './controls.tsx';

/** The switches for what is shown. */
export function Show({ children }: { children: ComponentChildren }) {
  return (
    <Section title="Show">
      <div class="switches">{children}</div>
    </Section>
  );
}

interface FlagsProps<T> {
  readonly of: Signal<T>;
  /** Of the flags that have a switch. */
  readonly labels: { readonly [K in keyof T & string]?: string };
}

/** A switch for each flag that has a label. */
export function Flags<T extends { readonly [K in keyof T]: boolean }>({ of, labels }: FlagsProps<T>) {
  return (
    <>
      {Object.entries<string | undefined>(labels).map(([key, label = key]) => (
        <Switch
          key={key}
          label={label}
          checked={of.value[key as keyof T]}
          onChange={(checked) => (of.value = { ...of.peek(), [key]: checked })}
        />
      ))}
    </>
  );
}

interface TroubleProps {
  readonly work: Work;
  /** The button that begins anew. */
  readonly again?: string;
  /** What else can be done about it. */
  readonly children?: ComponentChildren;
}

/** Why work came to nothing, and the ways on; nothing where it runs or is done. */
export function Trouble({ work, again = 'Try again', children }: TroubleProps) {
  const state = work.state.value;
  if (state.phase !== 'failed' && state.phase !== 'cancelled') return null;
  const isFailed = state.phase === 'failed';
  const isMarked = isFailed && state.faults.length > 0;
  return (
    <div class={isFailed ? 'message error' : 'message'}>
      <p>{isFailed ? state.message : `${work.verb} was cancelled.`}</p>
      {isMarked && <p class="muted">The place is marked in red.</p>}
      {children}
      {/* What is marked has to be changed: the same again would fail again. */}
      {!isMarked && (
        <button type="button" class="button small" onClick={work.start}>
          {again}
        </button>
      )}
    </div>
  );
}

interface ExamplesProps<E> {
  readonly of: readonly E[];
  readonly open: (example: E) => void;
}

/** A button for each example. */
export function Examples<E extends { readonly title: string }>({ of, open }: ExamplesProps<E>) {
  return (
    <Section title="Examples">
      <div class="pairs">
        {of.map((example) => (
          <button key={example.title} type="button" class="button" onClick={() => { open(example); }}>
            {example.title}
          </button>
        ))}
      </div>
    </Section>
  );
}

export function Row(props: { name: string; value: string }) {
  return (
    <div>
      <dt>{props.name}</dt>
      <dd>{props.value}</dd>
    </div>
  );
}

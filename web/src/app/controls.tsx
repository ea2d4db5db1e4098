// The panel's building blocks: a choice among few, a number with its slider, a switch.
import type { ComponentChildren } from 'preact';
import { useId, useState } from 'preact/hooks';

export interface Choice<T extends string | number> {
  readonly value: T;
  readonly label: string;
  readonly title?: string;
}

interface SegmentsProps<T extends string | number> {
  readonly label: string;
  readonly choices: readonly Choice<T>[];
  /** Null: none of them. */
  readonly value: T | null;
  readonly onChange: (value: T) => void;
  readonly hideLabel?: boolean;
}

/** A row of radio buttons. */
export function Segments<T extends string | number>(props: SegmentsProps<T>) {
  const id = useId();
  return (
    <fieldset class="field">
      <legend class={props.hideLabel ? 'visually-hidden' : 'label'}>{props.label}</legend>
      <div class="segments">
        {props.choices.map(({ value, label, title }) => (
          <label class="segment" title={title} key={value}>
            <input
              type="radio"
              name={id}
              value={value}
              checked={props.value === value}
              onChange={() => {
                props.onChange(value);
              }}
            />
            <span>{label}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

interface NumberFieldProps {
  readonly label: string;
  readonly title?: string;
  readonly value: number;
  readonly min: number;
  /** Largest value of the number field; absent: none. */
  readonly max?: number;
  readonly whole?: boolean;
  /** How the slider's travel (0 to 1) maps to values. */
  readonly scale: Scale;
  /** `passing`: more is likely to follow, as while a slider is dragged. */
  readonly onChange: (value: number, passing: boolean) => void;
}

export interface Scale {
  toShare(value: number): number;
  toValue(share: number): number;
}

export const linear = (from: number, to: number): Scale => ({
  toShare: (value) => (value - from) / (to - from),
  toValue: (share) => from + share * (to - from),
});

/** 0 at the very left, then decades from `from` to `to`. */
export const decades = (from: number, to: number): Scale => {
  const range = Math.log10(to / from);
  return {
    toShare: (value) => (value <= 0 ? 0 : 0.04 + 0.96 * (Math.log10(value / from) / range)),
    toValue: (share) => (share < 0.02 ? 0 : from * 10 ** (range * Math.max(0, (share - 0.04) / 0.96))),
  };
};

const kTravel = 200;

/** Three significant digits, as a number. */
const tidy = (value: number): number => Number(value.toPrecision(3));

/** A slider and a number field for one value. */
export function NumberField(props: NumberFieldProps) {
  const id = useId();
  // What is being typed, while it is not yet a valid number.
  const [draft, setDraft] = useState<string | null>(null);
  const { value, scale, min, max } = props;
  const share = Math.min(1, Math.max(0, scale.toShare(value)));
  const take = (raw: number, passing: boolean) => {
    const bounded = Math.max(min, Math.min(max ?? Infinity, props.whole ? Math.round(raw) : tidy(raw)));
    props.onChange(bounded === 0 ? 0 : bounded, passing);
  };
  return (
    <div class="number-field" title={props.title}>
      <label class="label" for={id}>
        {props.label}
      </label>
      <input
        type="range"
        min={0}
        max={kTravel}
        step={1}
        value={Math.round(share * kTravel)}
        style={{ '--share': `${share * 100}%` }}
        aria-label={`${props.label}, slider`}
        aria-valuetext={String(tidy(value))}
        onInput={(event) => {
          take(scale.toValue(event.currentTarget.valueAsNumber / kTravel), true);
        }}
        onChange={(event) => {
          take(scale.toValue(event.currentTarget.valueAsNumber / kTravel), false);
        }}
      />
      <input
        id={id}
        type="text"
        inputMode="decimal"
        autocomplete="off"
        value={draft ?? String(tidy(value))}
        aria-invalid={draft !== null && !isNumber(draft)}
        onInput={(event) => {
          setDraft(event.currentTarget.value);
        }}
        onBlur={() => {
          if (draft !== null && isNumber(draft)) take(Number(draft), false);
          setDraft(null);
        }}
        onKeyDown={(event) => {
          if (event.key === 'Enter') {
            if (draft !== null && isNumber(draft)) take(Number(draft), false);
            setDraft(null);
          } else if (event.key === 'Escape' && draft !== null) {
            setDraft(null);
            event.stopPropagation();
          }
        }}
      />
    </div>
  );
}

const isNumber = (text: string): boolean => text.trim() !== '' && Number.isFinite(Number(text));

interface SwitchProps {
  readonly label: string;
  readonly title?: string;
  readonly checked: boolean;
  readonly onChange: (checked: boolean) => void;
}

export function Switch({ label, title, checked, onChange }: SwitchProps) {
  return (
    <label class="switch" title={title}>
      <input
        type="checkbox"
        role="switch"
        checked={checked}
        onChange={(event) => {
          onChange(event.currentTarget.checked);
        }}
      />
      <span class="switch-track" aria-hidden="true" />
      <span>{label}</span>
    </label>
  );
}

export function Section(props: { title: string; aside?: ComponentChildren; children: ComponentChildren }) {
  const id = useId();
  return (
    <section class="section" aria-labelledby={id}>
      <div class="section-head">
        <h2 id={id}>{props.title}</h2>
        {props.aside}
      </div>
      {props.children}
    </section>
  );
}

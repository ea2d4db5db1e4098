// Parts that the panels of several modes have.
import { shown, type Shown } from '../state/store.ts';
import { Section, Switch } from './controls.tsx';

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

export function Row(props: { name: string; value: string }) {
  return (
    <div>
      <dt>{props.name}</dt>
      <dd>{props.value}</dd>
    </div>
  );
}

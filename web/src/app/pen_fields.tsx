// How a stroke becomes a closed line, as fields.
import type { Pen } from '../state/store.ts';
import { linear, NumberField } from './controls.tsx';

interface PenFieldsProps {
  readonly pen: Pen;
  /** What is drawn. */
  readonly of: string;
  readonly onChange: (change: Partial<Pen>) => void;
}

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

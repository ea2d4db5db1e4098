// The settings of the tool in hand, in modes that are in space: the plane, and how a stroke becomes a line.
import { useState } from 'preact/hooks';
import type { Signal } from '@preact/signals';
import type { PlaneKind } from '../shapes/plane.ts';
import { chosen, drawingPlane, tool, type DrawingPlane, type Pen } from '../state/store.ts';
import { linear, NumberField, Segments, type Choice } from './controls.tsx';
import { Icon } from './icons.tsx';
import { PenFields } from './pen_fields.tsx';

const kPlanes: readonly Choice<PlaneKind>[] = [
  { value: 'xy', label: 'XY' },
  { value: 'yz', label: 'YZ' },
  { value: 'zx', label: 'ZX' },
  { value: 'view', label: 'View', title: 'Facing you, through the point that the view turns about' },
];
const kDrag: readonly Choice<DrawingPlane['dragIn']>[] = [
  { value: 'view', label: 'Screen', title: 'What is chosen moves in the plane of the screen' },
  { value: 'plane', label: 'Drawing plane', title: 'What is chosen moves along the drawing plane' },
];

interface PenBarProps {
  readonly pen: Signal<Pen>;
  /** What is drawn. */
  readonly of: string;
  /** Of what is in view. */
  readonly radius: () => number;
}

export function PenBar({ pen, of, radius }: PenBarProps) {
  // Folds on narrow screens only, where it would cover what is drawn.
  const [isFolded, setFolded] = useState(true);
  const { plane, offset, dragIn } = drawingPlane.value;
  const change = (next: Partial<DrawingPlane>) => {
    drawingPlane.value = { ...drawingPlane.peek(), ...next };
  };
  const isDrawing = tool.value === 'draw';
  if (!isDrawing && chosen.value === null) return null;
  const reach = 2 * radius();
  const needsPlane = isDrawing || dragIn === 'plane';
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
            scale={linear(-reach, reach)}
            onChange={(value) => { change({ offset: value }); }}
          />
          <PenFields pen={pen.value} of={of} onChange={(next) => (pen.value = { ...pen.peek(), ...next })} />
        </div>
      )}
    </div>
  );
}

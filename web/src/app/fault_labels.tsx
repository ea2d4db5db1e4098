// What is wrong, in words beside the object concerned.
import { useEffect, useState } from 'preact/hooks';
import { distanceOf, type Projected, type Spot } from '../scene/eye.ts';
import type { Stage } from '../scene/stage.ts';
import type { Point } from '../shapes/vec.ts';
import { handlesAt, kindOf } from '../state/document.ts';
import { itemBy } from '../state/store.ts';
import type { Failure } from '../state/work.ts';

/** More, or closer together, would hide what they are about; the panel lists them. In CSS pixels. */
const kMost = 3;
/** Of thousands no more than the first so many are looked at, each time that the view moves. */
const kMostTried = 200;
const kApart = 90;
/** What a label may need to the right of its place and below it, in CSS pixels. */
const kRoom = [280, 90] as const;

interface FaultLabelsProps {
  readonly stage: Stage;
  readonly failures: readonly Failure[];
}

export function FaultLabels({ stage, failures }: FaultLabelsProps) {
  const [, setMoved] = useState(0);
  const isNeeded = failures.length > 0;
  useEffect(() => {
    if (!isNeeded) return;
    return stage.view.onCamera(() => {
      setMoved((count) => count + 1);
    });
  }, [stage, isNeeded]);
  const labels: { readonly failure: Failure; readonly at: Spot }[] = [];
  for (const failure of failures.slice(0, kMostTried)) {
    const at = placeOf(stage, failure);
    if (at && labels.length < kMost && labels.every((other) => distanceOf(other.at, at) > kApart)) labels.push({ failure, at });
  }
  const [width, height] = stage.view.size;
  return (
    <div class="fault-labels" aria-hidden="true">
      {labels.map(({ failure, at }, i) => (
        <span
          key={i}
          class="fault-label"
          style={{
            left: `${Math.min(at.x, Math.max(0, width - kRoom[0])).toFixed(0)}px`,
            ...(at.y < height - kRoom[1] ? { top: `${at.y.toFixed(0)}px` } : { bottom: `${(height - at.y).toFixed(0)}px` }),
          }}
        >
          {failure.message}
        </span>
      ))}
    </div>
  );
}

/** Where a failure lies on the canvas; null where that is not known or out of view. */
function placeOf(stage: Stage, { point, faults }: Failure): Projected | null {
  const where = point ?? pointOf(faults.at(0));
  const viewpoint = stage.current.peek()?.viewpoint;
  if (!where || !viewpoint) return null;
  const at = viewpoint.project(where);
  const [width, height] = stage.view.size;
  return at.visible && at.x >= 0 && at.x <= width && at.y >= 0 && at.y <= height ? at : null;
}

function pointOf(fault: Failure['faults'][number] | undefined): Point | null {
  const item = fault && itemBy(fault.place.item);
  if (!item) return null;
  const kind = kindOf(item);
  const handle = handlesAt(kind, item.shape, fault.place).at(0);
  return handle === undefined || handle >= kind.partStarts(item.shape)[kind.partStarts(item.shape).length - 1]
    ? null
    : kind.handleAt(item.shape, handle);
}

// What is wrong, in words beside the object concerned.
import { useEffect, useState } from 'preact/hooks';
import type { Projected } from '../scene/eye.ts';
import type { Stage } from '../scene/stage.ts';
import type { Point } from '../shapes/vec.ts';
import { handlesAt, kindOf } from '../state/document.ts';
import { itemBy } from '../state/store.ts';
import type { Failure } from '../state/work.ts';

/** More would hide what they are about; the panel lists them. */
const kMost = 3;

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
  const labels = failures.slice(0, kMost).flatMap((failure) => {
    const at = placeOf(stage, failure);
    return at ? [{ failure, at }] : [];
  });
  return (
    <div class="fault-labels" aria-hidden="true">
      {labels.map(({ failure, at }, i) => (
        <div key={i} class="fault-label" style={{ transform: `translate(${at.x.toFixed(0)}px, ${at.y.toFixed(0)}px)` }}>
          <span>{failure.message}</span>
        </div>
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

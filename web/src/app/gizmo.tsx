// The axes as the eye stands to them; pressing one looks along it.
// Own drawing instead of three's ViewHelper, which takes y as up and cannot be reached by keyboard.
import { useEffect, useRef } from 'preact/hooks';
import type { View } from '../scene/view.ts';
import type { Viewpoint } from '../scene/viewpoint.ts';
import { dot, type Point } from '../shapes/vec.ts';

const kAxes: readonly { name: string; label: string; direction: Point }[] = [
  { name: 'x', label: 'X', direction: [1, 0, 0] },
  { name: 'y', label: 'Y', direction: [0, 1, 0] },
  { name: 'z', label: 'Z', direction: [0, 0, 1] },
  { name: 'x', label: '', direction: [-1, 0, 0] },
  { name: 'y', label: '', direction: [0, -1, 0] },
  { name: 'z', label: '', direction: [0, 0, -1] },
];
const kReach = 34;

interface GizmoProps {
  readonly view: View;
  readonly viewpoint: () => Viewpoint | undefined;
}

export function Gizmo({ view, viewpoint }: GizmoProps) {
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const place = () => {
      const now = viewpoint();
      if (now === undefined) return;
      const { right, up, toViewer } = now.axes();
      kAxes.forEach(({ direction }, i) => {
        const [x, y] = [kReach * dot(direction, right), -kReach * dot(direction, up)];
        const near = dot(direction, toViewer);
        const ball = root.current?.querySelector<HTMLElement>(`[data-axis="${i}"]`);
        ball?.style.setProperty('transform', `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`);
        ball?.style.setProperty('z-index', String(Math.round(10 + 9 * near)));
        ball?.style.setProperty('--near', (0.5 + 0.5 * near).toFixed(2));
        const line = root.current?.querySelector(`[data-line="${i}"]`);
        line?.setAttribute('x2', x.toFixed(1));
        line?.setAttribute('y2', y.toFixed(1));
      });
    };
    place();
    return view.onCamera(place);
  }, [view]);
  return (
    <div class="gizmo" ref={root} role="group" aria-label="Look along an axis">
      <svg viewBox="-50 -50 100 100" aria-hidden="true">
        {kAxes.map(({ name: axis, label }, i) => label && <line key={i} data-line={i} class={`axis-${axis}`} x1="0" y1="0" />)}
      </svg>
      {kAxes.map(({ name: axis, label, direction }, i) => (
        <button
          key={i}
          type="button"
          data-axis={i}
          class={`ball axis-${axis} ${label ? 'positive' : 'negative'}`}
          aria-label={`Look from ${label ? 'plus' : 'minus'} ${axis}`}
          onClick={() => {
            viewpoint()?.lookFrom(direction);
          }}
        >
          {label}
        </button>
      ))}
    </div>
  );
}

// How the world appears on the canvas: what picking and dragging need of the view. Places are in CSS pixels from the
// canvas's top left.
import type { Box, Point } from '../shapes/vec.ts';

export interface Spot {
  readonly x: number;
  readonly y: number;
}

export interface Projected extends Spot {
  /** Whether the point lies before the eye. */
  readonly visible: boolean;
}

export interface Eye {
  project(point: Point): Projected;
  /** The ray through a place. */
  ray(x: number, y: number): { readonly from: Point; readonly direction: Point };
  /** World units a pixel, at a point. */
  pixelSize(at: Point): number;
  /** The screen's axes in the world. */
  axes(): { readonly right: Point; readonly up: Point; readonly toViewer: Point };
}

export const distanceOf = (a: Spot, b: Spot): number => Math.hypot(a.x - b.x, a.y - b.y);

/** How far along the segment from `a` to `b` its point nearest to a place is: 0 to 1. */
export function shareAlong({ x, y }: Spot, a: Spot, b: Spot): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  return Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1)));
}

/** Whether something in a box may be within reach of a place. */
export function isBoxNear({ low, high }: Box, eye: Eye, at: Spot, reach: number): boolean {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let corner = 0; corner < 8; corner++) {
    const p = eye.project([
      corner & 1 ? high[0] : low[0],
      corner & 2 ? high[1] : low[1],
      corner & 4 ? high[2] : low[2],
    ]);
    if (!p.visible) return true;
    [left, right] = [Math.min(left, p.x), Math.max(right, p.x)];
    [top, bottom] = [Math.min(top, p.y), Math.max(bottom, p.y)];
  }
  return at.x >= left - reach && at.x <= right + reach && at.y >= top - reach && at.y <= bottom + reach;
}

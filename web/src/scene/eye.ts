// How the world appears on the canvas: what picking and dragging need of the view. Places are in CSS pixels from the
// canvas's top left.
import type { Point } from '../shapes/vec.ts';

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

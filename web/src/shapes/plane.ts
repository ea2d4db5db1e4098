// Drawing planes: a frame of two axes in space, and the map between the plane and the world.
import { add, cross, dot, normalize, scale, subtract, type Point } from './vec.ts';

export type PlaneKind = 'xy' | 'yz' | 'zx' | 'view';
export type Point2 = readonly [u: number, v: number];

/** An orthonormal frame: `u` × `v` = `normal`. */
export interface Frame {
  readonly origin: Point;
  readonly u: Point;
  readonly v: Point;
  readonly normal: Point;
}

const kAxes: Record<Exclude<PlaneKind, 'view'>, readonly [u: Point, v: Point]> = {
  xy: [[1, 0, 0], [0, 1, 0]],
  yz: [[0, 1, 0], [0, 0, 1]],
  zx: [[0, 0, 1], [1, 0, 0]],
};

/** The coordinate plane moved by `offset` along its normal. */
export function coordinatePlane(kind: Exclude<PlaneKind, 'view'>, offset: number): Frame {
  const [u, v] = kAxes[kind];
  const normal = cross(u, v);
  return { origin: scale(normal, offset), u, v, normal };
}

/** The plane facing a viewer: `right` and `up` are the screen's axes; the offset is towards the viewer. */
export function viewPlane(through: Point, right: Point, up: Point, offset: number): Frame {
  const normal = normalize(cross(right, up));
  return { origin: add(through, scale(normal, offset)), u: right, v: up, normal };
}

export function toPlane(frame: Frame, point: Point): Point2 {
  const d = subtract(point, frame.origin);
  return [dot(d, frame.u), dot(d, frame.v)];
}

export function fromPlane(frame: Frame, point: Point2): Point {
  return add(frame.origin, add(scale(frame.u, point[0]), scale(frame.v, point[1])));
}

/** Where a ray meets the plane; null where it runs along the plane or away from it. */
export function meetPlane(frame: Frame, from: Point, direction: Point): Point | null {
  const slope = dot(direction, frame.normal);
  // Below about 3° the hit point races off to the horizon and a stroke would explode.
  if (Math.abs(slope) < 0.05 * Math.hypot(...direction)) return null;
  const t = dot(subtract(frame.origin, from), frame.normal) / slope;
  return t > 0 ? add(from, scale(direction, t)) : null;
}

/** A regular polygon of `count` vertices around a point of the plane. */
export function circleInPlane(frame: Frame, center: Point2, radius: number, count: number): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const t = (2 * Math.PI * i) / count;
    return fromPlane(frame, [center[0] + radius * Math.cos(t), center[1] + radius * Math.sin(t)]);
  });
}

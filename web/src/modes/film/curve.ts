// The kind of object that films are made of: a closed curve in space.
import { lineKind, pointsOfLine } from '../../scene/line_kind.ts';
import { pointCount, without } from '../../shapes/lines.ts';

export const kCurve = lineKind({
  name: 'curve',
  dim: 3,
  style: { width: 3, chosenWidth: 3.8, dot: 7.5, chosenDot: 13, hoverDot: 11, hasRim: true, mostDots: Infinity },
  pointsAt: (curve, { handle }) => (handle === null ? pointsOfLine(curve, 0) : [handle]),
  remove: (curve, places) => {
    if (places.some(({ handle }) => handle === null)) return null;
    const left = without(curve, new Set(places.flatMap(({ handle }) => handle ?? [])));
    return pointCount(left) > 0 ? left : null;
  },
});

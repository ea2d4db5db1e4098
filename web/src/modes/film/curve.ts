// The kind of object that films are made of: a closed curve in space.
import { lineKind } from '../../scene/line_kind.ts';

export const kCurve = lineKind({
  name: 'curve',
  dim: 3,
  style: { width: 3, chosenWidth: 3.8, dot: 7.5, chosenDot: 13, hoverDot: 11, hasRim: true, mostDots: Infinity },
});

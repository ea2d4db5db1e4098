// Polygons with holes in the plane, as objects of the document: line 0 is the outer ring, all others are holes.
import { lineKind } from '../../scene/line_kind.ts';
import { lineCount, pointCount, type Lines } from '../../shapes/lines.ts';
import type { Box, Point } from '../../shapes/vec.ts';
import { boxOfItem, type Group, type Item } from '../../state/document.ts';
import { groupOf } from '../../state/store.ts';
import type { PolygonOptions } from 'soapfilm';

/** The name of the mode, and of the kind of its objects. */
export const kMode = 'polygon';
export const kPolygon = 'polygon';

export type PolygonSettings = Required<Pick<PolygonOptions, 'method' | 'output' | 'quality' | 'repair'>>;
export type PolygonGroup = Group<PolygonSettings>;

/** Whether the library takes such settings. */
export function arePolygonSettings({ method, output, quality, repair }: PolygonSettings): boolean {
  return (
    ['flooding', 'trapezoids'].includes(method) &&
    ['triangles', 'strips'].includes(output) &&
    ['fast', 'delaunay'].includes(quality) &&
    ['none', 'even-odd', 'nonzero'].includes(repair)
  );
}

export const kSettings: PolygonSettings = { method: 'flooding', output: 'triangles', quality: 'fast', repair: 'none' };

/** The polygons of the document. */
export const polygonGroup = groupOf(kMode, kSettings);

export const polygonKind = lineKind({
  name: kPolygon,
  dim: 2,
  style: { width: 2, chosenWidth: 3, dot: 6, chosenDot: 12, hoverDot: 9, hasRim: false, mostDots: 4000 },
});

/** The polygon with one more hole. */
export function withHole({ dim, positions, starts }: Lines, hole: readonly Point[]): Lines {
  const n = starts[starts.length - 1];
  const longer = new Float64Array(positions.length + dim * hole.length);
  longer.set(positions);
  hole.forEach(([x, y], i) => {
    longer.set([x, y], dim * (n + i));
  });
  return { dim, positions: longer, starts: Uint32Array.from([...starts, n + hole.length]) };
}

/** The first polygon whose outer ring has one of the points inside. */
export function hostOf(items: readonly Item[], points: readonly Point[]): Item | undefined {
  return items.find((item) => {
    const box = boxOfItem(item);
    return points.some((point) => isInBox(point, box) && isInside(point, item.shape as Lines));
  });
}

const isInBox = ([x, y]: Point, { low, high }: Box): boolean => x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1];

/** Whether a point is inside the outer ring of a polygon. */
function isInside([x, y]: Point, { positions, starts }: Lines): boolean {
  let inside = false;
  for (let i = 0, before = starts[1] - 1; i < starts[1]; before = i++) {
    const [ax, ay, bx, by] = [positions[2 * before], positions[2 * before + 1], positions[2 * i], positions[2 * i + 1]];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  }
  return inside;
}

/** All polygons of a group as flat arrays, in the form that the library takes; the arrays are new. */
export interface FlatPolygons {
  readonly positions: Float64Array;
  readonly ringStarts: Uint32Array;
  readonly polygonStarts: Uint32Array;
}

export function flatten(items: readonly Item[]): FlatPolygons {
  let [vertices, rings] = [0, 0];
  for (const { shape } of items) {
    vertices += pointCount(shape as Lines);
    rings += lineCount(shape as Lines);
  }
  const positions = new Float64Array(2 * vertices);
  const ringStarts = new Uint32Array(rings + 1);
  const polygonStarts = new Uint32Array(items.length + 1);
  let [vertex, ring] = [0, 0];
  items.forEach(({ shape }, p) => {
    const lines = shape as Lines;
    positions.set(lines.positions, 2 * vertex);
    for (let r = 1; r < lines.starts.length; r++) ringStarts[++ring] = vertex + lines.starts[r];
    vertex += pointCount(lines);
    polygonStarts[p + 1] = ring;
  });
  return { positions, ringStarts, polygonStarts };
}

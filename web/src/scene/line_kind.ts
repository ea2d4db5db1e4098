// Kinds of objects that are closed lines with their points as handles: curves, polygons with holes.
import { Group, type Object3D } from 'three';
import { boxOfLines, lineCount, lineOf, moved, nextPoint, pointAt, pointCount, readLines, without, type Lines } from '../shapes/lines.ts';
import { add, scale, subtract } from '../shapes/vec.ts';
import type { Id, Item, Place } from '../state/document.ts';
import { Dots } from './dots.ts';
import { distanceOf, shareAlong, type Eye, type Projected, type Spot } from './eye.ts';
import { FatLines, segmentsOf } from './fat_line.ts';
import { areSame, type Drawn, type DrawnKind, type Hit, type Layer, type Marks } from './kind.ts';

/** How lines and handles look, in CSS pixels. */
export interface LineStyle {
  readonly width: number;
  readonly chosenWidth: number;
  readonly dot: number;
  readonly chosenDot: number;
  readonly hoverDot: number;
  readonly hasRim: boolean;
  /** More handles than this are shown only where they are marked. */
  readonly mostDots: number;
}

interface LineKindOptions {
  readonly name: string;
  readonly dim: 2 | 3;
  readonly style: LineStyle;
}

/** A line's reach, as a share of a handle's. */
const kLineReach = 0.6;

/** The first line carries the others, as the outer ring of a polygon does: as a whole it is moved and removed with them. */
export function lineKind({ name, dim, style }: LineKindOptions): DrawnKind<Lines> {
  return {
    name,
    boxOf: boxOfLines,
    partStarts: ({ starts }) => starts,
    handleAt: pointAt,
    move: (lines, places, by) => moved(lines, new Set(places.flatMap((place) => pointsAt(lines, place))), by),
    remove: (lines, places) => {
      const whole = places.flatMap(({ part, handle }) => (handle === null ? part : []));
      return without(lines, new Set(places.flatMap(({ handle }) => handle ?? [])), new Set(whole));
    },
    read: (saved) => readLines(dim, saved),
    pick: pickLines,
    makeLayer: () => new LinesLayer(style),
  };
}

/** The points that move with a place. */
function pointsAt(lines: Lines, { part, handle }: Place): number[] {
  if (handle !== null) return [handle];
  const [from, to] = part === 0 ? [0, pointCount(lines)] : [lines.starts[part], lines.starts[part + 1]];
  return Array.from({ length: to - from }, (_, i) => from + i);
}

function pickLines(lines: Lines, eye: Eye, at: Spot, reach: number): Hit | null {
  const projected: Projected[] = [];
  let best: Hit | null = null;
  for (let i = 0; i < pointCount(lines); i++) {
    const point = pointAt(lines, i);
    const p = eye.project(point);
    projected.push(p);
    const distance = p.visible ? distanceOf(p, at) : Infinity;
    if (distance < (best?.distance ?? reach)) best = { part: lineOf(lines, i), handle: i, distance, point };
  }
  if (best !== null) return best;
  for (let line = 0; line < lineCount(lines); line++) {
    for (let i = lines.starts[line]; i < lines.starts[line + 1]; i++) {
      const next = nextPoint(lines, line, i);
      const [a, b] = [projected[i], projected[next]];
      if (!a.visible || !b.visible) continue;
      const share = shareAlong(at, a, b);
      const on = { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
      const distance = distanceOf(on, at) / kLineReach;
      if (distance >= (best?.distance ?? reach)) continue;
      const [from, to] = [pointAt(lines, i), pointAt(lines, next)];
      best = { part: line, handle: null, distance, point: add(from, scale(subtract(to, from), share)) };
    }
  }
  return best;
}

const linesIn = (item: Item): Lines => item.shape as Lines;

class LinesLayer implements Layer {
  readonly object: Object3D = new Group();
  private readonly all = new FatLines();
  private readonly marked = new FatLines();
  private readonly dots: Dots;
  /** What `all` shows, and how. */
  private shown: { items: readonly Item[]; drawn: Drawn } | null = null;

  constructor(private readonly style: LineStyle) {
    this.dots = new Dots(style.hasRim);
    this.object.add(this.all.object, this.marked.object, this.dots.object);
  }

  update(items: readonly Item[], marks: Marks, drawn: Drawn): void {
    const { curves } = drawn.theme;
    const { shown } = this;
    const isSame = shown?.drawn.placement === drawn.placement && shown.drawn.theme === drawn.theme && areSame(shown.items, items);
    if (!isSame) {
      this.all.clear();
      this.all.put(segmentsOf(items.map(linesIn), drawn.placement), { color: curves.line, width: this.style.width });
      this.shown = { items, drawn };
    }
    const byId = new Map(items.map((item) => [item.id, item]));
    this.markLines(byId, marks, drawn);
    this.markPoints(items, byId, marks, drawn);
  }

  private markLines(byId: ItemsById, { selection, hover, faults }: Marks, { placement, theme }: Drawn): void {
    const { curves } = theme;
    const { width, chosenWidth } = this.style;
    this.marked.clear();
    const mark = (places: readonly Place[], color: string, lineWidth: number, order: number): void => {
      // Thousands of handles may be chosen on one line.
      const lines = new Map<string, Lines>();
      for (const { item: id, part } of places) {
        const key = `${id} ${part}`;
        const item = lines.has(key) ? undefined : byId.get(id);
        if (item) lines.set(key, lineIn(linesIn(item), part));
      }
      if (lines.size > 0) this.marked.put(segmentsOf([...lines.values()], placement), { color, width: lineWidth, order });
    };
    if (hover) mark([hover], curves.line, chosenWidth, 0);
    mark(selection, curves.selected, chosenWidth, 1);
    mark(faults.flatMap(({ place }) => (place.handle === null ? place : [])), curves.fault, chosenWidth, 1);
    const edges = faults.flatMap(({ place: { item: id, part, handle }, isEdge }) => {
      const item = byId.get(id);
      return (isEdge && handle !== null && item && edgeIn(linesIn(item), part, handle)) || [];
    });
    if (edges.length > 0) this.marked.put(segmentsOf(edges, placement), { color: curves.fault, width: width + 3, isOnTop: true, order: 1 });
  }

  private markPoints(items: readonly Item[], byId: ItemsById, marks: Marks, { placement, pixelRatio, theme }: Drawn): void {
    const { curves } = theme;
    const { dot, chosenDot, hoverDot, mostDots } = this.style;
    const dots = this.dots.begin(placement);
    const count = items.reduce((sum, item) => sum + pointCount(linesIn(item)), 0);
    if (marks.vertices && count <= mostDots) {
      const chosen = new Set(marks.selection.map(({ item, part }) => `${item} ${part}`));
      for (const item of items) {
        const lines = linesIn(item);
        for (let line = 0; line < lineCount(lines); line++) {
          const color = chosen.has(`${item.id} ${line}`) ? curves.selected : curves.line;
          for (let i = lines.starts[line]; i < lines.starts[line + 1]; i++) dots.put(pointAt(lines, i), color, dot);
        }
      }
    }
    const mark = ({ item: id, handle }: Place, color: string, diameter: number): void => {
      const item = handle === null ? undefined : byId.get(id);
      if (item && handle !== null && handle < pointCount(linesIn(item))) dots.put(pointAt(linesIn(item), handle), color, diameter);
    };
    if (marks.hover) mark(marks.hover, curves.selected, hoverDot);
    for (const place of marks.selection) mark(place, curves.selected, chosenDot);
    for (const { place, isEdge } of marks.faults) if (!isEdge) mark(place, curves.fault, chosenDot + 1);
    this.dots.show(pixelRatio, curves.rim);
  }
}

type ItemsById = ReadonlyMap<Id, Item>;

/** One line of several, by itself. */
function lineIn(lines: Lines, line: number): Lines {
  const { dim, positions, starts } = lines;
  const [from, to] = [starts[line] ?? 0, starts[line + 1] ?? 0];
  return { dim, positions: positions.subarray(dim * from, dim * to), starts: new Uint32Array([0, to - from]) };
}

/** The edge from a point to the next in its line, there and back. */
function edgeIn(lines: Lines, line: number, i: number): Lines | null {
  const { dim, positions, starts } = lines;
  if (line + 1 >= starts.length || i >= starts[line + 1]) return null;
  const ends = [i, nextPoint(lines, line, i)].flatMap((v) => [...positions.subarray(dim * v, dim * (v + 1))]);
  return { dim, positions: new Float64Array(ends), starts: new Uint32Array([0, 2]) };
}

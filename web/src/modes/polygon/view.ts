// The drawing of polygons: a 2D canvas that follows the state, and the map between it and the plane.
import { effect } from '@preact/signals';
import type { Point2 } from '../shapes/plane.ts';
import {
  flooding,
  floodOn,
  polygonDoc,
  selectedRing,
  triangulated,
  type Polygon,
  type RingPlace,
  type Triangulated,
} from '../state/polygon.ts';
import { shown } from '../state/store.ts';
import { readTheme } from './theme.ts';

/** Colours of strips, by turns; so many that neighbours hardly ever share one. */
const kHues = 24;
/** More vertices than this are not dotted. */
const kMostDots = 4000;
const kFloodFrames = 300;
/** What the bar of tools covers at the side, in CSS pixels. */
const kToolBar = 72;

export class PolygonView {
  /** The plane's point in the middle, and CSS pixels a unit. */
  private center: Point2 = [0, 0];
  private scale = 60;
  private wanted = 0;
  /** The canvas's lesser extent, in CSS pixels. */
  private extent = 0;
  /** The stroke that is being drawn. */
  stroke: readonly Point2[] = [];

  constructor(readonly canvas: HTMLCanvasElement) {
    const redraw = (): void => {
      this.invalidate();
    };
    new ResizeObserver(() => {
      this.resize();
    }).observe(canvas);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    for (const state of [polygonDoc, triangulated, selectedRing, shown, flooding]) state.subscribe(redraw);
    effect(() => {
      if (flooding.value) requestAnimationFrame(() => {
        const now = flooding.peek();
        if (now) floodOn(Math.ceil(now.steps.length / kFloodFrames));
      });
    });
  }

  invalidate(): void {
    if (this.wanted === 0) this.wanted = requestAnimationFrame(() => {
      this.wanted = 0;
      this.draw();
    });
  }

  /** What was in view stays so, as when the panel opens below the canvas. */
  private resize(): void {
    const extent = Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
    // It has no size while the page is in its other mode.
    if (extent === 0) return;
    if (this.extent > 0) this.scale *= extent / this.extent;
    this.extent = extent;
    this.invalidate();
  }

  toScreen([x, y]: Point2): Point2 {
    const { clientWidth, clientHeight } = this.canvas;
    return [clientWidth / 2 + (x - this.center[0]) * this.scale, clientHeight / 2 - (y - this.center[1]) * this.scale];
  }
  toPlane([x, y]: Point2): Point2 {
    const { clientWidth, clientHeight } = this.canvas;
    return [this.center[0] + (x - clientWidth / 2) / this.scale, this.center[1] - (y - clientHeight / 2) / this.scale];
  }
  /** CSS pixels as a length in the plane. */
  lengthOf(pixels: number): number {
    return pixels / this.scale;
  }

  /** Moves the drawing by CSS pixels. */
  pan(right: number, down: number): void {
    this.center = [this.center[0] - right / this.scale, this.center[1] + down / this.scale];
    this.invalidate();
  }
  /** Enlarges the drawing about a point of the canvas. */
  zoom(factor: number, about: Point2): void {
    const fixed = this.toPlane(about);
    this.scale *= factor;
    const now = this.toPlane(about);
    this.center = [this.center[0] + fixed[0] - now[0], this.center[1] + fixed[1] - now[1]];
    this.invalidate();
  }
  /** Brings all polygons into view. */
  frameAll(): void {
    let [left, low, right, high] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of polygonDoc.peek().polygons.flat(2)) {
      [left, right] = [Math.min(left, x), Math.max(right, x)];
      [low, high] = [Math.min(low, y), Math.max(high, y)];
    }
    const { clientWidth, clientHeight } = this.canvas;
    if (left > right || clientWidth === 0) return;
    this.center = [(left + right) / 2, (low + high) / 2];
    const width = Math.max(clientWidth - 2 * kToolBar, clientWidth / 2);
    const size = Math.max((right - left) / width, (high - low) / (0.8 * clientHeight));
    this.scale = size > 0 ? 1 / size : 60;
    this.invalidate();
  }

  /** A vertex within `reach` CSS pixels, else a ring whose line is, else null. */
  pick(at: Point2, reach: number): RingPlace | null {
    const found: { distance: number; place: RingPlace }[] = [];
    const consider = (distance: number, place: RingPlace): void => {
      if (distance < reach) found.push({ distance, place });
    };
    const nearest = (): RingPlace | undefined => found.sort((a, b) => a.distance - b.distance).at(0)?.place;
    polygonDoc.peek().polygons.forEach((rings, polygon) => {
      rings.forEach((points, ring) => {
        points.forEach((p, vertex) => {
          const [x, y] = this.toScreen(p);
          consider(Math.hypot(x - at[0], y - at[1]), { polygon, ring, vertex });
        });
      });
    });
    const vertex = nearest();
    if (vertex) return vertex;
    polygonDoc.peek().polygons.forEach((rings, polygon) => {
      rings.forEach((points, ring) => {
        points.forEach((p, i) => {
          const [a, b] = [this.toScreen(p), this.toScreen(points[(i + 1) % points.length])];
          consider(distanceToSegment(at, a, b) / 0.6, { polygon, ring, vertex: null });
        });
      });
    });
    return nearest() ?? null;
  }

  private draw(): void {
    const { canvas } = this;
    const ratio = window.devicePixelRatio;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0 || height === 0) return;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext('2d');
    if (context === null) return;
    context.scale(ratio, ratio);
    context.lineJoin = 'round';
    const { curves, surface } = readTheme();
    const found = triangulated.value;
    const { polygons } = polygonDoc.value;
    const now = flooding.value;
    const positions = found?.positions ?? new Float64Array();
    const step = now?.steps[now.taken];
    if (now && step) {
      this.fillTriangles(context, positions, now.triangles.subarray(0, 3 * step.triangles), surface.front, surface.wire);
    } else if (found && shown.value.surface) {
      if (found.strips.length > 0) this.fillStrips(context, found, surface.wire);
      else this.fillTriangles(context, found.positions, found.triangles, surface.front, surface.wire);
    }
    polygons.forEach((rings, polygon) => {
      rings.forEach((points, ring) => {
        const isChosen = selectedRing.value?.polygon === polygon && selectedRing.value.ring === ring;
        this.strokeRing(context, points, isChosen ? curves.selected : curves.line, isChosen ? 3 : 2);
      });
    });
    this.drawVertices(context, polygons, curves.line, curves.selected);
    if (step) this.drawChain(context, positions, step.left, step.right, curves.selected);
    if (found) {
      this.dot(context, found.positions.subarray(found.positions.length - 2 * found.added), curves.inserted);
      for (const error of found.errors) this.markFault(context, polygons, error, curves.fault);
    }
    if (this.stroke.length > 1) this.strokePath(context, this.stroke, curves.selected, 2);
  }

  private trace(path: Path2D, positions: Float64Array, vertices: ArrayLike<number>): void {
    for (let i = 0; i < vertices.length; i++) {
      const v = vertices[i];
      const [x, y] = this.toScreen([positions[2 * v], positions[2 * v + 1]]);
      if (i === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
    }
    path.closePath();
  }

  private fillTriangles(
    context: CanvasRenderingContext2D,
    positions: Float64Array,
    triangles: Uint32Array,
    color: string,
    wire: string,
  ): void {
    const path = new Path2D();
    for (let t = 0; t < triangles.length; t += 3) this.trace(path, positions, triangles.subarray(t, t + 3));
    this.paint(context, path, color, wire);
  }

  /** Each strip in a colour of its own. */
  private fillStrips(context: CanvasRenderingContext2D, found: Triangulated, wire: string): void {
    const paths = Array.from({ length: kHues }, () => new Path2D());
    const { strips, stripStarts, positions } = found;
    for (let s = 0; s + 1 < stripStarts.length; s++) {
      for (let i = stripStarts[s]; i + 2 < stripStarts[s + 1]; i++) {
        const corners = strips.subarray(i, i + 3);
        if (new Set(corners).size === 3) this.trace(paths[s % kHues], positions, corners);
      }
    }
    paths.forEach((path, i) => {
      // By the golden angle, so that strips made one after the other look unlike.
      this.paint(context, path, `hsl(${(i * 137.5) % 360} 65% ${i % 2 ? 62 : 72}%)`, wire);
    });
  }

  private paint(context: CanvasRenderingContext2D, path: Path2D, color: string, wire: string): void {
    context.fillStyle = color;
    context.fill(path);
    // Without edges too, so that no seams show between triangles.
    context.strokeStyle = shown.value.wires ? wire : color;
    context.lineWidth = 0.75;
    context.stroke(path);
  }

  private strokePath(context: CanvasRenderingContext2D, points: readonly Point2[], color: string, width: number, close = false): void {
    context.beginPath();
    points.forEach((p, i) => {
      const [x, y] = this.toScreen(p);
      if (i === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    if (close) context.closePath();
    context.strokeStyle = color;
    context.lineWidth = width;
    context.stroke();
  }

  private strokeRing(context: CanvasRenderingContext2D, points: readonly Point2[], color: string, width: number): void {
    this.strokePath(context, points, color, width, true);
  }

  private dot(context: CanvasRenderingContext2D, positions: ArrayLike<number>, color: string, radius = 3.5): void {
    context.fillStyle = color;
    context.beginPath();
    for (let i = 0; i + 1 < positions.length; i += 2) {
      const [x, y] = this.toScreen([positions[i], positions[i + 1]]);
      context.moveTo(x + radius, y);
      context.arc(x, y, radius, 0, 2 * Math.PI);
    }
    context.fill();
  }

  private drawVertices(context: CanvasRenderingContext2D, polygons: readonly Polygon[], color: string, chosen: string): void {
    const points = polygons.flat(2);
    if (shown.value.vertices && points.length <= kMostDots) this.dot(context, points.flat(), color, 3);
    const at = selectedRing.value;
    if (at !== null && at.vertex !== null) {
      this.dot(context, polygons[at.polygon][at.ring][at.vertex], chosen, 6);
    }
  }

  /** The active chain's ends, and the level of the water between them. */
  private drawChain(context: CanvasRenderingContext2D, positions: Float64Array, left: number, right: number, color: string): void {
    const ends = [left, right].filter((v) => 2 * v + 1 < positions.length);
    const points = ends.map((v): Point2 => [positions[2 * v], positions[2 * v + 1]]);
    this.strokePath(context, points, color, 2.5);
    this.dot(context, points.flat(), color, 5);
  }

  /** The edges or vertices of an error, and the point where it lies. */
  private markFault(
    context: CanvasRenderingContext2D,
    polygons: readonly Polygon[],
    error: { polygon?: number; loop?: number; vertex?: number; otherLoop?: number; otherVertex?: number; point?: readonly number[] },
    color: string,
  ): void {
    const rings = polygons.at(error.polygon ?? 0) ?? [];
    for (const [ring, vertex] of [[error.loop, error.vertex], [error.otherLoop, error.otherVertex]]) {
      const points = ring === undefined ? undefined : rings.at(ring);
      if (points === undefined || points.length === 0) continue;
      if (vertex === undefined) this.strokeRing(context, points, color, 3);
      else if (error.otherVertex !== undefined) this.strokePath(context, [points[vertex], points[(vertex + 1) % points.length]], color, 4);
    }
    if (error.point === undefined) return;
    const [x, y] = this.toScreen([error.point[0], error.point[1]]);
    context.beginPath();
    context.arc(x, y, 10, 0, 2 * Math.PI);
    context.strokeStyle = color;
    context.lineWidth = 2.5;
    context.stroke();
  }
}

function distanceToSegment([x, y]: Point2, a: Point2, b: Point2): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const t = Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y);
}

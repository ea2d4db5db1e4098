// The stage draws the state: it listens to the signals and moves the objects of the view.
import { computed, effect } from '@preact/signals';
import { Vector3 } from 'three';
import { coordinatePlane, viewPlane, type Frame } from '../shapes/plane.ts';
import { boundsOf, type Point } from '../shapes/vec.ts';
import type { Curve } from '../state/document.ts';
import { isStale, solve, surface, type Surface } from '../state/solving.ts';
import { doc, drawing, framing, hover, isGrowing, selection, shown, tool, type Drawing, type Selection } from '../state/store.ts';
import { CurvesLayer, PenLayer } from './curves.ts';
import { PlaneGrid } from './grid.ts';
import { kIdentity, placementFor } from './placement.ts';
import { SurfaceMesh } from './surface.ts';
import { readTheme, type Theme } from './theme.ts';
import { prefersReducedMotion, View, type ViewOptions } from './view.ts';

const kGrowMs = 1400;
const kEmptyRadius = 1.5;

export class Stage {
  readonly view: View;
  readonly pen = new PenLayer();
  /** Computed, so that whatever draws the document finds the placement that goes with it. */
  readonly placement = computed(() => {
    this.placed = placementFor(boundsOf(doc.value.curves), this.placed);
    return this.placed;
  });
  theme: Theme;
  /** The surface, unless it is stale and of curves that lie elsewhere by far. */
  private readonly drawn = computed(() => {
    const present = this.placement.value;
    const bounds = surface.value && boundsOf(surface.value.of.curves);
    return bounds && placementFor(bounds, present) === present ? surface.value : null;
  });
  private readonly surfaceMesh = new SurfaceMesh();
  private readonly curves = new CurvesLayer();
  private readonly grid = new PlaneGrid();
  private placed = kIdentity;
  private viewPlaced = kIdentity;
  private growSince = 0;

  constructor(container: HTMLElement, canvas: HTMLCanvasElement, options: ViewOptions) {
    this.view = new View(container, canvas, options);
    this.view.scene.add(this.grid.mesh, this.surfaceMesh.mesh, this.curves.group, this.pen.group);
    this.theme = readTheme();
    this.applyTheme();
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.applyTheme();
    });
    this.view.onCamera(() => {
      if (drawing.peek().plane === 'view') this.replaceGrid();
    });
    effect(() => {
      this.followSize(doc.value.curves);
    });
    effect(() => {
      if (this.drawn.value) this.surfaceMesh.setSpan(this.drawn.value.span, this.placement.value);
    });
    effect(() => {
      this.showSurface(surface.value);
    });
    effect(() => {
      const { surface: visible, wires } = shown.value;
      this.surfaceMesh.mesh.visible = visible && this.drawn.value !== null;
      this.surfaceMesh.setLook({ wires, faded: isStale.value });
      this.view.invalidate();
    });
    effect(() => {
      this.drawCurves();
    });
    effect(() => {
      this.placeGrid(drawing.value, shown.value.grid, tool.value === 'draw');
    });
    effect(() => {
      this.view.setOrbitButtons(tool.value === 'draw');
      canvas.dataset.tool = tool.value;
    });
    effect(() => {
      if (framing.value) this.frameAll(framing.value.direction, framing.value.atOnce);
    });
  }

  /** The plane drawn in, as the eye now stands. */
  drawingPlane(): Frame {
    const { plane, offset } = drawing.peek();
    if (plane !== 'view') return coordinatePlane(plane, offset);
    const { right, up } = this.view.axes();
    return viewPlane(this.view.target, right, up, offset);
  }

  /** The plane through a point in which it is dragged. */
  dragPlane(through: Point): Frame {
    const { right, up } = this.view.axes();
    if (drawing.peek().dragIn === 'view') return viewPlane(through, right, up, 0);
    return { ...this.drawingPlane(), origin: through };
  }

  /** What lies under a CSS pixel: a vertex within `reach` pixels, else a curve's line, else null. */
  pick(x: number, y: number, reach: number): Selection | null {
    const projected = doc.peek().curves.map((curve) => curve.map((point) => this.view.project(point)));
    const vertices = projected.flatMap((points, curve) =>
      points.map((p, vertex) => ({ at: { curve, vertex }, distance: p.visible ? Math.hypot(p.x - x, p.y - y) : Infinity })),
    );
    const vertex = nearest(vertices, reach);
    if (vertex) return vertex;
    const edges = projected.flatMap((points, curve) =>
      points.map((a, i) => {
        const b = points[(i + 1) % points.length];
        const isVisible = a.visible && b.visible;
        return { at: { curve, vertex: null }, distance: isVisible ? distanceToSegment(x, y, a, b) : Infinity };
      }),
    );
    return nearest(edges, 0.6 * reach);
  }

  frameAll(direction?: Point, atOnce = false): void {
    const { center, diagonal } = boundsOf(doc.peek().curves);
    this.view.frame(center, diagonal / 2 || kEmptyRadius, direction, atOnce);
  }

  /** Looks at the drawing plane straight on. */
  facePlane(): void {
    const { normal } = this.drawingPlane();
    this.view.lookFrom(normal);
  }

  /** Lets the surface appear again, triangle by triangle. */
  replay(): void {
    if (surface.peek() === null) return;
    this.growSince = performance.now();
    isGrowing.value = true;
    this.view.animate(this.grow);
  }

  /** Shows the whole surface now. */
  skipGrowth(): void {
    this.growSince = -Infinity;
    this.view.invalidate();
  }

  private readonly grow = (now: number): boolean => {
    const t = Math.min(1, Math.max(0, (now - this.growSince) / kGrowMs));
    this.surfaceMesh.setGrowth(t);
    isGrowing.value = t < 1;
    return t < 1;
  };

  private showSurface(shownSurface: Surface | null): void {
    this.view.stop(this.grow);
    isGrowing.value = false;
    if (shownSurface) {
      this.surfaceMesh.setGrowth(1);
      if (shownSurface.entrance === 'grow' && !prefersReducedMotion()) {
        this.surfaceMesh.setGrowth(0);
        this.replay();
      }
    }
    this.view.invalidate();
  }

  private drawCurves(): void {
    const state = solve.value;
    const span = isStale.value ? undefined : surface.value?.span;
    const inserted: Point[] = [];
    const firstInserted = span ? span.positions.length / 3 - span.inserted.length : 0;
    span?.inserted.forEach((_, i) => {
      inserted.push(new Vector3().fromArray(span.positions, 3 * (firstInserted + i)).toArray());
    });
    this.curves.update(
      doc.value.curves,
      {
        selection: selection.value,
        hover: hover.value,
        faults: state.phase === 'failed' ? state.faults : [],
        inserted,
        vertices: shown.value.vertices,
      },
      this.placement.value,
      this.view.renderer.getPixelRatio(),
    );
    this.view.invalidate();
  }

  private followSize(curves: readonly Curve[]): void {
    const radius = boundsOf(curves).diagonal / 2 || kEmptyRadius;
    const placement = this.placement.value;
    const isPlacedAnew = placement !== this.viewPlaced;
    this.viewPlaced = placement;
    if (isPlacedAnew) this.view.place(placement);
    const ratio = radius / this.view.radius;
    // Not at every step of a drag: the grid would crawl.
    if (!isPlacedAnew && ratio < 1.3 && ratio > 0.5) return;
    this.view.radius = radius;
    this.replaceGrid();
  }

  private placeGrid({ plane }: Drawing, isShown: boolean, isDrawing: boolean): void {
    this.grid.mesh.visible = isShown || isDrawing;
    this.grid.place(plane, this.drawingPlane(), this.view.radius, isDrawing, this.placement.peek());
    this.view.invalidate();
  }

  /** As the state is now, after something that no signal tells of. */
  private replaceGrid(): void {
    this.placeGrid(drawing.peek(), shown.peek().grid, tool.peek() === 'draw');
  }

  private applyTheme(): void {
    this.theme = readTheme();
    this.view.setBackground(this.theme.background);
    this.surfaceMesh.setColors(this.theme.surface);
    this.curves.setColors(this.theme.curves);
    this.grid.setColors(this.theme.grid);
    this.drawCurves();
  }
}

function nearest(candidates: readonly { at: Selection; distance: number }[], reach: number): Selection | null {
  let best: { at: Selection | null; distance: number } = { at: null, distance: reach };
  for (const candidate of candidates) if (candidate.distance < best.distance) best = candidate;
  return best.at;
}

function distanceToSegment(x: number, y: number, a: { x: number; y: number }, b: { x: number; y: number }): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const t = Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
}

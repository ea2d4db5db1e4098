// What the film adds to the scene: the surface between the curves, growing in, and the vertices that were put on them.
import { computed, effect, signal } from '@preact/signals';
import type { SmoothSurface } from 'soapfilm';
import { Dots } from '../../scene/dots.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import { placementFor } from '../../scene/placement.ts';
import type { Stage } from '../../scene/stage.ts';
import { SurfaceMesh } from '../../scene/surface.ts';
import { prefersReducedMotion } from '../../scene/viewpoint.ts';
import { boundsOf } from '../../shapes/vec.ts';
import { boxOfGroup } from '../../state/document.ts';
import { shown } from '../../state/store.ts';
import { smoothed } from './smoothing.ts';
import { isStale, surface, type Surface } from './spanning.ts';

const kGrowMs = 1400;
/** Diameter of the marks on inserted vertices, in CSS pixels. */
const kInserted = 10;

/** Whether a surface is just appearing. */
export const isGrowing = signal(false);

export class FilmScene {
  private readonly mesh = new SurfaceMesh();
  private readonly inserted = new Dots(true);
  private growSince = 0;

  constructor(
    private readonly stage: Stage,
    scene: ModeScene,
  ) {
    const { view, theme } = stage;
    scene.root.add(this.mesh.mesh, this.inserted.object);
    /** The surface, unless it is stale and of curves that lie elsewhere by far. */
    const drawn = computed(() => {
      const present = scene.placement.value;
      const bounds = surface.value && boundsOf(boxOfGroup(surface.value.of));
      return bounds && placementFor(bounds, present) === present ? surface.value : null;
    });
    view.follow(() => {
      this.mesh.setColors(theme.value.surface);
    });
    view.follow(() => {
      if (drawn.value === null) return;
      const better = smoothed.value?.of === drawn.value ? smoothed.value.surface : null;
      this.mesh.setSurface(better ? inOrder(better) : drawn.value.span, scene.placement.value);
    });
    effect(() => {
      this.show(surface.value);
    });
    view.follow(() => {
      const { surface: visible, wires } = shown.value;
      this.mesh.mesh.visible = visible && drawn.value !== null;
      this.mesh.setLook({ wires, faded: isStale.value });
    });
    view.follow(() => {
      const span = isStale.value ? undefined : drawn.value?.span;
      const dots = this.inserted.begin(scene.placement.value);
      const { inserted: color, rim } = theme.value.curves;
      if (span) {
        for (let at = span.positions.length - 3 * span.inserted.length; at < span.positions.length; at += 3) {
          dots.put([span.positions[at], span.positions[at + 1], span.positions[at + 2]], color, kInserted, 'diamond');
        }
      }
      this.inserted.show(view.pixelRatio.value, rim);
    });
  }

  /** Lets the surface appear again, triangle by triangle. */
  replay(): void {
    if (surface.peek() === null) return;
    this.growSince = performance.now();
    isGrowing.value = true;
    this.stage.view.animate(this.grow);
  }

  /** Shows the whole surface now. */
  skipGrowth(): void {
    this.growSince = -Infinity;
    this.stage.view.invalidate();
  }

  private readonly grow = (now: number): boolean => {
    const t = Math.min(1, Math.max(0, (now - this.growSince) / kGrowMs));
    this.mesh.setGrowth(t);
    isGrowing.value = t < 1;
    return t < 1;
  };

  private show(next: Surface | null): void {
    this.stage.view.stop(this.grow);
    isGrowing.value = false;
    if (next) {
      this.mesh.setGrowth(1);
      if (next.entrance === 'grow' && !prefersReducedMotion()) {
        this.mesh.setGrowth(0);
        this.replay();
      }
    }
    this.stage.view.invalidate();
  }
}

/** Triangles that grow in as they are listed. */
const inOrder = ({ positions, triangles }: SmoothSurface) => ({
  positions,
  triangles,
  order: Uint32Array.from({ length: triangles.length / 3 }, (_, t) => t),
});

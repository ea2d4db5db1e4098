// The stage: one view for all modes. It shows the scene of the mode that the page is in, the plane that is drawn in,
// and what the pen draws.
import { effect, signal } from '@preact/signals';
import { coordinatePlane, viewPlane, type Frame } from '../shapes/plane.ts';
import { boundsOf, type Point } from '../shapes/vec.ts';
import { boxOfGroup } from '../state/document.ts';
import { drawingPlane, framing, shown, tool, type DrawingPlane, type Framing, type Tool } from '../state/store.ts';
import { PlaneGrid } from './grid.ts';
import { kIdentity, type Placement } from './placement.ts';
import { ModeScene, type ModeSceneOptions } from './mode_scene.ts';
import { PenLayer } from './pen.ts';
import { readTheme } from './theme.ts';
import { View, type ViewOptions } from './view.ts';

export class Stage {
  readonly view: View;
  readonly theme = signal(readTheme());
  readonly current = signal<ModeScene | null>(null);
  private readonly pen = new PenLayer();
  private readonly grid = new PlaneGrid();
  private readonly scenes = new Map<string, ModeScene>();

  constructor(container: HTMLElement, canvas: HTMLCanvasElement, options: ViewOptions) {
    this.view = new View(container, canvas, options);
    this.view.scene.add(this.grid.mesh, this.pen.object);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.theme.value = readTheme();
    });
    effect(() => {
      const theme = this.theme.value;
      this.view.setBackground(theme.background);
      this.grid.setColors(theme.grid);
    });
    this.view.onCamera(() => {
      const plane = drawingPlane.peek();
      const scene = this.current.peek();
      // The plane that faces the viewer, and the grid's size, go with the eye.
      this.placeGrid(plane, shown.peek().grid, this.isDrawing(tool.peek()), scene, scene?.placement.peek() ?? kIdentity);
    });
    effect(() => {
      const scene = this.current.value;
      // Read here, so that another placement places the grid anew.
      const placement = scene?.placement.value ?? kIdentity;
      this.placeGrid(drawingPlane.value, shown.value.grid, this.isDrawing(tool.value), scene, placement);
    });
    effect(() => {
      const scene = this.current.value;
      const isDrawing = this.isDrawing(tool.value);
      scene?.viewpoint.setButtons(isDrawing);
      canvas.dataset.tool = isDrawing ? 'draw' : 'select';
    });
    effect(() => {
      const wish = framing.value;
      if (wish === null) return;
      // With the next picture: what stands beside the scene may only just be coming.
      this.view.animate(() => {
        this.frame(wish);
        return false;
      });
    });
  }

  /** Makes the scene of a mode; `show` shows it. */
  addScene(options: ModeSceneOptions): ModeScene {
    const made = new ModeScene(this.view, this.theme, options);
    this.view.scene.add(made.root);
    this.scenes.set(options.mode, made);
    return made;
  }

  show(mode: string): void {
    const next = this.scenes.get(mode) ?? null;
    if (next === null || next === this.current.peek()) return;
    for (const scene of this.scenes.values()) scene.root.visible = scene === next;
    this.view.use(next.viewpoint);
    this.current.value = next;
  }

  /** The plane drawn in, as the eye now stands. */
  drawingPlane(): Frame {
    const scene = this.current.peek();
    const { plane, offset } = drawingPlane.peek();
    if (scene === null || scene.options.dimension === 2) return coordinatePlane('xy', 0);
    if (plane !== 'view') return coordinatePlane(plane, offset);
    const { right, up } = scene.viewpoint.axes();
    return viewPlane(scene.viewpoint.target, right, up, offset);
  }

  /** The plane through a point in which it is dragged. */
  dragPlane(through: Point): Frame {
    const scene = this.current.peek();
    if (scene === null || scene.options.dimension === 2) return coordinatePlane('xy', 0);
    const { right, up } = scene.viewpoint.axes();
    if (drawingPlane.peek().dragIn === 'view') return viewPlane(through, right, up, 0);
    return { ...this.drawingPlane(), origin: through };
  }

  frame({ direction, atOnce, box }: Framing): void {
    const scene = this.current.peek();
    if (scene === null) return;
    this.view.resize();
    const whole = boxOfGroup(scene.options.group.peek());
    // A part of it in view makes what there is to see no smaller: nothing is cut off, and the grid stays as it is.
    if (!box) scene.viewpoint.follow(boundsOf(whole).diagonal / 2, true);
    scene.viewpoint.frame(box ?? whole, direction, atOnce);
  }

  /** Looks at the drawing plane straight on. */
  facePlane(): void {
    this.current.peek()?.viewpoint.lookFrom(this.drawingPlane().normal);
  }

  /** Shows what the hand has drawn and the line that it will become; null: nothing any more. */
  showStroke(raw: readonly Point[] | null, closed: readonly Point[] | null): void {
    const placement = this.current.peek()?.placement.peek() ?? kIdentity;
    if (raw) this.pen.show(raw, closed, placement, this.theme.peek());
    else this.pen.clear();
    this.view.invalidate();
  }

  /** Whether the tool draws, which it does only in modes with a pen. */
  isDrawing(now: Tool): boolean {
    return now === 'draw' && (this.current.peek()?.options.hasPen ?? false);
  }

  private placeGrid({ plane }: DrawingPlane, isShown: boolean, isDrawing: boolean, scene: ModeScene | null, placement: Placement): void {
    const isInSpace = scene !== null && scene.options.dimension === 3;
    this.grid.mesh.visible = isInSpace && (isShown || isDrawing);
    if (isInSpace) {
      this.grid.place(plane, this.drawingPlane(), scene.viewpoint.radius, isDrawing, placement);
    }
    this.view.invalidate();
  }
}

// A camera with its controls, in one of two forms: `OrbitViewpoint` in space, `PlaneViewpoint` from above. Points and
// lengths in the methods are the world's; the camera itself is in the scene.
import { Vector3, type OrthographicCamera, type PerspectiveCamera } from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Box, Point } from '../shapes/vec.ts';
import type { Eye, Projected } from './eye.ts';
import { kIdentity, toScene, toWorld, type Placement } from './placement.ts';

/** Called before each frame; returns whether it wants another one after it. */
export type Animation = (now: number) => boolean;

/** What a viewpoint asks of the view it is in. */
export interface Screen {
  /** What the pointer and the wheel turn it on. */
  readonly canvas: HTMLElement;
  /** In CSS pixels. */
  readonly size: readonly [width: number, height: number];
  invalidate(): void;
  animate(animation: Animation): void;
  /** The camera has moved. */
  moved(): void;
}

/** Of nothing. */
export const kEmptyRadius = 1.5;

export abstract class Viewpoint implements Eye {
  abstract readonly camera: PerspectiveCamera | OrthographicCamera;
  abstract readonly controls: OrbitControls;
  protected placement = kIdentity;
  /** Radius of what there is to see. */
  radius = kEmptyRadius;

  constructor(protected readonly screen: Screen) {}

  /** Brings a box into view; in space from a direction (towards the viewer), or from where the eye is. */
  abstract frame(box: Box, direction?: Point, atOnce?: boolean): void;
  /** Places the world anew; what is in view stays so where it can. */
  abstract place(placement: Placement): void;
  /** World units that an arrow key moves by what is chosen, at a point. */
  abstract keyStep(at: Point): number;
  /** Turns or moves what is seen by steps of the arrow keys. */
  abstract step(right: number, up: number): void;
  /** Above 1: closer. */
  abstract zoom(factor: number): void;
  /** Looks along a direction, towards the target. */
  abstract lookFrom(direction: Point): void;
  /** While drawing, the left button and one finger belong to the pen. */
  abstract setButtons(whileDrawing: boolean): void;
  /** The canvas has the screen's size now. */
  abstract resize(): void;
  /** World units a CSS pixel, at a point. */
  abstract pixelSize(at: Point): number;
  /** Called before each frame. */
  abstract prepare(): void;

  /** What there is to see has a radius now. Not followed `exactly` at every step of a drag: the grid would crawl. */
  follow(radius: number, exactly: boolean): void {
    const next = radius || kEmptyRadius;
    const ratio = next / this.radius;
    if (!exactly && ratio < 1.3 && ratio > 0.5) return;
    this.radius = next;
    this.screen.moved();
  }

  /** Takes the pointer and the wheel, or leaves them to another viewpoint. */
  attach(isAttached: boolean): void {
    if (isAttached) this.controls.connect(this.screen.canvas);
    else {
      this.controls.disconnect();
      // The style sheet says how the pointer looks.
      this.screen.canvas.style.cursor = '';
    }
    this.controls.enabled = isAttached;
  }

  /** What the view turns about, or has in its middle. */
  get target(): Point {
    return toWorld(this.placement, this.controls.target.toArray());
  }

  project(point: Point): Projected {
    const p = new Vector3(...toScene(this.placement, point)).project(this.camera);
    const [width, height] = this.screen.size;
    return { x: ((p.x + 1) / 2) * width, y: ((1 - p.y) / 2) * height, visible: p.z < 1 };
  }

  ray(x: number, y: number): { from: Point; direction: Point } {
    this.camera.updateMatrixWorld();
    const [width, height] = this.screen.size;
    const at = (depth: number) => new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, depth).unproject(this.camera);
    const from = at(-1);
    const direction = at(0.5).sub(from).normalize();
    return { from: toWorld(this.placement, from.toArray()), direction: direction.toArray() };
  }

  axes(): { right: Point; up: Point; toViewer: Point } {
    this.camera.updateMatrixWorld();
    const [right, up, toViewer] = [new Vector3(), new Vector3(), new Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, toViewer);
    return { right: right.toArray(), up: up.toArray(), toViewer: toViewer.toArray() };
  }
}

export function prefersReducedMotion(): boolean {
  return window.matchMedia('(prefers-reduced-motion: reduce)').matches;
}

// The camera from above: the plane in parallel projection, y up, moved and enlarged.
import { MOUSE, OrthographicCamera, TOUCH } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { boundsOf, type Box, type Point } from '../shapes/vec.ts';
import { toScene, type Placement } from './placement.ts';
import { Viewpoint, type Screen } from './viewpoint.ts';

/** What the bar of tools covers at the side, in CSS pixels. */
const kToolBar = 72;
/** What an arrow key moves by the view, and what is chosen, in CSS pixels. */
const kStep = 40;
const kKeyStep = 4;
const kWheelSpeed = 3;
/** CSS pixels a unit of the world, in a view of nothing. */
const kEmptyScale = 60;
/** How far above the plane the eye is, in units of the scene: anything between the camera's near and far planes. */
const kHeight = 10;
/** CSS pixels a unit of the scene: beyond this, single precision would show. */
const kMostScale = 1e7;

export class PlaneViewpoint extends Viewpoint {
  /** Its `zoom` is CSS pixels a unit of the scene. */
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 100);
  readonly controls: OrbitControls;
  /** The lesser extent of the canvas that `zoom` is for, in CSS pixels. */
  private fitted = 0;

  constructor(screen: Screen) {
    super(screen);
    this.camera.position.set(0, 0, kHeight);
    this.camera.zoom = kEmptyScale;
    this.controls = new OrbitControls(this.camera);
    this.controls.enableRotate = false;
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.minZoom = 1e-6;
    this.controls.maxZoom = kMostScale;
    this.controls.enabled = false;
    this.controls.addEventListener('change', () => {
      screen.moved();
    });
    // Two fingers enlarge by how far they have moved apart, to the power of the speed; before the controls hear of it.
    const setSpeed = (speed: number) => () => (this.controls.zoomSpeed = speed);
    screen.canvas.addEventListener('pointerdown', setSpeed(1), { capture: true });
    screen.canvas.addEventListener('wheel', setSpeed(kWheelSpeed), { capture: true, passive: true });
  }

  /** Moved with any button, whatever the tool. */
  setButtons(): void {
    this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
  }

  place(placement: Placement): void {
    const target = toScene(placement, this.target);
    const scale = (this.camera.zoom * placement.unit) / this.placement.unit;
    this.placement = placement;
    if (target.every(Number.isFinite) && scale > this.controls.minZoom && scale < kMostScale) {
      this.look(target, scale);
    }
    this.screen.invalidate();
  }

  frame(box: Box): void {
    const { center } = boundsOf(box);
    const { unit } = this.placement;
    const [width, height] = this.screen.size;
    const free = Math.max(width - 2 * kToolBar, width / 2);
    const extent = Math.max((box.high[0] - box.low[0]) / free, (box.high[1] - box.low[1]) / (0.8 * height));
    this.look(toScene(this.placement, center), extent > 0 ? unit / extent : kEmptyScale * unit);
  }

  keyStep(): number {
    return kKeyStep * this.pixelSize();
  }

  step(right: number, up: number): void {
    const far = kStep / this.camera.zoom;
    const [x, y] = this.controls.target.toArray();
    this.look([x + far * right, y + far * up, 0], this.camera.zoom);
  }

  zoom(factor: number): void {
    this.look(this.controls.target.toArray(), this.camera.zoom * factor);
  }

  /** There is but one direction to look in. */
  lookFrom(): void {}

  /** What was in view stays so, as when the panel opens below the canvas. */
  resize(): void {
    const [width, height] = this.screen.size;
    const least = Math.min(width, height);
    if (this.fitted > 0) this.camera.zoom *= least / this.fitted;
    this.fitted = least;
    [this.camera.left, this.camera.right] = [-width / 2, width / 2];
    [this.camera.top, this.camera.bottom] = [height / 2, -height / 2];
    this.camera.updateProjectionMatrix();
  }

  pixelSize(): number {
    return this.placement.unit / this.camera.zoom;
  }

  prepare(): void {
    this.controls.update();
  }

  private look([x, y]: Point, scale: number): void {
    this.controls.target.set(x, y, 0);
    this.camera.position.set(x, y, kHeight);
    this.camera.zoom = Math.min(kMostScale, Math.max(this.controls.minZoom, scale));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.screen.moved();
  }
}

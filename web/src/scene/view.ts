// The view: renderer, camera, orbit. Draws on demand, and only then. Points and lengths in its
// methods are the world's; the camera itself is in the scene.
import {
  Color,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
  MOUSE,
  TOUCH,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Point } from '../shapes/vec.ts';
import { kIdentity, toScene, toWorld, type Placement } from './placement.ts';

export interface ViewOptions {
  readonly antialias: boolean;
  /** Device pixels a CSS pixel; by default the screen's, at most 2. */
  readonly pixelRatio?: number;
}

/** Called before each frame; returns whether it wants another one after it. */
export type Animation = (now: number) => boolean;

interface Flight {
  readonly since: number;
  readonly from: { readonly target: Vector3; readonly eye: Spherical };
  readonly to: { readonly target: Vector3; readonly eye: Spherical };
}

/** The eye around its target, z up: distance, angle from +z, angle from +x. */
interface Spherical {
  readonly distance: number;
  readonly polar: number;
  readonly azimuth: number;
}

const kFlightMs = 420;
const kPole = 1e-4;
/** How far from the origin an eye is taken along into another placement, in units of the scene. */
const kFarthest = 1e4;

export class View {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  /** Radius of what there is to see; the near and far planes follow it. */
  radius = 2;
  private placement = kIdentity;
  private readonly animations = new Set<Animation>();
  private readonly cameraListeners = new Set<() => void>();
  private pending = 0;
  private size = [0, 0];
  private flight: Flight | null = null;

  constructor(
    readonly container: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    private readonly options: ViewOptions,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: options.antialias, powerPreference: 'high-performance' });
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(3, -5, 2.5);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !prefersReducedMotion();
    this.controls.dampingFactor = 0.12;
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 1e-4;
    this.controls.maxDistance = kFarthest;
    this.controls.addEventListener('change', () => {
      this.invalidate();
      for (const listener of this.cameraListeners) listener();
    });
    this.controls.addEventListener('start', () => (this.flight = null));
    new ResizeObserver(() => {
      this.resize();
    }).observe(container);
    this.resize();
  }

  /** While drawing, the left button and one finger belong to the pen. */
  setOrbitButtons(whileDrawing: boolean): void {
    this.controls.mouseButtons = whileDrawing
      ? { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.ROTATE }
      : { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.ROTATE, TWO: whileDrawing ? TOUCH.DOLLY_ROTATE : TOUCH.DOLLY_PAN };
  }

  /** What the view turns about. */
  get target(): Point {
    return toWorld(this.placement, this.controls.target.toArray());
  }

  /**
   * Places the world anew. The eye stays where it is in the world; where that would be out of
   * reach, in the scene.
   */
  place(placement: Placement): void {
    const move = (at: Vector3) =>
      new Vector3(...toScene(placement, toWorld(this.placement, at.toArray())));
    const target = move(this.controls.target);
    const eye = move(this.camera.position);
    this.placement = placement;
    this.flight = null;
    const distance = eye.distanceTo(target);
    // NaN is out of reach as well.
    if (target.length() < kFarthest && distance < kFarthest && distance > 1 / kFarthest) {
      this.controls.target.copy(target);
      this.camera.position.copy(eye);
    }
    this.controls.update();
    this.invalidate();
  }

  /** Asks for a frame. */
  invalidate(): void {
    this.pending ||= requestAnimationFrame((now) => {
      this.pending = 0;
      this.draw(now);
    });
  }

  animate(animation: Animation): void {
    this.animations.add(animation);
    this.invalidate();
  }

  stop(animation: Animation): void {
    this.animations.delete(animation);
  }

  /** Calls back whenever the camera has moved; returns what ends that. */
  onCamera(listener: () => void): () => void {
    this.cameraListeners.add(listener);
    return () => this.cameraListeners.delete(listener);
  }

  setBackground(color: string): void {
    this.scene.background = new Color(color);
    this.invalidate();
  }

  /** Brings a sphere into view, from a direction (towards the viewer) or from where the eye is. */
  frame(center: Point, radius: number, direction?: Point, atOnce = false): void {
    this.radius = radius;
    // The container may have been put into the page a moment ago.
    this.resize();
    const half = (this.camera.fov * Math.PI) / 360;
    const across = Math.min(1, this.camera.aspect);
    const distance = (1.04 * radius) / this.placement.unit / Math.sin(Math.atan(Math.tan(half) * across));
    const target = new Vector3(...toScene(this.placement, center));
    const eye = direction
      ? toSpherical(new Vector3(...direction))
      : toSpherical(this.camera.position.clone().sub(this.controls.target));
    this.fly(target, { ...eye, distance }, atOnce);
  }

  /** Turns the eye to look along an axis, towards the target. */
  lookFrom(direction: Point): void {
    const { distance } = toSpherical(this.camera.position.clone().sub(this.controls.target));
    this.fly(this.controls.target.clone(), { ...toSpherical(new Vector3(...direction)), distance });
  }

  /** Turns and zooms by angles (radians) and a factor, for the keyboard. */
  orbit(turn: number, tilt: number, zoom = 1): void {
    const eye = toSpherical(this.camera.position.clone().sub(this.controls.target));
    const polar = Math.min(Math.PI - kPole, Math.max(kPole, eye.polar + tilt));
    const next = { distance: eye.distance * zoom, polar, azimuth: eye.azimuth + turn };
    this.fly(this.controls.target.clone(), next, true);
  }

  private fly(target: Vector3, eye: Spherical, atOnce = false): void {
    const from = {
      target: this.controls.target.clone(),
      eye: toSpherical(this.camera.position.clone().sub(this.controls.target)),
    };
    // The short way round.
    const turns = Math.round((eye.azimuth - from.eye.azimuth) / (2 * Math.PI));
    const to = { target, eye: { ...eye, azimuth: eye.azimuth - 2 * Math.PI * turns } };
    const skip = atOnce || prefersReducedMotion();
    this.flight = { since: skip ? -Infinity : performance.now(), from, to };
    this.animate(this.advanceFlight);
    if (skip) this.advanceFlight(performance.now());
  }

  private readonly advanceFlight = (now: number): boolean => {
    const { flight } = this;
    if (flight === null) return false;
    const t = Math.min(1, Math.max(0, (now - flight.since) / kFlightMs));
    const ease = t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2;
    const mix = (a: number, b: number) => a + (b - a) * ease;
    const { from, to } = flight;
    this.controls.target.lerpVectors(from.target, to.target, ease);
    const distance = from.eye.distance * (to.eye.distance / from.eye.distance) ** ease;
    const polar = mix(from.eye.polar, to.eye.polar);
    const azimuth = mix(from.eye.azimuth, to.eye.azimuth);
    this.camera.position.set(
      distance * Math.sin(polar) * Math.cos(azimuth),
      distance * Math.sin(polar) * Math.sin(azimuth),
      distance * Math.cos(polar),
    );
    this.camera.position.add(this.controls.target);
    this.controls.update();
    if (t === 1) this.flight = null;
    return t < 1;
  };

  /** World units a CSS pixel at a point. */
  pixelSize(at: Point): number {
    const depth = new Vector3(...toScene(this.placement, at)).applyMatrix4(this.camera.matrixWorldInverse).z;
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    return (2 * Math.abs(depth) * half * this.placement.unit) / this.container.clientHeight;
  }

  /** CSS pixels from the canvas's top left, and whether the point lies before the eye. */
  project(point: Point): { x: number; y: number; visible: boolean } {
    const p = new Vector3(...toScene(this.placement, point)).project(this.camera);
    return {
      x: ((p.x + 1) / 2) * this.container.clientWidth,
      y: ((1 - p.y) / 2) * this.container.clientHeight,
      visible: p.z < 1,
    };
  }

  /** The ray through a CSS pixel of the canvas. */
  ray(x: number, y: number): { from: Point; direction: Point } {
    this.camera.updateMatrixWorld();
    const ndc = new Vector3(
      (2 * x) / this.container.clientWidth - 1,
      1 - (2 * y) / this.container.clientHeight,
      0.5,
    );
    const direction = ndc.unproject(this.camera).sub(this.camera.position).normalize();
    return { from: toWorld(this.placement, this.camera.position.toArray()), direction: direction.toArray() };
  }

  /** The screen's axes in the world. */
  axes(): { right: Point; up: Point; toViewer: Point } {
    this.camera.updateMatrixWorld();
    const [right, up, toViewer] = [new Vector3(), new Vector3(), new Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, toViewer);
    return { right: right.toArray(), up: up.toArray(), toViewer: toViewer.toArray() };
  }

  /** The picture now shown, as a PNG. */
  async picture(): Promise<Blob> {
    this.draw(performance.now());
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new Error('The browser could not encode the picture.'));
      });
    });
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (clientWidth === 0 || clientHeight === 0) return;
    if (clientWidth === this.size[0] && clientHeight === this.size[1]) return;
    this.size = [clientWidth, clientHeight];
    this.renderer.setPixelRatio(this.options.pixelRatio ?? Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    // At once, since resizing clears the canvas.
    this.draw(performance.now());
  }

  private draw(now: number): void {
    for (const animation of [...this.animations]) {
      if (animation(now)) this.invalidate();
      else this.animations.delete(animation);
    }
    // Damping moves the camera on; the change event asks for the next frame.
    this.controls.update();
    const distance = this.camera.position.distanceTo(this.controls.target);
    const radius = this.radius / this.placement.unit;
    this.camera.near = Math.max(distance / 200, distance - 6 * radius);
    this.camera.far = distance + 40 * Math.max(radius, distance);
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }
}

export function prefersReducedMotion(): boolean {
  return window.matchMedia('(prefers-reduced-motion: reduce)').matches;
}

function toSpherical(v: Vector3): Spherical {
  const distance = v.length() || 1;
  const polar = Math.min(Math.PI - kPole, Math.max(kPole, Math.acos(v.z / distance)));
  // From a pole, x points right.
  const azimuth = Math.hypot(v.x, v.y) < 1e-3 * distance ? -Math.PI / 2 : Math.atan2(v.y, v.x);
  return { distance, polar, azimuth };
}

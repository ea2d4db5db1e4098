// The camera in space: perspective, turning about a target, z up.
import { MOUSE, PerspectiveCamera, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { boundsOf, type Box, type Point } from '../shapes/vec.ts';
import { toScene, toWorld, type Placement } from './placement.ts';
import { kEmptyRadius, prefersReducedMotion, Viewpoint, type Screen } from './viewpoint.ts';

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
/** What an arrow key moves by what is chosen, in radii of what is in view. */
const kKeyStep = 0.02;
/** What an arrow key turns the view by. */
const kTurn = Math.PI / 24;

export class OrbitViewpoint extends Viewpoint {
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  readonly controls: OrbitControls;
  private flight: Flight | null = null;

  constructor(screen: Screen) {
    super(screen);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(3, -5, 2.5);
    this.controls = new OrbitControls(this.camera);
    this.controls.enableDamping = !prefersReducedMotion();
    this.controls.dampingFactor = 0.12;
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 1e-4;
    this.controls.maxDistance = kFarthest;
    this.controls.enabled = false;
    this.controls.addEventListener('change', () => {
      screen.moved();
    });
    this.controls.addEventListener('start', () => (this.flight = null));
  }

  setButtons(whileDrawing: boolean): void {
    this.controls.mouseButtons = whileDrawing
      ? { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.ROTATE }
      : { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.ROTATE, TWO: whileDrawing ? TOUCH.DOLLY_ROTATE : TOUCH.DOLLY_PAN };
  }

  /** The eye stays where it is in the world; where that would be out of reach, in the scene. */
  place(placement: Placement): void {
    const move = (at: Vector3) => new Vector3(...toScene(placement, toWorld(this.placement, at.toArray())));
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
    this.screen.invalidate();
  }

  frame(box: Box, direction?: Point, atOnce = false): void {
    const { center, diagonal } = boundsOf(box);
    const radius = diagonal / 2 || kEmptyRadius;
    const half = (this.camera.fov * Math.PI) / 360;
    const across = Math.min(1, this.camera.aspect);
    const reach = Math.sin(Math.atan(Math.tan(half) * across));
    const distance = (1.04 * radius) / this.placement.unit / reach;
    const target = new Vector3(...toScene(this.placement, center));
    const eye = direction ? toSpherical(new Vector3(...direction)) : this.eyeNow();
    this.fly(target, { ...eye, distance }, atOnce);
  }

  lookFrom(direction: Point): void {
    const { distance } = this.eyeNow();
    this.fly(this.controls.target.clone(), { ...toSpherical(new Vector3(...direction)), distance });
  }

  keyStep(): number {
    return kKeyStep * this.radius;
  }

  step(right: number, up: number): void {
    const eye = this.eyeNow();
    const polar = Math.min(Math.PI - kPole, Math.max(kPole, eye.polar - kTurn * up));
    const next = { distance: eye.distance, polar, azimuth: eye.azimuth + kTurn * right };
    this.fly(this.controls.target.clone(), next, true);
  }

  zoom(factor: number): void {
    const eye = this.eyeNow();
    this.fly(this.controls.target.clone(), { ...eye, distance: eye.distance / factor }, true);
  }

  resize(): void {
    const [width, height] = this.screen.size;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  pixelSize(at: Point): number {
    const depth = new Vector3(...toScene(this.placement, at)).applyMatrix4(this.camera.matrixWorldInverse).z;
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    return (2 * Math.abs(depth) * half * this.placement.unit) / this.screen.size[1];
  }

  prepare(): void {
    // Damping moves the camera on; the change event asks for the next frame.
    this.controls.update();
    const distance = this.camera.position.distanceTo(this.controls.target);
    const radius = this.radius / this.placement.unit;
    this.camera.near = Math.max(distance / 200, distance - 6 * radius);
    this.camera.far = distance + 40 * Math.max(radius, distance);
    this.camera.updateProjectionMatrix();
  }

  private eyeNow(): Spherical {
    return toSpherical(this.camera.position.clone().sub(this.controls.target));
  }

  private fly(target: Vector3, eye: Spherical, atOnce = false): void {
    const from = { target: this.controls.target.clone(), eye: this.eyeNow() };
    // The short way round.
    const turns = Math.round((eye.azimuth - from.eye.azimuth) / (2 * Math.PI));
    const to = { target, eye: { ...eye, azimuth: eye.azimuth - 2 * Math.PI * turns } };
    const skip = atOnce || prefersReducedMotion();
    this.flight = { since: skip ? -Infinity : performance.now(), from, to };
    this.screen.animate(this.advanceFlight);
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
}

function toSpherical(v: Vector3): Spherical {
  const distance = v.length() || 1;
  const polar = Math.min(Math.PI - kPole, Math.max(kPole, Math.acos(v.z / distance)));
  // From a pole, x points right.
  const azimuth = Math.hypot(v.x, v.y) < 1e-3 * distance ? -Math.PI / 2 : Math.atan2(v.y, v.x);
  return { distance, polar, azimuth };
}

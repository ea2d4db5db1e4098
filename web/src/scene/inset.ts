// A second picture over the first, in a corner of it: of the same scene, from an eye of its own, which turns as the other does.
import type { Scene, WebGLRenderer } from 'three';
import { OrbitViewpoint } from './orbit_viewpoint.ts';
import type { View } from './view.ts';
import type { Animation, Screen } from './viewpoint.ts';

/** What only insets show: `object.layers.set(kInsetLayer)`. */
export const kInsetLayer = 1;

export class Inset implements Screen {
  /** Over a part of the canvas. It takes the pointer; the style sheet says where it is. */
  readonly canvas = document.createElement('div');
  readonly viewpoint: OrbitViewpoint;
  size: readonly [number, number] = [1, 1];

  constructor(
    private readonly view: View,
    label: string,
  ) {
    this.canvas.className = 'inset';
    this.canvas.hidden = true;
    const caption = document.createElement('span');
    caption.textContent = label;
    this.canvas.append(caption);
    view.container.append(this.canvas);
    this.viewpoint = new OrbitViewpoint(this);
    this.viewpoint.camera.layers.enable(kInsetLayer);
    // It may be beside a text that could be chosen, and turns without a key.
    this.viewpoint.setButtons(false);
    view.insets.add(this);
  }

  get isShown(): boolean {
    return !this.canvas.hidden;
  }

  show(isShown: boolean): void {
    if (isShown === this.isShown) return;
    this.canvas.hidden = !isShown;
    this.viewpoint.attach(isShown);
    this.measure();
    this.invalidate();
  }

  invalidate(): void {
    this.view.invalidate();
  }

  animate(animation: Animation): void {
    this.view.animate(animation);
  }

  moved(): void {
    this.view.invalidate();
  }

  /** Over the picture that was just drawn. */
  draw(renderer: WebGLRenderer, scene: Scene): void {
    if (!this.isShown) return;
    this.measure();
    const whole = this.view.container.getBoundingClientRect();
    const own = this.canvas.getBoundingClientRect();
    if (own.width === 0 || own.height === 0) return;
    const { clientLeft: rim } = this.canvas;
    const place = [own.left - whole.left + rim, whole.bottom - own.bottom + rim, ...this.size] as const;
    this.viewpoint.prepare();
    renderer.setScissorTest(true);
    renderer.setScissor(...place);
    renderer.setViewport(...place);
    renderer.render(scene, this.viewpoint.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, ...this.view.size);
  }

  private measure(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || (clientWidth === this.size[0] && clientHeight === this.size[1])) return;
    this.size = [clientWidth, clientHeight];
    this.viewpoint.resize();
  }
}

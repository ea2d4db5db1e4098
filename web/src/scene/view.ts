// The view: the one renderer, and the viewpoint that is in use. Draws on demand, and only then.
import { effect, signal } from '@preact/signals';
import { Color, Scene, WebGLRenderer } from 'three';
import type { Viewpoint, Animation, Screen } from './viewpoint.ts';

export interface ViewOptions {
  readonly antialias: boolean;
  /** Device pixels a CSS pixel; by default the screen's, at most 2. */
  readonly pixelRatio?: number;
}

/** What is drawn over the picture. */
export interface Drawing {
  draw(renderer: WebGLRenderer, scene: Scene): void;
}

export class View implements Screen {
  readonly scene = new Scene();
  readonly renderer: WebGLRenderer;
  size: readonly [number, number] = [0, 0];
  readonly pixelRatio = signal(1);
  /** Pictures over this one. */
  readonly insets = new Set<Drawing>();
  private current: Viewpoint | null = null;
  private readonly animations = new Set<Animation>();
  private readonly cameraListeners = new Set<() => void>();
  private pending = 0;

  constructor(
    readonly container: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    private readonly options: ViewOptions,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: options.antialias, powerPreference: 'high-performance' });
    const resize = () => { this.resize(); };
    new ResizeObserver(resize).observe(container);
    // Another ratio of pixels may come without another size.
    window.addEventListener('resize', resize);
    this.resize();
  }

  /** Looks from another viewpoint from now on. */
  use(viewpoint: Viewpoint): void {
    if (viewpoint === this.current) return;
    this.current?.attach(false);
    this.current = viewpoint;
    // The container may have been put into the page a moment ago.
    this.resize();
    viewpoint.resize();
    viewpoint.attach(true);
    this.moved();
  }

  invalidate(): void {
    this.pending ||= requestAnimationFrame((now) => {
      this.pending = 0;
      this.draw(now);
    });
  }

  /** Draws something now, and anew whenever what it read has changed. */
  follow(draw: () => void): void {
    effect(() => {
      draw();
      this.invalidate();
    });
  }

  animate(animation: Animation): void {
    this.animations.add(animation);
    this.invalidate();
  }

  stop(animation: Animation): void {
    this.animations.delete(animation);
  }

  moved(): void {
    this.invalidate();
    for (const listener of this.cameraListeners) listener();
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

  /** Takes the container's size as it is now. */
  resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = this.options.pixelRatio ?? Math.min(2, window.devicePixelRatio);
    if (clientWidth === this.size[0] && clientHeight === this.size[1] && ratio === this.pixelRatio.peek()) return;
    this.size = [clientWidth, clientHeight];
    this.pixelRatio.value = ratio;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.current?.resize();
    for (const listener of this.cameraListeners) listener();
    // At once, since resizing clears the canvas.
    this.draw(performance.now());
  }

  private draw(now: number): void {
    if (this.current === null) return;
    for (const animation of [...this.animations]) {
      if (animation(now)) this.invalidate();
      else this.animations.delete(animation);
    }
    this.current.prepare();
    this.renderer.render(this.scene, this.current.camera);
    for (const inset of this.insets) inset.draw(this.renderer, this.scene);
  }
}

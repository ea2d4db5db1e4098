// Dots of a size in pixels, such as vertices: round ones, diamonds and rings.
import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial } from 'three';
import type { Point } from '../shapes/vec.ts';
import { toScene, type Placement } from './placement.ts';

export type DotForm = 'round' | 'diamond' | 'ring';
const kForms: readonly DotForm[] = ['round', 'diamond', 'ring'];

/** In CSS pixels. */
const kRingWidth = 2.5;

const kVertexShader = /* glsl */ `
attribute float size;
attribute vec3 fill;
attribute float kind;
uniform float uPixelRatio;
varying vec3 vFill;
varying float vSize;
varying float vKind;
void main() {
  vFill = fill;
  vSize = size * uPixelRatio;
  vKind = kind;
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  // A little nearer along the line of sight, so that neither surface nor line cuts the dot.
  gl_Position = projectionMatrix * vec4(isOrthographic ? eye.xyz + vec3(0.0, 0.0, 0.01) : eye.xyz * 0.994, 1.0);
  gl_PointSize = vSize + 2.0;
}`;

const kFragmentShader = /* glsl */ `
uniform vec3 uRim;
uniform float uRimShare;
uniform float uPixelRatio;
varying vec3 vFill;
varying float vSize;
varying float vKind;
void main() {
  vec2 p = (gl_PointCoord - 0.5) * (vSize + 2.0);
  float radius = vKind > 0.5 && vKind < 1.5 ? (abs(p.x) + abs(p.y)) * 0.78 : length(p);
  float edge = vSize / 2.0;
  float alpha = 1.0 - smoothstep(edge - 0.7, edge + 0.7, radius);
  float hole = edge - ${kRingWidth.toFixed(1)} * uPixelRatio;
  if (vKind > 1.5) alpha *= smoothstep(hole - 0.7, hole + 0.7, radius);
  if (alpha < 0.02) discard;
  float core = edge * (1.0 - uRimShare);
  float inner = 1.0 - smoothstep(core - 0.7, core + 0.7, radius);
  gl_FragColor = vec4(mix(uRim, vFill, inner), alpha);
  #include <colorspace_fragment>
}`;

const kRimShare = 0.34;

export class Dots {
  readonly object: Points<BufferGeometry, ShaderMaterial>;
  private position: number[] = [];
  private fill: number[] = [];
  private size: number[] = [];
  private kind: number[] = [];
  private readonly colors = new Map<string, readonly number[]>();

  constructor(hasRim: boolean) {
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      transparent: true,
      uniforms: { uPixelRatio: { value: 1 }, uRim: { value: new Color() }, uRimShare: { value: hasRim ? kRimShare : -1 } },
    });
    this.object = new Points(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
  }

  /** Forgets all dots; `show` shows those that are put from now on. */
  begin(placement: Placement): { put(point: Point, color: string, diameter: number, form?: DotForm): void } {
    for (const list of [this.position, this.fill, this.size, this.kind]) list.length = 0;
    return {
      put: (point, color, diameter, form = 'round') => {
        this.position.push(...toScene(placement, point));
        this.fill.push(...this.rgb(color));
        this.size.push(diameter);
        this.kind.push(kForms.indexOf(form));
      },
    };
  }

  show(pixelRatio: number, rim: string): void {
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(this.position), 3));
    geometry.setAttribute('fill', new BufferAttribute(new Float32Array(this.fill), 3));
    geometry.setAttribute('size', new BufferAttribute(new Float32Array(this.size), 1));
    geometry.setAttribute('kind', new BufferAttribute(new Float32Array(this.kind), 1));
    this.object.geometry = geometry;
    const { uniforms } = this.object.material;
    uniforms.uPixelRatio.value = pixelRatio;
    (uniforms.uRim.value as Color).set(rim);
    this.object.visible = this.position.length > 0;
  }

  private rgb(color: string): readonly number[] {
    const known = this.colors.get(color);
    if (known) return known;
    const made = new Color(color).toArray();
    this.colors.set(color, made);
    return made;
  }
}

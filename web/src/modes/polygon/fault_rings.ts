// Rings of a size in pixels around places where something is wrong.
import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial } from 'three';
import { toScene, type Placement } from '../../scene/placement.ts';
import type { Point } from '../../shapes/vec.ts';

/** In CSS pixels. */
const kRadius = 10;
const kWidth = 2.5;

const kVertexShader = /* glsl */ `
uniform float uPixelRatio;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = ${(2 * kRadius + kWidth + 2).toFixed(1)} * uPixelRatio;
}`;

const kFragmentShader = /* glsl */ `
uniform vec3 uColor;
uniform float uPixelRatio;
void main() {
  float radius = length(gl_PointCoord - 0.5) * ${(2 * kRadius + kWidth + 2).toFixed(1)};
  float away = (abs(radius - ${kRadius.toFixed(1)}) - ${(kWidth / 2).toFixed(2)}) * uPixelRatio;
  float alpha = 1.0 - smoothstep(-0.5, 0.5, away);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(uColor, alpha);
  #include <colorspace_fragment>
}`;

export class FaultRings {
  readonly object: Points<BufferGeometry, ShaderMaterial>;

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      transparent: true,
      depthTest: false,
      uniforms: { uPixelRatio: { value: 1 }, uColor: { value: new Color() } },
    });
    this.object = new Points(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3;
  }

  show(points: readonly Point[], color: string, placement: Placement, pixelRatio: number): void {
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    const position = new Float32Array(points.flatMap((point) => toScene(placement, point)));
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    this.object.geometry = geometry;
    this.object.visible = points.length > 0;
    const { uniforms } = this.object.material;
    uniforms.uPixelRatio.value = pixelRatio;
    (uniforms.uColor.value as Color).set(color);
  }
}

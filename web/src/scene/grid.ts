// The grid of the drawing plane: lines of a fitting spacing, its two axes marked, fading outward.
import {
  Color,
  CustomBlending,
  DoubleSide,
  Matrix4,
  Mesh,
  OneFactor,
  PlaneGeometry,
  ShaderMaterial,
  Vector3,
} from 'three';
import type { Frame, PlaneKind } from '../shapes/plane.ts';
import { toScene, type Placement } from './placement.ts';
import type { GridColors } from './theme.ts';

const kVertexShader = /* glsl */ `
uniform float uExtent;
varying vec2 vPlane;
void main() {
  vPlane = position.xy * uExtent;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlane, 0.0, 1.0);
}`;

const kFragmentShader = /* glsl */ `
uniform float uExtent;
uniform float uStep;
uniform float uOpacity;
uniform vec3 uLine;
uniform vec3 uAxisU;
uniform vec3 uAxisV;
varying vec2 vPlane;
float lines(vec2 p) {
  vec2 width = fwidth(p);
  vec2 away = abs(fract(p - 0.5) - 0.5) / max(width, vec2(1e-9));
  // Lines closer together than a few pixels would be a grey sheet.
  vec2 sparse = 1.0 - smoothstep(0.15, 0.45, width);
  vec2 on = (1.0 - smoothstep(0.3, 1.1, away)) * sparse;
  return max(on.x, on.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(vPlane) / uExtent);
  float alpha = max(0.38 * lines(vPlane / uStep), 0.85 * lines(vPlane / (5.0 * uStep)));
  vec2 axis = 1.0 - smoothstep(0.5, 1.6, abs(vPlane) / max(fwidth(vPlane), vec2(1e-9)));
  vec3 color = mix(uLine, uAxisV, axis.x);
  color = mix(color, uAxisU, axis.y);
  alpha = max(alpha, max(axis.x, axis.y));
  gl_FragColor = vec4(color, alpha * fade * uOpacity);
  if (gl_FragColor.a < 0.004) discard;
  #include <colorspace_fragment>
}`;

const kAxisOf: Record<Exclude<PlaneKind, 'view'>, readonly [u: number, v: number]> = {
  xy: [0, 1],
  yz: [1, 2],
  zx: [2, 0],
};

export class PlaneGrid {
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;
  private colors: GridColors = { line: '#888', axes: ['#888', '#888', '#888'] };
  private kind: PlaneKind = 'xy';

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      side: DoubleSide,
      // Blended, yet among the opaque objects: drawn first, it can lie behind all of them.
      blending: CustomBlending,
      blendSrcAlpha: OneFactor,
      depthWrite: false,
      uniforms: {
        uExtent: { value: 1 },
        uStep: { value: 1 },
        uOpacity: { value: 1 },
        uLine: { value: new Color() },
        uAxisU: { value: new Color() },
        uAxisV: { value: new Color() },
      },
    });
    this.mesh = new Mesh(new PlaneGeometry(2, 2), material);
    this.mesh.frustumCulled = false;
  }

  /**
   * Lays the grid into a plane, for a scene of a radius. In use it cuts through what is there, as
   * the plane does; otherwise it is a backdrop.
   */
  place(kind: PlaneKind, frame: Frame, radius: number, isInUse: boolean, placement: Placement): void {
    this.kind = kind;
    const { material } = this.mesh;
    material.depthTest = isInUse;
    material.transparent = isInUse;
    this.mesh.renderOrder = isInUse ? 0 : -1;
    const basis = new Matrix4().makeBasis(
      new Vector3().fromArray(frame.u),
      new Vector3().fromArray(frame.v),
      new Vector3().fromArray(frame.normal),
    );
    this.mesh.quaternion.setFromRotationMatrix(basis);
    this.mesh.position.fromArray(toScene(placement, frame.origin));
    const { uniforms } = material;
    uniforms.uExtent.value = (3.2 * radius) / placement.unit;
    uniforms.uStep.value = gridStep(radius) / placement.unit;
    uniforms.uOpacity.value = isInUse ? 1 : 0.6;
    this.applyColors();
  }

  setColors(colors: GridColors): void {
    this.colors = colors;
    this.applyColors();
  }

  private applyColors(): void {
    const { uniforms } = this.mesh.material;
    const { line, axes } = this.colors;
    const [u, v] = this.kind === 'view' ? [line, line] : kAxisOf[this.kind].map((axis) => axes[axis]);
    (uniforms.uLine.value as Color).set(line);
    (uniforms.uAxisU.value as Color).set(u);
    (uniforms.uAxisV.value as Color).set(v);
  }
}

/** The round number (1, 2 or 5 times a power of ten) that divides a scene of a radius well. */
export function gridStep(radius: number): number {
  const rough = radius / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const lead = rough / power;
  return (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power;
}

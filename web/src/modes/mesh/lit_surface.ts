// Triangles of meshes and patches as they are drawn: lit on both sides, smooth or flat, with their edges, and with
// stripes as of a zebra's hide, which break where the surface has a kink.
import { BufferAttribute, BufferGeometry, Mesh, Sphere, type Color, type ShaderMaterial } from 'three';
import { colorUniforms, kCorner, kLight, kWire, setColors, surfaceMaterial } from '../../scene/glsl.ts';
import type { Attribute } from './attributes.ts';

/** More triangles than this are drawn without edges, which would need thrice the vertices. */
const kMostWired = 400_000;

const kVaryings = /* glsl */ `
#ifdef TINTED
varying vec3 vTint;
#endif
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying float vMark;`;

const kVertexShader = /* glsl */ `
${kCorner}
attribute float mark;
#ifdef TINTED
attribute vec3 tint;
#endif
${kVaryings}
void main() {
  vCorner = cornerOf(gl_VertexID);
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vEye = -eye.xyz;
  vMark = mark;
  #ifdef TINTED
  vTint = tint;
  #endif
  gl_Position = projectionMatrix * eye;
}`;

const kFragmentShader = /* glsl */ `
${kLight}
${kWire}
uniform vec3 uFront;
uniform vec3 uBack;
uniform vec3 uMark;
uniform vec3 uWire;
uniform float uWireOpacity;
uniform float uSmooth;
uniform float uZebra;
${kVaryings}
void main() {
  vec3 toEye = normalize(vEye);
  vec3 flatNormal = normalize(cross(dFdx(vEye), dFdy(vEye)));
  bool front = gl_FrontFacing;
  vec3 n = uSmooth > 0.5 && dot(vNormal, vNormal) > 0.0 ? normalize(vNormal) * (front ? 1.0 : -1.0) : flatNormal;
  if (dot(flatNormal, toEye) < 0.0 && uSmooth < 0.5) n = -n;
  vec3 plain = front ? uFront : uBack;
  #ifdef TINTED
  plain = vTint;
  #endif
  vec3 base = mix(plain, uMark, vMark);
  vec3 color = base * lightOn(n, vec3(0.42, 0.56, 0.16));
  color += 0.06 * glossOn(n, toEye);
  float along = 9.0 * reflect(-toEye, n).y;
  float width = fwidth(along) + 1e-4;
  float stripe = smoothstep(-width, width, abs(fract(along) - 0.5) - 0.25);
  color *= 1.0 - uZebra * 0.72 * stripe;
  color = mix(color, uWire, uWireOpacity * wireAt(vCorner, 0.12, 0.6));
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`;

export interface SurfaceLook {
  readonly front: Color;
  readonly back: Color;
  readonly mark: Color;
  readonly wire: Color;
  readonly wires: boolean;
  readonly smooth: boolean;
  /** Whether colours of vertices are shown, where there are any. */
  readonly colored: boolean;
  /** 0 to 1. */
  readonly zebra: number;
}

/** In the scene. */
export interface SceneTriangles {
  /** `[3n]` */
  readonly positions: Float32Array;
  /** `[3m]` */
  readonly faces: Uint32Array;
  /** Of the vertices. */
  readonly colors: Attribute | null;
  /** Numbers of triangles in the colour of marks. */
  readonly marked?: ReadonlySet<number>;
}

export class LitSurface {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  private shown: SceneTriangles | null = null;
  private normals: Float32Array | null = null;
  private isSpread = false;
  private isColored = false;

  /** @param order surfaces of a higher one lie before others at the same place */
  constructor(
    order: number,
    private readonly wireOpacity: number,
  ) {
    const material = surfaceMaterial(kVertexShader, kFragmentShader, 2 - order, {
      ...colorUniforms('uFront', 'uBack', 'uMark', 'uWire'),
      uWireOpacity: { value: 0 },
      uSmooth: { value: 1 },
      uZebra: { value: 0 },
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  set(next: SceneTriangles | null): void {
    if (next === this.shown) return;
    this.shown = next;
    this.normals = null;
    this.build();
  }

  setLook(look: SurfaceLook): void {
    const { uniforms } = this.object.material;
    setColors(this.object.material, { uFront: look.front, uBack: look.back, uMark: look.mark, uWire: look.wire });
    uniforms.uSmooth.value = look.smooth ? 1 : 0;
    uniforms.uZebra.value = look.zebra;
    if (this.isSpread === look.wires && this.isColored === look.colored) return;
    this.isSpread = look.wires;
    this.isColored = look.colored;
    this.build();
  }

  private build(): void {
    const { shown, object } = this;
    object.geometry.dispose();
    const geometry = new BufferGeometry();
    // Else three would look at all vertices for one.
    geometry.boundingSphere = new Sphere();
    object.geometry = geometry;
    object.visible = shown !== null && shown.faces.length > 0;
    if (shown === null) return;
    const { positions, faces, marked, colors } = shown;
    const isTinted = colors !== null && this.isColored;
    if (isTinted !== 'TINTED' in object.material.defines) {
      object.material.defines = isTinted ? { TINTED: '' } : {};
      object.material.needsUpdate = true;
    }
    const isWired = this.isSpread && faces.length <= 3 * kMostWired;
    object.material.uniforms.uWireOpacity.value = isWired ? this.wireOpacity : 0;
    const normals = (this.normals ??= normalsOf(positions, faces));
    const put = isWired || marked ? (values: Float32Array) => spread(values, faces) : (values: Float32Array) => values;
    geometry.setAttribute('position', new BufferAttribute(put(positions), 3));
    geometry.setAttribute('normal', new BufferAttribute(put(normals), 3));
    if (isTinted) geometry.setAttribute('tint', new BufferAttribute(put(tintsOf(colors)), 3));
    if (isWired || marked) {
      if (marked && marked.size > 0) {
        const mark = new Float32Array(faces.length);
        for (const face of marked) mark.fill(1, 3 * face, 3 * face + 3);
        geometry.setAttribute('mark', new BufferAttribute(mark, 1));
      }
    } else geometry.setIndex(new BufferAttribute(faces, 1));
  }
}

/** Colours as the scene reckons with them: in proportion to light. */
function tintsOf({ data, size }: Attribute): Float32Array {
  const tints = new Float32Array((3 * data.length) / size);
  for (let i = 0; i < tints.length; i++) {
    const value = Math.min(1, Math.max(0, data[size * ((i / 3) | 0) + (i % 3)]));
    tints[i] = value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }
  return tints;
}

/** Of each corner what its vertex has. */
function spread(values: Float32Array, faces: Uint32Array): Float32Array {
  const all = new Float32Array(3 * faces.length);
  for (let i = 0; i < faces.length; i++) {
    const at = 3 * faces[i];
    all[3 * i] = values[at];
    all[3 * i + 1] = values[at + 1];
    all[3 * i + 2] = values[at + 2];
  }
  return all;
}

/** Normals of vertices, of any length: sums of those of their faces by area. */
function normalsOf(p: Float32Array, faces: Uint32Array): Float32Array {
  const normals = new Float32Array(p.length);
  for (let i = 0; i < faces.length; i += 3) {
    const [a, b, c] = [3 * faces[i], 3 * faces[i + 1], 3 * faces[i + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const at of [a, b, c]) {
      normals[at] += x;
      normals[at + 1] += y;
      normals[at + 2] += z;
    }
  }
  // Those of tiny triangles would be too short for the graphics card.
  for (let at = 0; at < normals.length; at += 3) {
    const length = Math.hypot(normals[at], normals[at + 1], normals[at + 2]) || 1;
    normals[at] /= length;
    normals[at + 1] /= length;
    normals[at + 2] /= length;
  }
  return normals;
}

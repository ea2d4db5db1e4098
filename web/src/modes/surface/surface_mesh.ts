// The mesh on the graphics card. In plain colours an update uploads only the ranges that it has written; colours of triangles and the
// edges of triangles need corners of their own, and are built anew.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, Sphere, type ShaderMaterial } from 'three';
import type { Change } from 'soapfilm/surfaces';
import { colorUniforms, kCorner, kLight, kWire, setColors, surfaceMaterial } from '../../scene/glsl.ts';
import type { Painted } from './paint.ts';

/** More triangles than this are drawn without edges and in plain colours. */
const kMostSpread = 600_000;

const kVaryings = /* glsl */ `
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying vec2 vUv;
varying vec3 vTint;`;

const kVertexShader = /* glsl */ `
${kCorner}
attribute vec3 tint;
${kVaryings}
void main() {
  vCorner = cornerOf(gl_VertexID);
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vEye = -eye.xyz;
  vUv = uv;
  vTint = tint;
  gl_Position = projectionMatrix * eye;
}`;

const kFragmentShader = /* glsl */ `
${kLight}
${kWire}
uniform vec3 uFront;
uniform vec3 uBack;
uniform vec3 uWire;
uniform float uWireOpacity;
uniform float uSmooth;
uniform float uTinted;
uniform float uChecks;
${kVaryings}
void main() {
  vec3 toEye = normalize(vEye);
  vec3 flatNormal = normalize(cross(dFdx(vEye), dFdy(vEye)));
  if (dot(flatNormal, toEye) < 0.0) flatNormal = -flatNormal;
  vec3 n = flatNormal;
  if (uSmooth > 0.5 && dot(vNormal, vNormal) > 0.0) {
    n = normalize(vNormal);
    if (dot(n, flatNormal) < 0.0) n = -n;
  }
  bool isOutside = dot(vNormal, toEye) >= 0.0;
  vec3 base = mix(isOutside ? uFront : uBack, vTint, uTinted);
  vec2 check = step(0.5, fract(8.0 * vUv));
  base *= 1.0 - 0.35 * uChecks * abs(check.x - check.y);
  vec3 color = base * lightOn(n, vec3(0.42, 0.56, 0.16)) + 0.06 * glossOn(n, toEye);
  color = mix(color, uWire, uWireOpacity * wireAt(vCorner, 0.12, 0.6));
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`;

export interface MeshLook {
  readonly front: string;
  readonly back: string;
  readonly wire: string;
  readonly wires: boolean;
  readonly smooth: boolean;
  readonly checks: boolean;
  /** The colours of a mesh's triangles; null: all have those above. */
  readonly paint: (mesh: Change['mesh']) => Painted | null;
}

export class SurfaceMesh {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  private shown: Change['mesh'] | null = null;
  private isPlain = true;
  private tints = new Float32Array(0);
  /** Bytes that the last change has sent. */
  uploaded = 0;

  constructor() {
    const material = surfaceMaterial(kVertexShader, kFragmentShader, 2, {
      ...colorUniforms('uFront', 'uBack', 'uWire'),
      uWireOpacity: { value: 0 },
      uSmooth: { value: 1 },
      uTinted: { value: 0 },
      uChecks: { value: 0 },
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
  }

  /** Shows a mesh as a change has left it. */
  update(change: Change | null, look: MeshLook): void {
    const { object } = this;
    const { uniforms } = object.material;
    setColors(object.material, { uFront: look.front, uBack: look.back, uWire: look.wire });
    const mesh = change?.mesh ?? null;
    object.visible = mesh !== null;
    if (change === null || mesh === null) {
      this.shown = null;
      return;
    }
    const isSmall = mesh.triangles.length <= 3 * kMostSpread;
    const colors = isSmall ? look.paint(mesh) : null;
    const isSpread = colors !== null || (isSmall && look.wires);
    uniforms.uSmooth.value = look.smooth ? 1 : 0;
    uniforms.uWireOpacity.value = isSpread && look.wires ? 0.42 : 0;
    uniforms.uTinted.value = colors ? 1 : 0;
    uniforms.uChecks.value = look.checks ? 1 : 0;
    if (isSpread) this.spread(mesh, colors);
    else this.patch(change);
    this.isPlain = !isSpread;
    this.shown = mesh;
  }

  /** Into the buffers that there are, where they still fit. */
  private patch({ mesh, vertexRanges, indexRanges }: Change): void {
    const { geometry } = this.object;
    const isSame = this.isPlain && this.shown !== null && this.shown.positions === mesh.positions && this.shown.triangles === mesh.triangles;
    if (!isSame) {
      this.tints = new Float32Array(mesh.positions.length);
      const attribute = (array: Float32Array, size: number): BufferAttribute => new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
      const index = new BufferAttribute(mesh.triangles, 1).setUsage(DynamicDrawUsage);
      this.replace({ position: attribute(mesh.positions, 3), normal: attribute(mesh.normals, 3), uv: attribute(mesh.uvs, 2), tint: attribute(this.tints, 3) }, index);
      this.uploaded = 4 * (mesh.positions.length + mesh.normals.length + mesh.uvs.length + mesh.triangles.length);
      return;
    }
    this.uploaded = 0;
    const send = (attribute: BufferAttribute, ranges: Uint32Array, size: number): void => {
      attribute.clearUpdateRanges();
      for (let i = 0; i < ranges.length; i += 2) {
        const [from, count] = [size * ranges[i], size * (ranges[i + 1] - ranges[i])];
        attribute.addUpdateRange(from, count);
        this.uploaded += 4 * count;
      }
      if (ranges.length > 0) attribute.needsUpdate = true;
    };
    for (const name of ['position', 'normal', 'uv']) {
      const attribute = geometry.getAttribute(name) as BufferAttribute;
      send(attribute, vertexRanges, attribute.itemSize);
    }
    if (geometry.index) send(geometry.index, indexRanges, 1);
  }

  /** Corner by corner, where the triangles of one vertex differ in colour or have edges. */
  private spread(mesh: Change['mesh'], colors: Painted | null): void {
    const triangles = colors?.triangles ?? mesh.triangles;
    const tints = colors?.tints ?? new Float32Array(3 * triangles.length);
    const put = (values: Float32Array, size: number): BufferAttribute => {
      const all = new Float32Array(size * triangles.length);
      for (let i = 0; i < triangles.length; i++) for (let k = 0; k < size; k++) all[size * i + k] = values[size * triangles[i] + k];
      return new BufferAttribute(all, size);
    };
    this.replace({ position: put(mesh.positions, 3), normal: put(mesh.normals, 3), uv: put(mesh.uvs, 2), tint: new BufferAttribute(tints, 3) }, null);
    this.uploaded = 44 * triangles.length;
  }

  private replace(attributes: Readonly<Record<string, BufferAttribute>>, index: BufferAttribute | null): void {
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    // Else three would look at all vertices for one.
    geometry.boundingSphere = new Sphere();
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
    this.object.geometry = geometry;
  }
}

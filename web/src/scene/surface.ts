// A surface in space: lit on both sides, with its edges, growing triangle by triangle.
import { BufferAttribute, BufferGeometry, Mesh, Vector3, type ShaderMaterial } from 'three';
import { colorUniforms, kCorner, kLight, setColors, surfaceMaterial } from './glsl.ts';
import { toScene, type Placement } from './placement.ts';
import type { SurfaceColors } from './theme.ts';

/** Share of the whole growth that one triangle takes to unfold. */
const kUnfold = 0.16;

const kVertexShader = /* glsl */ `
${kCorner}
attribute vec3 center;
attribute float birth;
uniform float uTime;
uniform float uUnfold;
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying float vAge;
void main() {
  vAge = clamp((uTime - birth) / uUnfold, 0.0, 1.0);
  float grown = 1.0 - pow(1.0 - vAge, 3.0);
  vec4 eye = modelViewMatrix * vec4(mix(center, position, grown), 1.0);
  vNormal = normalMatrix * normal;
  vEye = -eye.xyz;
  vCorner = cornerOf(gl_VertexID);
  gl_Position = projectionMatrix * eye;
}`;

// Seen aslant, the colour runs through a few bands as a thin film's does, faintly.
const kFragmentShader = /* glsl */ `
${kLight}
uniform vec3 uFront;
uniform vec3 uBack;
uniform vec3 uWire;
uniform vec3 uGlow;
uniform float uWireWidth;
uniform float uWireOpacity;
uniform float uOpacity;
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying float vAge;
void main() {
  vec3 toEye = normalize(vEye);
  vec3 n = normalize(vNormal);
  bool front = dot(n, toEye) >= 0.0;
  if (!front) n = -n;
  float facing = clamp(dot(n, toEye), 0.0, 1.0);
  vec3 color = (front ? uFront : uBack) * lightOn(n, vec3(0.5, 0.52, 0.14));
  float aslant = pow(1.0 - facing, 1.5);
  vec3 film = 0.5 + 0.5 * cos(6.2832 * (1.3 * facing + vec3(0.05, 0.38, 0.72)));
  color *= mix(vec3(1.0), 0.74 + 0.56 * film, 0.12 + 0.6 * aslant);
  color += 0.12 * glossOn(n, toEye);
  vec3 perPixel = fwidth(vCorner);
  vec3 inside = smoothstep(perPixel * (uWireWidth - 0.6), perPixel * (uWireWidth + 0.6), vCorner);
  float wire = 1.0 - min(min(inside.x, inside.y), inside.z);
  color = mix(color, uWire, wire * uWireOpacity);
  color = mix(color, uGlow, 0.75 * (1.0 - vAge) * (1.0 - vAge));
  gl_FragColor = vec4(color, uOpacity);
  #include <colorspace_fragment>
}`;

/** Triangles of vertices `[3n]`, and the order in which they grow in: each triangle once. */
export interface Surface {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
  readonly order: Uint32Array;
}

export class SurfaceMesh {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;

  constructor() {
    const material = surfaceMaterial(kVertexShader, kFragmentShader, 2, {
      uTime: { value: 1 + kUnfold },
      uUnfold: { value: kUnfold },
      ...colorUniforms('uFront', 'uBack', 'uWire', 'uGlow'),
      uWireWidth: { value: 0.6 },
      uWireOpacity: { value: 0.6 },
      uOpacity: { value: 1 },
    });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.visible = false;
    // The bounds would be of the full-grown surface only after it has been uploaded.
    this.mesh.frustumCulled = false;
  }

  setSurface(surface: Surface, placement: Placement): void {
    const m = surface.order.length;
    const position = new Float32Array(9 * m);
    const normal = new Float32Array(9 * m);
    const center = new Float32Array(9 * m);
    const birth = new Float32Array(3 * m);
    const [a, b, c, n, g] = [new Vector3(), new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    surface.order.forEach((triangle, rank) => {
      [a, b, c].forEach((point, i) => {
        const at = 3 * surface.triangles[3 * triangle + i];
        const [x, y, z] = surface.positions.subarray(at, at + 3);
        point.set(...toScene(placement, [x, y, z]));
      });
      g.copy(a).add(b).add(c).divideScalar(3);
      n.copy(b).sub(a).cross(g.copy(c).sub(a)).normalize();
      g.copy(a).add(b).add(c).divideScalar(3);
      [a, b, c].forEach((point, i) => {
        const at = 9 * rank + 3 * i;
        point.toArray(position, at);
        n.toArray(normal, at);
        g.toArray(center, at);
        birth[3 * rank + i] = rank / m;
      });
    });
    this.mesh.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('normal', new BufferAttribute(normal, 3));
    geometry.setAttribute('center', new BufferAttribute(center, 3));
    geometry.setAttribute('birth', new BufferAttribute(birth, 1));
    this.mesh.geometry = geometry;
  }

  /** 0: nothing of it is there yet; 1: all of it. */
  setGrowth(share: number): void {
    this.mesh.material.uniforms.uTime.value = share * (1 + kUnfold);
  }

  setColors({ front, back, wire, glow }: SurfaceColors): void {
    setColors(this.mesh.material, { uFront: front, uBack: back, uWire: wire, uGlow: glow });
  }

  /** A stale surface fades while the next one is computed. */
  setLook(look: { wires: boolean; faded: boolean }): void {
    const { material } = this.mesh;
    material.uniforms.uWireOpacity.value = look.wires ? 0.6 : 0;
    material.uniforms.uOpacity.value = look.faded ? 0.3 : 1;
    material.transparent = look.faded;
    material.depthWrite = !look.faded;
  }
}

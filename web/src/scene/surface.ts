// A surface in space: lit on both sides, with its edges, growing triangle by triangle.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, Vector3 } from 'three';
import { toScene, type Placement } from './placement.ts';
import type { SurfaceColors } from './theme.ts';

/** Share of the whole growth that one triangle takes to unfold. */
const kUnfold = 0.16;

const kVertexShader = /* glsl */ `
attribute vec3 center;
attribute vec3 corner;
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
  vCorner = corner;
  gl_Position = projectionMatrix * eye;
}`;

// Light comes from over the viewer's left shoulder and from the sky. Seen aslant, the colour runs
// through a few bands as a thin film's does, faintly.
const kFragmentShader = /* glsl */ `
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
  float key = clamp(dot(n, normalize(vec3(-0.45, 0.65, 0.7))), 0.0, 1.0);
  float fill = clamp(dot(n, normalize(vec3(0.8, -0.1, 0.45))), 0.0, 1.0);
  vec3 base = front ? uFront : uBack;
  vec3 color = base * (0.5 + 0.52 * key + 0.14 * fill);
  float aslant = pow(1.0 - facing, 1.5);
  vec3 film = 0.5 + 0.5 * cos(6.2832 * (1.3 * facing + vec3(0.05, 0.38, 0.72)));
  color *= mix(vec3(1.0), 0.74 + 0.56 * film, 0.12 + 0.6 * aslant);
  vec3 h = normalize(normalize(vec3(-0.45, 0.65, 0.7)) + toEye);
  color += 0.12 * pow(clamp(dot(n, h), 0.0, 1.0), 32.0);
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
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      side: DoubleSide,
      // Pushed back, so that the curves and their vertices lie on it unbroken.
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
      uniforms: {
        uTime: { value: 1 + kUnfold },
        uUnfold: { value: kUnfold },
        uFront: { value: new Color() },
        uBack: { value: new Color() },
        uWire: { value: new Color() },
        uGlow: { value: new Color() },
        uWireWidth: { value: 0.6 },
        uWireOpacity: { value: 0.6 },
        uOpacity: { value: 1 },
      },
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
    const corner = new Float32Array(9 * m);
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
        corner[at + i] = 1;
        birth[3 * rank + i] = rank / m;
      });
    });
    this.mesh.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('normal', new BufferAttribute(normal, 3));
    geometry.setAttribute('center', new BufferAttribute(center, 3));
    geometry.setAttribute('corner', new BufferAttribute(corner, 3));
    geometry.setAttribute('birth', new BufferAttribute(birth, 1));
    this.mesh.geometry = geometry;
  }

  /** 0: nothing of it is there yet; 1: all of it. */
  setGrowth(share: number): void {
    this.mesh.material.uniforms.uTime.value = share * (1 + kUnfold);
  }

  setColors(colors: SurfaceColors): void {
    const { uniforms } = this.mesh.material;
    (uniforms.uFront.value as Color).set(colors.front);
    (uniforms.uBack.value as Color).set(colors.back);
    (uniforms.uWire.value as Color).set(colors.wire);
    (uniforms.uGlow.value as Color).set(colors.glow);
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

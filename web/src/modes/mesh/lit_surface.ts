// Triangles of meshes and patches as they are drawn: lit on both sides, smooth or flat, with their edges, and with
// stripes as of a zebra's hide, which break where the surface has a kink.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, Sphere } from 'three';

/** More triangles than this are drawn without edges, which would need thrice the vertices. */
const kMostWired = 400_000;

const kVertexShader = /* glsl */ `
attribute float mark;
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying float vMark;
void main() {
  int corner = gl_VertexID % 3;
  vCorner = vec3(float(corner == 0), float(corner == 1), float(corner == 2));
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vEye = -eye.xyz;
  vMark = mark;
  gl_Position = projectionMatrix * eye;
}`;

// Light comes from over the viewer's left shoulder and from the sky, as on films.
const kFragmentShader = /* glsl */ `
uniform vec3 uFront;
uniform vec3 uBack;
uniform vec3 uMark;
uniform vec3 uWire;
uniform float uWireOpacity;
uniform float uSmooth;
uniform float uZebra;
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vCorner;
varying float vMark;
void main() {
  vec3 toEye = normalize(vEye);
  vec3 flatNormal = normalize(cross(dFdx(vEye), dFdy(vEye)));
  bool front = gl_FrontFacing;
  vec3 n = uSmooth > 0.5 && dot(vNormal, vNormal) > 0.0 ? normalize(vNormal) * (front ? 1.0 : -1.0) : flatNormal;
  if (dot(flatNormal, toEye) < 0.0 && uSmooth < 0.5) n = -n;
  float key = clamp(dot(n, normalize(vec3(-0.45, 0.65, 0.7))), 0.0, 1.0);
  float fill = clamp(dot(n, normalize(vec3(0.8, -0.1, 0.45))), 0.0, 1.0);
  vec3 base = mix(front ? uFront : uBack, uMark, vMark);
  vec3 color = base * (0.42 + 0.56 * key + 0.16 * fill);
  vec3 h = normalize(normalize(vec3(-0.45, 0.65, 0.7)) + toEye);
  color += 0.06 * pow(clamp(dot(n, h), 0.0, 1.0), 32.0);
  float along = 9.0 * reflect(-toEye, n).y;
  float width = fwidth(along) + 1e-4;
  float stripe = smoothstep(-width, width, abs(fract(along) - 0.5) - 0.25);
  color *= 1.0 - uZebra * 0.72 * stripe;
  vec3 perPixel = fwidth(vCorner);
  vec3 inside = smoothstep(perPixel * -0.125, perPixel * 0.875, vCorner);
  // Edges of triangles that are lower than a few pixels fade, else they would cover everything.
  vec3 strength = (1.0 - inside) * (1.0 - smoothstep(0.12, 0.6, perPixel));
  color = mix(color, uWire, uWireOpacity * max(max(strength.x, strength.y), strength.z));
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
  /** 0 to 1. */
  readonly zebra: number;
}

/** In the scene. */
export interface SceneTriangles {
  /** `[3n]` */
  readonly positions: Float32Array;
  /** `[3m]` */
  readonly faces: Uint32Array;
  /** Numbers of triangles in the colour of marks. */
  readonly marked?: ReadonlySet<number>;
}

export class LitSurface {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  private shown: SceneTriangles | null = null;
  private normals: Float32Array | null = null;
  private isSpread = false;

  /** @param order surfaces of a higher one lie before others at the same place */
  constructor(
    order: number,
    private readonly wireOpacity: number,
  ) {
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      side: DoubleSide,
      // Pushed back, so that rims lie on it unbroken.
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2 - order,
      uniforms: {
        uFront: { value: new Color() },
        uBack: { value: new Color() },
        uMark: { value: new Color() },
        uWire: { value: new Color() },
        uWireOpacity: { value: 0 },
        uSmooth: { value: 1 },
        uZebra: { value: 0 },
      },
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
    (uniforms.uFront.value as Color).copy(look.front);
    (uniforms.uBack.value as Color).copy(look.back);
    (uniforms.uMark.value as Color).copy(look.mark);
    (uniforms.uWire.value as Color).copy(look.wire);
    uniforms.uSmooth.value = look.smooth ? 1 : 0;
    uniforms.uZebra.value = look.zebra;
    if (this.isSpread === look.wires) return;
    this.isSpread = look.wires;
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
    const { positions, faces, marked } = shown;
    const isWired = this.isSpread && faces.length <= 3 * kMostWired;
    object.material.uniforms.uWireOpacity.value = isWired ? this.wireOpacity : 0;
    const normals = (this.normals ??= normalsOf(positions, faces));
    if (isWired || marked) {
      geometry.setAttribute('position', new BufferAttribute(spread(positions, faces), 3));
      geometry.setAttribute('normal', new BufferAttribute(spread(normals, faces), 3));
      if (marked && marked.size > 0) {
        const mark = new Float32Array(faces.length);
        for (const face of marked) mark.fill(1, 3 * face, 3 * face + 3);
        geometry.setAttribute('mark', new BufferAttribute(mark, 1));
      }
    } else {
      geometry.setAttribute('position', new BufferAttribute(positions, 3));
      geometry.setAttribute('normal', new BufferAttribute(normals, 3));
      geometry.setIndex(new BufferAttribute(faces, 1));
    }
  }
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

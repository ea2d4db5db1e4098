// Triangles in the plane, flat, with their edges; some of them in colours of their own.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, Sphere, SRGBColorSpace } from 'three';
import { kCorner, kWire } from '../../scene/glsl.ts';
import type { Placement } from '../../scene/placement.ts';
import type { SurfaceColors } from '../../scene/theme.ts';

/** Colours of strips, by turns; so many that neighbours hardly ever share one. */
const kHues = 24;

// Tint 0 is the plain colour. The corners of each triangle are three vertices that no other one has.
const kVertexShader = /* glsl */ `
${kCorner}
attribute float tint;
uniform vec3 uColors[${kHues + 1}];
varying vec3 vColor;
varying vec3 vCorner;
void main() {
  vCorner = cornerOf(gl_VertexID);
  vColor = uColors[int(tint)];
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const kFragmentShader = /* glsl */ `
${kWire}
uniform vec3 uWire;
uniform float uWireOpacity;
varying vec3 vColor;
varying vec3 vCorner;
void main() {
  float wire = wireAt(vCorner, 0.3, 1.2);
  gl_FragColor = vec4(mix(vColor, uWire, wire * uWireOpacity), 1.0);
  #include <colorspace_fragment>
}`;

export class Fill {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  private shown = Infinity;
  private readonly colors = [new Color(), ...Array.from({ length: kHues }, (_, i) => hue(i))];

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      // Every other triangle of a strip runs the other way round.
      side: DoubleSide,
      depthTest: false,
      depthWrite: false,
      uniforms: { uColors: { value: this.colors }, uWire: { value: new Color() }, uWireOpacity: { value: 1 } },
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    // Below all lines.
    this.object.renderOrder = -1;
  }

  /**
   * @param positions `[2n]`
   * @param triangles `[3m]`
   * @param strips `[m]` the strip of each triangle, which has a colour of its own; absent: all have the plain one
   */
  setTriangles(positions: Float64Array, triangles: Uint32Array, placement: Placement, strips?: Uint32Array): void {
    const { center, unit } = placement;
    const count = triangles.length;
    const position = new Float32Array(2 * count);
    for (let i = 0; i < count; i++) {
      const at = 2 * triangles[i];
      position[2 * i] = (positions[at] - center[0]) / unit;
      position[2 * i + 1] = (positions[at + 1] - center[1]) / unit;
    }
    const tint = new Float32Array(count);
    if (strips) for (let i = 0; i < count; i++) tint[i] = 1 + (strips[(i / 3) | 0] % kHues);
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 2));
    geometry.setAttribute('tint', new BufferAttribute(tint, 1));
    // Else three would look at all vertices for one.
    geometry.boundingSphere = new Sphere();
    this.object.geometry = geometry;
    this.showFirst(this.shown);
  }

  /** Shows only so many triangles, the first, from now on. */
  showFirst(count: number): void {
    this.shown = count;
    this.object.geometry.setDrawRange(0, 3 * count);
  }

  setLook({ front, wire }: SurfaceColors, wires: boolean): void {
    const { uniforms } = this.object.material;
    this.colors[0].set(front);
    (uniforms.uWire.value as Color).set(wire);
    uniforms.uWireOpacity.value = wires ? 1 : 0;
  }
}

/** By the golden angle, so that strips made one after the other look unlike. */
function hue(i: number): Color {
  return new Color().setHSL(((i * 137.5) % 360) / 360, 0.65, i % 2 ? 0.62 : 0.72, SRGBColorSpace);
}

/** The triangles of strips, without those that only lead on, and the strip of each. */
export function trianglesOfStrips(strips: Uint32Array, stripStarts: Uint32Array): { triangles: Uint32Array; stripOf: Uint32Array } {
  const triangles = new Uint32Array(3 * strips.length);
  const stripOf = new Uint32Array(strips.length);
  let count = 0;
  for (let s = 0; s + 1 < stripStarts.length; s++) {
    for (let i = stripStarts[s]; i + 2 < stripStarts[s + 1]; i++) {
      const [a, b, c] = [strips[i], strips[i + 1], strips[i + 2]];
      if (a === b || b === c || a === c) continue;
      triangles[3 * count] = a;
      triangles[3 * count + 1] = b;
      triangles[3 * count + 2] = c;
      stripOf[count++] = s;
    }
  }
  return { triangles: triangles.subarray(0, 3 * count), stripOf: stripOf.subarray(0, count) };
}

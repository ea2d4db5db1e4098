// Lines of a width in pixels. Each segment is a quad of its own, not an instance: where the processor draws, instances
// take ten times as long.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, ShaderMaterial, Sphere, Vector2, Vector4 } from 'three';
import type { Point } from '../shapes/vec.ts';
import { lineCount, type Lines } from '../shapes/lines.ts';
import { toScene, type Placement } from './placement.ts';

export interface LineLook {
  /** Absent: each segment has a colour of its own. */
  readonly color?: string;
  /** In CSS pixels. */
  readonly width: number;
  /** Drawn over everything else. */
  readonly isOnTop?: boolean;
  /** Among lines: higher ones later, and a little nearer. */
  readonly order?: number;
}

// Of the four vertices of a segment two are at either end, and reach out from it by half the width to the side and
// beyond; what lies outside of the round ends is left out. Depth runs evenly over the screen, as it does without `w`.
const kVertexShader = /* glsl */ `
attribute vec3 other;
#ifdef TINTED
attribute vec3 tint;
varying vec3 vTint;
#endif
uniform vec2 uSize;
uniform float uHalf;
uniform float uNearer;
varying vec2 vFromEnd;
varying float vLength;
void main() {
  vec4 here = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 there = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
  // How far before the near plane: what lies behind it is cut off.
  float a = here.z + here.w;
  float b = there.z + there.w;
  bool isCut = a < 0.0 && b < 0.0;
  if (a < 0.0) here = mix(here, there, a / (a - b));
  else if (b < 0.0) there = mix(there, here, b / (b - a));
  vec3 end = here.xyz / here.w;
  vec2 along = (there.xy / there.w - end.xy) * uSize / 2.0;
  float reach = length(along);
  vec2 unit = reach > 0.0 ? along / reach : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? 1.0 : -1.0;
  bool isFirst = (gl_VertexID & 2) == 0;
  end.xy += (side * vec2(-unit.y, unit.x) - unit) * uHalf * 2.0 / uSize;
  vFromEnd = vec2(isFirst ? -uHalf : reach + uHalf, isFirst ? side : -side);
  vFromEnd.y *= uHalf;
  vLength = reach;
  #ifdef TINTED
  vTint = tint;
  #endif
  gl_Position = isCut ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(end.xy, end.z - uNearer, 1.0);
}`;

const kFragmentShader = /* glsl */ `
#ifdef TINTED
varying vec3 vTint;
#else
uniform vec3 uColor;
#endif
uniform float uHalf;
varying vec2 vFromEnd;
varying float vLength;
void main() {
  float beyond = max(-vFromEnd.x, vFromEnd.x - vLength);
  if (beyond > 0.0 && length(vec2(beyond, vFromEnd.y)) > uHalf) discard;
  #ifdef TINTED
  gl_FragColor = vec4(vTint, 1.0);
  #else
  gl_FragColor = vec4(uColor, 1.0);
  #endif
  #include <colorspace_fragment>
}`;

/** `[6 segments]` the ends of all segments of closed lines, in the scene. */
export function segmentsOf(all: readonly Lines[], { center, unit }: Placement): Float32Array {
  let count = 0;
  for (const { starts } of all) count += starts[starts.length - 1];
  const ends = new Float32Array(6 * count);
  let to = 0;
  for (const lines of all) {
    const { dim, positions, starts } = lines;
    const put = (i: number): void => {
      const at = dim * i;
      ends[to++] = (positions[at] - center[0]) / unit;
      ends[to++] = (positions[at + 1] - center[1]) / unit;
      ends[to++] = ((dim === 3 ? positions[at + 2] : 0) - center[2]) / unit;
    };
    for (let line = 0; line < lineCount(lines); line++) {
      for (let i = starts[line]; i < starts[line + 1]; i++) {
        put(i);
        put(i + 1 === starts[line + 1] ? starts[line] : i + 1);
      }
    }
  }
  return ends;
}

/** The segments of a path of points, in the scene. */
export function pathOf(points: readonly Point[], isClosed: boolean, placement: Placement): Float32Array {
  const count = isClosed ? points.length : points.length - 1;
  const ends = Array.from({ length: count }, (_, i) => [
    ...toScene(placement, points[i]),
    ...toScene(placement, points[(i + 1) % points.length]),
  ]);
  return new Float32Array(ends.flat());
}

/** What a line of one order higher is nearer by, as a share of half the depth that is drawn. */
const kNearer = 4e-6;

const viewport = new Vector4();

/** One for each look, for good: the last material that goes takes its program with it, which is slow to make anew. */
const materials = new Map<string, ShaderMaterial>();

function materialFor({ color, width, isOnTop = false, order = 0 }: LineLook): ShaderMaterial {
  const key = `${color ?? 'tinted'} ${width} ${String(isOnTop)} ${order}`;
  const known = materials.get(key);
  if (known) return known;
  const made = new ShaderMaterial({
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    side: DoubleSide,
    depthTest: !isOnTop,
    ...(color === undefined && { defines: { TINTED: '' } }),
    uniforms: {
      ...(color !== undefined && { uColor: { value: new Color(color) } }),
      uHalf: { value: width / 2 },
      uNearer: { value: kNearer * order },
      uSize: { value: new Vector2() },
    },
  });
  materials.set(key, made);
  return made;
}

/** Lines that are put one after the other and dropped together. */
export class FatLines {
  readonly object = new Group();
  private lines: Mesh<BufferGeometry, ShaderMaterial>[] = [];

  /** @param tints `[3 segments]` the colour of each, where the look has none */
  put(segments: Float32Array, look: LineLook, tints?: Float32Array): void {
    if (segments.length === 0) return;
    const quads = quadsOf(segments);
    if (tints) quads.setAttribute('tint', new BufferAttribute(fourTimes(tints), 3));
    const line = new Mesh(quads, materialFor(look));
    line.frustumCulled = false;
    line.renderOrder = look.order ?? 0;
    line.onBeforeRender = (renderer) => {
      // Of the picture that is drawn: it may be an inset.
      const { z, w } = renderer.getCurrentViewport(viewport);
      (line.material.uniforms.uSize.value as Vector2).set(z, w).divideScalar(renderer.getPixelRatio());
    };
    this.lines.push(line);
    this.object.add(line);
  }

  clear(): void {
    for (const line of this.lines.splice(0)) {
      line.removeFromParent();
      line.geometry.dispose();
    }
  }
}

/** Triples, each four times in a row. */
function fourTimes(triples: Float32Array): Float32Array {
  const all = new Float32Array(4 * triples.length);
  for (let i = 0; i < all.length; i++) all[i] = triples[3 * ((i / 12) | 0) + (i % 3)];
  return all;
}

function quadsOf(segments: Float32Array): BufferGeometry {
  const count = segments.length / 6;
  const here = new Float32Array(12 * count);
  const there = new Float32Array(12 * count);
  const index = new Uint32Array(6 * count);
  for (let s = 0; s < count; s++) {
    for (let axis = 0; axis < 3; axis++) {
      const [a, b, at] = [segments[6 * s + axis], segments[6 * s + 3 + axis], 12 * s + axis];
      here[at] = here[at + 3] = there[at + 6] = there[at + 9] = a;
      there[at] = there[at + 3] = here[at + 6] = here[at + 9] = b;
    }
    const [v, at] = [4 * s, 6 * s];
    index[at] = index[at + 3] = v;
    index[at + 1] = v + 1;
    index[at + 2] = index[at + 4] = v + 2;
    index[at + 5] = v + 3;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(here, 3));
  geometry.setAttribute('other', new BufferAttribute(there, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  // Else three would look at all vertices for one.
  geometry.boundingSphere = new Sphere();
  return geometry;
}

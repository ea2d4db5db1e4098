// The curves: fat lines and round vertices, with selection, hover and faults marked.
import { BufferAttribute, BufferGeometry, Color, Group, Points, ShaderMaterial } from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Curve } from '../state/document.ts';
import type { Selection } from '../state/store.ts';
import type { Fault } from '../state/wording.ts';
import type { Point } from '../shapes/vec.ts';
import { kIdentity, toScene, type Placement } from './placement.ts';

const kPointVertexShader = /* glsl */ `
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
  gl_Position = projectionMatrix * vec4(eye.xyz * 0.994, 1.0);
  gl_PointSize = vSize + 2.0;
}`;

const kPointFragmentShader = /* glsl */ `
uniform vec3 uRim;
varying vec3 vFill;
varying float vSize;
varying float vKind;
void main() {
  vec2 p = (gl_PointCoord - 0.5) * (vSize + 2.0);
  float radius = vKind > 0.5 ? (abs(p.x) + abs(p.y)) * 0.78 : length(p);
  float edge = vSize / 2.0;
  float alpha = 1.0 - smoothstep(edge - 0.7, edge + 0.7, radius);
  if (alpha < 0.02) discard;
  float inner = 1.0 - smoothstep(edge * 0.66 - 0.7, edge * 0.66 + 0.7, radius);
  gl_FragColor = vec4(mix(uRim, vFill, inner), alpha);
  #include <colorspace_fragment>
}`;

export interface CurveColors {
  readonly line: string;
  readonly selected: string;
  readonly fault: string;
  readonly inserted: string;
  readonly rim: string;
}

export interface PenColors {
  readonly line: string;
  readonly faint: string;
}

export interface Marks {
  readonly selection: Selection | null;
  readonly hover: Selection | null;
  readonly faults: readonly Fault[];
  /** Vertices that the span put on the curves. */
  readonly inserted: readonly Point[];
  readonly vertices: boolean;
}

const kLineWidth = 3;

export class CurvesLayer {
  readonly group = new Group();
  private colors: CurveColors = { line: '#888', selected: '#888', fault: '#888', inserted: '#888', rim: '#888' };
  private lines = new Map<Curve, Line2>();
  private placement = kIdentity;
  private readonly faultEdges: Line2[] = [];
  private readonly points: Points<BufferGeometry, ShaderMaterial>;

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: kPointVertexShader,
      fragmentShader: kPointFragmentShader,
      transparent: true,
      uniforms: { uPixelRatio: { value: 1 }, uRim: { value: new Color() } },
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.renderOrder = 2;
    this.group.add(this.points);
  }

  setColors(colors: CurveColors): void {
    this.colors = colors;
    (this.points.material.uniforms.uRim.value as Color).set(colors.rim);
  }

  /** Draws the curves as they are now; a curve that is the same object keeps its line. */
  update(curves: readonly Curve[], marks: Marks, placement: Placement, pixelRatio: number): void {
    if (placement !== this.placement) {
      this.lines.forEach(drop);
      this.lines.clear();
      this.placement = placement;
    }
    const lines = new Map<Curve, Line2>();
    curves.forEach((curve, c) => {
      const line = this.lines.get(curve) ?? makeLine(curve, true, placement);
      lines.set(curve, line);
      this.group.add(line);
      const isFault = marks.faults.some((f) => f.curve === c && f.vertex === undefined);
      const isSelected = marks.selection?.curve === c;
      const isHovered = marks.hover?.curve === c;
      line.material.color.set(isFault ? this.colors.fault : isSelected ? this.colors.selected : this.colors.line);
      line.material.linewidth = kLineWidth + (isHovered || isSelected ? 0.8 : 0);
    });
    for (const [curve, line] of this.lines) if (!lines.has(curve)) drop(line);
    this.lines = lines;
    this.markFaultEdges(curves, marks.faults);
    this.markPoints(curves, marks, pixelRatio);
  }

  private markFaultEdges(curves: readonly Curve[], faults: readonly Fault[]): void {
    this.faultEdges.splice(0).forEach(drop);
    for (const { curve, vertex, isEdge } of faults) {
      const points = curves.at(curve);
      if (!isEdge || vertex === undefined || points === undefined || !(vertex in points)) continue;
      const line = makeLine([points[vertex], points[(vertex + 1) % points.length]], false, this.placement);
      line.material.color.set(this.colors.fault);
      line.material.linewidth = kLineWidth + 3;
      line.material.depthTest = false;
      line.renderOrder = 1;
      this.faultEdges.push(line);
      this.group.add(line);
    }
  }

  private markPoints(curves: readonly Curve[], marks: Marks, pixelRatio: number): void {
    const position: number[] = [];
    const fill: number[] = [];
    const size: number[] = [];
    const kind: number[] = [];
    const put = (p: Point, color: string, diameter: number, shape = 0) => {
      position.push(...toScene(this.placement, p));
      fill.push(...new Color(color).toArray());
      size.push(diameter);
      kind.push(shape);
    };
    const is = (s: Selection | null, c: number, v: number) => s?.curve === c && s.vertex === v;
    curves.forEach((curve, c) => {
      curve.forEach((point, v) => {
        const isFault = marks.faults.some((f) => f.curve === c && f.vertex === v && !f.isEdge);
        if (isFault) put(point, this.colors.fault, 14);
        else if (is(marks.selection, c, v)) put(point, this.colors.selected, 13);
        else if (is(marks.hover, c, v)) put(point, this.colors.selected, 11);
        else if (marks.vertices) put(point, marks.selection?.curve === c ? this.colors.selected : this.colors.line, 7.5);
      });
    });
    for (const point of marks.inserted) put(point, this.colors.inserted, 10, 1);
    this.points.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(position), 3));
    geometry.setAttribute('fill', new BufferAttribute(new Float32Array(fill), 3));
    geometry.setAttribute('size', new BufferAttribute(new Float32Array(size), 1));
    geometry.setAttribute('kind', new BufferAttribute(new Float32Array(kind), 1));
    this.points.geometry = geometry;
    this.points.material.uniforms.uPixelRatio.value = pixelRatio;
    this.points.visible = position.length > 0;
  }
}

/** The curve under the pen: what the hand has drawn, and the curve that it will become. */
export class PenLayer {
  readonly group = new Group();
  private lines: Line2[] = [];

  show(raw: readonly Point[], closed: readonly Point[] | null, placement: Placement, colors: PenColors): void {
    this.clear();
    if (raw.length > 1) this.add(makeLine(raw, false, placement), colors.faint, 1.5);
    if (closed) this.add(makeLine(closed, true, placement), colors.line, kLineWidth);
  }

  clear(): void {
    this.lines.splice(0).forEach(drop);
  }

  private add(line: Line2, color: string, width: number): void {
    line.material.color.set(color);
    line.material.linewidth = width;
    line.material.depthTest = false;
    line.renderOrder = 3;
    this.lines.push(line);
    this.group.add(line);
  }
}

function makeLine(points: readonly Point[], closed: boolean, placement: Placement): Line2 {
  const geometry = new LineGeometry();
  const path = closed ? [...points, points[0]] : points;
  geometry.setPositions(path.flatMap((point) => toScene(placement, point)));
  const line = new Line2(geometry, new LineMaterial({ linewidth: kLineWidth }));
  line.frustumCulled = false;
  return line;
}

function drop(line: Line2): void {
  line.removeFromParent();
  line.geometry.dispose();
  line.material.dispose();
}

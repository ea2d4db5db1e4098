// Lines of a width in pixels.
import { Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Point } from '../shapes/vec.ts';
import { lineCount, type Lines } from '../shapes/lines.ts';
import { toScene, type Placement } from './placement.ts';

export interface LineLook {
  readonly color: string;
  readonly width: number;
  /** Drawn over everything else. */
  readonly isOnTop?: boolean;
  /** Among lines: higher ones later. */
  readonly order?: number;
}

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

/** Lines that are put one after the other and dropped together. */
export class FatLines {
  readonly object = new Group();
  private lines: LineSegments2[] = [];

  put(segments: Float32Array, { color, width, isOnTop = false, order = 0 }: LineLook): void {
    if (segments.length === 0) return;
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(segments);
    const line = new LineSegments2(geometry, new LineMaterial({ color, linewidth: width, depthTest: !isOnTop }));
    line.frustumCulled = false;
    line.renderOrder = order;
    this.lines.push(line);
    this.object.add(line);
  }

  clear(): void {
    for (const line of this.lines.splice(0)) {
      line.removeFromParent();
      line.geometry.dispose();
      line.material.dispose();
    }
  }
}

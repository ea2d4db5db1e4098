// Colours of the triangles of a mesh: by face, by strip, by what they are of, and by how far they are off.
import { Color } from 'three';
import type { Change, Model } from 'soapfilm/surfaces';
import { cross, dot, normalize, scale, subtract, type Point } from '../../shapes/vec.ts';
import { pointOn } from './evaluate.ts';
import { facesIn } from './faces.ts';
import { hueOf, kBandColor, kCellColor, kDeviationRamp, type Coloring } from './looks.ts';

type Mesh = Change['mesh'];

export interface Painted {
  /** [3m] Those of the mesh, in an order of their own. */
  readonly triangles: Uint32Array;
  /** [9m] For each corner of each. */
  readonly tints: Float32Array;
}

/** null: the mesh has one colour for all triangles. */
export function paint(coloring: Coloring, mesh: Mesh, model: Model): Painted | null {
  switch (coloring) {
    case 'plain':
    case 'checks':
      return null;
    case 'faces':
      return painted(mesh.triangles, (_, face) => hued(face), mesh);
    case 'strips':
      return byStrip(mesh);
    case 'cells':
      return painted(mesh.triangles, (triangle) => (isOfCell(mesh, triangle) ? kCell : kBand), mesh);
    case 'deviation':
      return byDeviation(mesh, model);
  }
}

type Tint = readonly number[];

const hued = (i: number): Tint => new Color().setHSL(hueOf(i), 0.5, 0.62).toArray();
const kCell: Tint = new Color(kCellColor).toArray();
const kBand: Tint = new Color(kBandColor).toArray();

function painted(triangles: Uint32Array, tintOf: (triangle: number, face: number) => Tint, { faceStarts }: Mesh): Painted {
  const tints = new Float32Array(3 * triangles.length);
  for (let face = 0; face + 1 < faceStarts.length; face++) {
    for (let t = faceStarts[face]; t < faceStarts[face + 1]; t++) {
      const tint = tintOf(t, face);
      for (let k = 0; k < 3; k++) tints.set(tint, 9 * t + 3 * k);
    }
  }
  return { triangles, tints };
}

/** Whether a triangle is half of a cell of the grid: its sides run along one u and one v. The others are of the band. */
export function isOfCell({ triangles, uvs }: Pick<Mesh, 'triangles' | 'uvs'>, triangle: number): boolean {
  const corners = triangles.subarray(3 * triangle, 3 * triangle + 3);
  const isAlong = (axis: number): boolean =>
    [0, 1, 2].some((k) => uvs[2 * corners[k] + axis] === uvs[2 * corners[(k + 1) % 3] + axis]);
  return isAlong(0) && isAlong(1);
}

function byStrip({ strips, stripStarts }: Mesh): Painted {
  const triangles: number[] = [];
  const colors: number[] = [];
  for (let s = 0; s + 1 < stripStarts.length; s++) {
    for (let i = stripStarts[s]; i + 2 < stripStarts[s + 1]; i++) {
      const [a, b, c] = [strips[i], strips[i + 1], strips[i + 2]];
      if (a === b || b === c || c === a) continue;
      if ((i - stripStarts[s]) % 2 === 0) triangles.push(a, b, c);
      else triangles.push(b, a, c);
      colors.push(s);
    }
  }
  const tints = new Float32Array(3 * triangles.length);
  colors.forEach((strip, t) => {
    const tint = hued(strip);
    for (let k = 0; k < 3; k++) tints.set(tint, 9 * t + 3 * k);
  });
  return { triangles: Uint32Array.from(triangles), tints };
}

const kRamp: readonly Tint[] = kDeviationRamp.map((color) => new Color(color).toArray());

/** As shares of the largest that was measured. */
function byDeviation(mesh: Mesh, model: Model): Painted {
  const off = deviations(mesh, model);
  return painted(
    mesh.triangles,
    (triangle) => {
      const at = Math.min(1, off[triangle] / (mesh.deviation || 1)) * (kRamp.length - 1);
      const low = Math.min(kRamp.length - 2, Math.floor(at));
      return kRamp[low].map((x, k) => x + (at - low) * (kRamp[low + 1][k] - x));
    },
    mesh,
  );
}

/** [m] How far the middle of each triangle is off the surface, across the triangle. */
export function deviations({ positions, origin, triangles, uvs, faceStarts }: Mesh, model: Model): Float64Array {
  const off = new Float64Array(triangles.length / 3);
  const at = (vertex: number): Point => [positions[3 * vertex] + origin[0], positions[3 * vertex + 1] + origin[1], positions[3 * vertex + 2] + origin[2]];
  facesIn(model).forEach(({ surface, place }, face) => {
    for (let t = faceStarts[face]; t < faceStarts[face + 1]; t++) {
      const corners = triangles.subarray(3 * t, 3 * t + 3);
      const [a, b, c] = [at(corners[0]), at(corners[1]), at(corners[2])];
      const uv = [0, 1].map((axis) => (uvs[2 * corners[0] + axis] + uvs[2 * corners[1] + axis] + uvs[2 * corners[2] + axis]) / 3);
      const normal = normalize(cross(subtract(b, a), subtract(c, a)));
      const middle = scale([a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]], 1 / 3);
      const distance = Math.abs(dot(normal, subtract(place(pointOn(surface, [uv[0], uv[1]])), middle)));
      off[t] = Number.isFinite(distance) ? distance : 0;
    }
  });
  return off;
}

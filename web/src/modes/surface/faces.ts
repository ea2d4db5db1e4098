// The faces of a model with those of its instances, each where it is placed: in the order of a mesh's faces.
import type { Model, ModelFace } from 'soapfilm/surfaces';
import type { Point } from '../../shapes/vec.ts';

export interface PlacedFace {
  readonly surface: ModelFace['surface'];
  /** From the face's own model to the whole. */
  readonly place: (point: Point) => Point;
}

export function facesIn(model: Model): PlacedFace[] {
  const all: PlacedFace[] = [];
  const collect = ({ faces = [], instances = [], parts }: Model, place: PlacedFace['place']): void => {
    for (const { surface } of faces) all.push({ surface, place });
    for (const { part, matrix } of instances) {
      const of = typeof part === 'object' ? part : (parts as Readonly<Record<string | number, Model>> | undefined)?.[part];
      if (of === undefined) continue;
      const own = matrix && placeBy(matrix);
      collect(of, own ? (point) => place(own(point)) : place);
    }
  };
  collect(model, (point) => point);
  return all;
}

/** Of 12 numbers row by row, or of 16 column by column. */
function placeBy(m: ArrayLike<number>): PlacedFace['place'] {
  const [right, down] = m.length === 16 ? [4, 1] : [1, 4];
  const row = (at: number, [x, y, z]: Point): number => m[at] * x + m[at + right] * y + m[at + 2 * right] * z + m[at + 3 * right];
  return (point) => [row(0, point), row(down, point), row(2 * down, point)];
}

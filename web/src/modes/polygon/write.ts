// Polygons and their triangles as text; fetched when first wanted.
import { lineCount, type Lines } from '../../shapes/lines.ts';
import type { Triangulation } from './triangulation.ts';

/** The triangles as Wavefront OBJ, in the plane z = 0. */
export async function writeObj({ positions, triangles }: Triangulation, name: string): Promise<string> {
  const { formatObj } = await import('../../app/formats.ts');
  const n = positions.length / 2;
  const inSpace = new Float64Array(3 * n);
  for (let i = 0; i < n; i++) {
    inSpace[3 * i] = positions[2 * i];
    inSpace[3 * i + 1] = positions[2 * i + 1];
  }
  return formatObj({ positions: inSpace, triangles }, { name });
}

/** The polygons as GeoJSON: each a feature, and each ring closed by its first point. */
export function writeGeoJSON(polygons: readonly Lines[], name: string): string {
  const features = polygons.map((lines) => {
    const geometry = { type: 'Polygon', coordinates: ringsOf(lines) };
    return `  ${JSON.stringify({ type: 'Feature', properties: {}, geometry })}`;
  });
  return `{\n"type": "FeatureCollection",\n"name": ${JSON.stringify(name)},\n"features": [\n${features.join(',\n')}\n]\n}\n`;
}

function ringsOf(lines: Lines): number[][][] {
  const { positions, starts } = lines;
  return Array.from({ length: lineCount(lines) }, (_, ring) => {
    const points: number[][] = [];
    for (let i = starts[ring]; i < starts[ring + 1]; i++) points.push([positions[2 * i], positions[2 * i + 1]]);
    return points.length > 0 ? [...points, points[0]] : points;
  });
}

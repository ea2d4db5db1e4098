// smoothSurface: soap films against minimal surfaces that are known by formulas.
import { load, smoothSurface, spanLoops, type Point, type SmoothOptions, type SmoothSurface } from 'soapfilm';
import { beforeAll, expect, test } from 'vitest';

interface MinimalSurface {
  readonly name: string;
  readonly loops: readonly Point[][];
  readonly radius: number;
  readonly options: SmoothOptions;
  readonly distance: (x: number, y: number, z: number) => number;
}

const { minimalSurfaces, farthest } = (await import(new URL('../bench/minimal_surfaces.mjs', import.meta.url).href)) as {
  minimalSurfaces: readonly MinimalSurface[];
  farthest: (film: SmoothSurface, surface: MinimalSurface) => number;
};

beforeAll(() => load());

test.each(minimalSurfaces)('$name: no free vertex of a film of 5 000 triangles is farther off than a thousandth of the radius', (surface) => {
  // The boundary itself is on the surface.
  for (const loop of surface.loops) for (const [x, y, z] of loop) expect(surface.distance(x, y, z)).toBeLessThan(1e-12);
  const span = spanLoops(surface.loops, { candidates: 'delaunay' });
  if (!span.found) throw new Error(span.reason);
  const film = smoothSurface(span, { kind: 'soap-film', ...surface.options });
  expect(film.isMinimal).toBe(true);
  expect(film.collapsed.length).toBe(0);
  expect(film.triangles.length / 3).toBeGreaterThan(4500);
  expect(film.triangles.length / 3).toBeLessThan(5500);
  expect(farthest(film, surface)).toBeLessThan(1e-3);
});

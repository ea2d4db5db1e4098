// The colours of the scene, taken from the style sheet so that light and dark live in one place.
import type { CurveColors, PenColors } from './curves.ts';
import type { GridColors } from './grid.ts';
import type { SurfaceColors } from './surface.ts';

export interface Theme {
  readonly background: string;
  readonly surface: SurfaceColors;
  readonly curves: CurveColors;
  readonly grid: GridColors;
  readonly pen: PenColors;
}

export function readTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const read = (name: string) => style.getPropertyValue(name).trim();
  return {
    background: read('--scene-background'),
    surface: {
      front: read('--scene-front'),
      back: read('--scene-back'),
      wire: read('--scene-wire'),
      glow: read('--scene-glow'),
    },
    curves: {
      line: read('--scene-curve'),
      selected: read('--scene-selected'),
      fault: read('--scene-fault'),
      inserted: read('--scene-inserted'),
      rim: read('--scene-background'),
    },
    grid: { line: read('--scene-grid'), axes: [read('--axis-x'), read('--axis-y'), read('--axis-z')] },
    pen: { line: read('--scene-selected'), faint: read('--scene-grid') },
  };
}

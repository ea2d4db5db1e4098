// The colours of the scene, taken from the style sheet so that light and dark live in one place.

export interface SurfaceColors {
  readonly front: string;
  readonly back: string;
  readonly wire: string;
  readonly glow: string;
}

export interface CurveColors {
  readonly line: string;
  readonly selected: string;
  readonly fault: string;
  readonly inserted: string;
  readonly rim: string;
}

export interface GridColors {
  readonly line: string;
  readonly axes: readonly [x: string, y: string, z: string];
}

export interface Theme {
  readonly background: string;
  readonly surface: SurfaceColors;
  readonly curves: CurveColors;
  readonly grid: GridColors;
  readonly pen: { readonly line: string; readonly faint: string };
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

// How meshes, patches and rims look.
import { signal } from '@preact/signals';
import { Color, SRGBColorSpace } from 'three';
import type { Theme } from '../../scene/theme.ts';
import { shown } from '../../state/store.ts';
import type { SurfaceLook } from './lit_surface.ts';

export interface View {
  readonly rims: boolean;
  readonly zebra: boolean;
  readonly smooth: boolean;
  readonly colored: boolean;
}

/** What is shown besides what all modes can show. */
export const view = signal<View>({ rims: true, zebra: false, smooth: true, colored: true });

/** The mesh is pale, so that patches, in the colours of films, stand out. */
export function looksFor({ surface, curves }: Theme): { readonly mesh: SurfaceLook; readonly patches: SurfaceLook } {
  const { zebra, smooth, colored } = view.value;
  const common = {
    mark: new Color(curves.fault),
    wire: new Color(surface.wire),
    wires: shown.value.wires,
    smooth,
    colored,
    zebra: zebra ? 1 : 0,
  };
  return {
    mesh: { ...common, front: faded(surface.front), back: faded(surface.back) },
    patches: { ...common, front: new Color(surface.front), back: new Color(surface.back) },
  };
}

function faded(color: string): Color {
  const { h, s, l } = new Color(color).getHSL({ h: 0, s: 0, l: 0 }, SRGBColorSpace);
  return new Color().setHSL(h, 0.22 * s, l, SRGBColorSpace);
}

/** The colours of holes by their numbers: by the golden angle, so that neighbours in the list look unlike. */
export function hueOf(hole: number): number {
  return (20 + hole * 137.5) % 360;
}

export const rimColor = (hole: number, lightness: number): Color => new Color().setHSL(hueOf(hole) / 360, 0.75, lightness, SRGBColorSpace);

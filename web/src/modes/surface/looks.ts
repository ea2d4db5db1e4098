// What of meshes is shown, and how.
import { signal } from '@preact/signals';

export type Coloring = 'plain' | 'faces' | 'strips' | 'cells' | 'deviation' | 'checks';

export interface View {
  readonly edges: boolean;
  readonly smooth: boolean;
  /** A second picture, from an eye that stays where it is while the mesh follows the camera. */
  readonly second: boolean;
}

export const view = signal<View>({ edges: true, smooth: true, second: true });
export const coloring = signal<Coloring>('plain');

/** Hues by the golden angle, so that neighbours look unlike. */
export const hueOf = (i: number): number => ((i * 137.508 + 200) % 360) / 360;

/** From 0 to the largest deviation: dark to light, so that it can be read without colours. */
export const kDeviationRamp = ['#2d2a63', '#2b6f97', '#2fa98c', '#a5cf4e', '#ffe14a'] as const;

export const kCellColor = '#8fb7d9';
export const kBandColor = '#e7a04f';

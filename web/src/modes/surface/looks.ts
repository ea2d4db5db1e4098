// What of meshes is shown, and how.
import { signal } from '@preact/signals';

export type Coloring = 'plain' | 'faces' | 'strips' | 'checks';

export interface View {
  readonly edges: boolean;
  readonly smooth: boolean;
}

export const view = signal<View>({ edges: true, smooth: true });
export const coloring = signal<Coloring>('plain');

/** Hues by the golden angle, so that neighbours look unlike. */
export const hueOf = (i: number): number => ((i * 137.508 + 200) % 360) / 360;

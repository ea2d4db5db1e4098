// What the mode draws besides meshes: patches, and the rims of holes.
import { computed } from '@preact/signals';
import { Color } from 'three';
import { FatLines } from '../../scene/fat_line.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import { allToScene, type Placement } from '../../scene/placement.ts';
import type { Stage } from '../../scene/stage.ts';
import { colorsOf, joined, picked } from './attributes.ts';
import { patches } from './filling.ts';
import type { Hole } from './grouping.ts';
import { chosenHoles, found, holes, hoveredHole } from './holes.ts';
import { LitSurface, type SceneTriangles } from './lit_surface.ts';
import { looksFor, rimColor, view } from './looks.ts';
import { additionsOf, type Patch } from './patches.ts';
import type { Found, Whole } from './whole.ts';

/** In CSS pixels. */
const kRim = 2.2;
const kHoveredRim = 4.5;
const kChosenRim = 4;

/** Draws from now on whatever there is. */
export function drawHoles(stage: Stage, { root, placement }: ModeScene): void {
  const { theme } = stage;
  const [surface, rims, marked] = [new LitSurface(1, 0.55), new FatLines(), new FatLines()];
  root.add(surface.object, rims.object, marked.object);
  stage.view.follow(() => {
    const [first] = patches.value;
    surface.set(patches.value.length > 0 ? trianglesOf(first.of, patches.value, placement.value) : null);
  });
  stage.view.follow(() => {
    surface.setLook(looksFor(theme.value).patches);
  });
  const isDark = computed(() => new Color(theme.value.background).getHSL({ h: 0, s: 0, l: 0 }).l < 0.4);
  stage.view.follow(() => {
    const now = found.value;
    const { grid } = theme.value;
    rims.clear();
    if (now === null || !view.value.rims) return;
    const grey = new Color(grid.line);
    const lightness = isDark.value ? 0.62 : 0.42;
    const [ends, tints] = segmentsOf(now, holes.value, placement.value, (h) => (holes.value[h].isOpenRim ? grey : rimColor(h, lightness)));
    rims.put(ends, { width: kRim }, tints);
  });
  stage.view.follow(() => {
    const now = found.value;
    const { curves } = theme.value;
    marked.clear();
    if (now === null) return;
    const put = (of: readonly number[], width: number, order: number, colorOf: (h: number) => Color): void => {
      const [ends, tints] = segmentsOf(now, of.map((h) => holes.value[h]), placement.value, (i) => colorOf(of[i]));
      marked.put(ends, { width, isOnTop: true, order }, tints);
    };
    const selected = new Color(curves.selected);
    put(chosenHoles.value, kChosenRim, 1, () => selected);
    const hovered = hoveredHole.value;
    if (hovered !== null) put([hovered], kHoveredRim, 2, (h) => (chosenHoles.value.includes(h) ? selected : rimColor(h, 0.66)));
  });
}

/** The rims of holes as segments, and a colour for each. Broken scans have a million: no points are made on the way. */
function segmentsOf({ of, report }: Found, all: readonly Hole[], { center, unit }: Placement, colorOf: (h: number) => Color): [Float32Array, Float32Array] {
  const count = all.reduce((sum, { vertices }) => sum + vertices, 0);
  const [ends, tints] = [new Float32Array(6 * count), new Float32Array(3 * count)];
  let segment = 0;
  const put = (vertex: number, at: number): void => {
    for (let axis = 0; axis < 3; axis++) ends[at + axis] = (of.positions[3 * vertex + axis] - center[axis]) / unit;
  };
  all.forEach((hole, h) => {
    const color = colorOf(h);
    for (const loop of hole.loops) {
      const { vertices } = report.loops[loop];
      for (let i = 0; i < vertices.length; i++, segment++) {
        color.toArray(tints, 3 * segment);
        put(vertices[i], 6 * segment);
        put(vertices[i + 1 === vertices.length ? 0 : i + 1], 6 * segment + 3);
      }
    }
  });
  return [ends, tints];
}

/** The triangles of all patches, with only the vertices that they have; those that intersect something are marked. */
function trianglesOf(of: Whole, all: readonly Patch[], placement: Placement): SceneTriangles {
  const n = of.positions.length / 3;
  const crossed = [...new Set(all.flatMap((patch) => patch.crossed))];
  const { starts, count: fresh } = additionsOf(all);
  // Those of the patches come first, then those of the mesh as they are met.
  const old = new Map<number, number>();
  const numberOf = (vertex: number): number => {
    const number = old.get(vertex) ?? fresh + old.size;
    old.set(vertex, number);
    return number;
  };
  const faces = new Uint32Array(all.reduce((sum, patch) => sum + patch.faces.length, 3 * crossed.length));
  const marked = new Set<number>();
  let to = 0;
  for (const patch of all) {
    const first = starts.get(patch.added) ?? 0;
    for (const face of patch.crossing) marked.add(to / 3 + face);
    for (const vertex of patch.faces) faces[to++] = vertex < n ? numberOf(vertex) : vertex - n + first;
  }
  for (const face of crossed) {
    marked.add(to / 3);
    for (let corner = 0; corner < 3; corner++) faces[to++] = numberOf(of.faces[3 * face + corner]);
  }
  const positions = new Float32Array(3 * (fresh + old.size));
  for (const [added, first] of starts) positions.set(added.positions, 3 * first);
  for (const [vertex, number] of old) positions.set(of.positions.subarray(3 * vertex, 3 * vertex + 3), 3 * number);
  const colors = colorsOf(joined([...starts.keys(), picked(of.attributes, [...old.keys()])]));
  return { positions: allToScene(placement, positions), faces, colors, marked };
}

// What the mode draws besides meshes: patches, and the rims of holes.
import { computed } from '@preact/signals';
import { Color } from 'three';
import { FatLines } from '../../scene/fat_line.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import { allToScene, toScene, type Placement } from '../../scene/placement.ts';
import type { Stage } from '../../scene/stage.ts';
import { patches, withPatches, type Patch } from './filling.ts';
import type { Hole } from './grouping.ts';
import { chosenHoles, found, holes, hoveredHole } from './holes.ts';
import { LitSurface, type SceneTriangles } from './lit_surface.ts';
import { looksFor, rimColor, view } from './looks.ts';
import { vertexAt, type Found, type Whole } from './whole.ts';

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

/** The rims of holes as segments, and a colour for each. */
function segmentsOf({ of, report }: Found, all: readonly Hole[], placement: Placement, colorOf: (h: number) => Color): [Float32Array, Float32Array] {
  const count = all.reduce((sum, { vertices }) => sum + vertices, 0);
  const [ends, tints] = [new Float32Array(6 * count), new Float32Array(3 * count)];
  let [to, segment] = [0, 0];
  all.forEach((hole, h) => {
    const color = colorOf(h);
    for (const loop of hole.loops) {
      const { vertices } = report.loops[loop];
      for (let i = 0; i < vertices.length; i++) {
        color.toArray(tints, 3 * segment++);
        for (const vertex of [vertices[i], vertices[i + 1 === vertices.length ? 0 : i + 1]]) {
          ends.set(toScene(placement, vertexAt(of, vertex)), to);
          to += 3;
        }
      }
    }
  });
  return [ends, tints];
}

/** The triangles of all patches, with only the vertices that they have; those that intersect something are marked. */
function trianglesOf(of: Whole, all: readonly Patch[], placement: Placement): SceneTriangles {
  const { positions, faces } = withPatches(of, all);
  const first = of.faces.length;
  const crossed = [...new Set(all.flatMap((patch) => patch.crossed))];
  const corners = new Uint32Array(faces.length - first + 3 * crossed.length);
  corners.set(faces.subarray(first));
  crossed.forEach((face, i) => {
    corners.set(faces.subarray(3 * face, 3 * face + 3), faces.length - first + 3 * i);
  });
  const marked = new Set<number>();
  let at = 0;
  for (const patch of all) {
    for (const face of patch.crossing) marked.add(at + face);
    at += patch.faces.length / 3;
  }
  for (let i = 0; i < crossed.length; i++) marked.add(at + i);
  const numbers = new Map<number, number>();
  for (let i = 0; i < corners.length; i++) {
    const number = numbers.get(corners[i]) ?? numbers.size;
    numbers.set(corners[i], number);
    corners[i] = number;
  }
  const own = new Float32Array(3 * numbers.size);
  for (const [vertex, number] of numbers) own.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * number);
  return { positions: allToScene(placement, own), faces: corners, marked };
}

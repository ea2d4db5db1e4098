// What the mode draws besides rings and their vertices: triangles, what repair added, where something is wrong, and
// flooding on its way.
import { computed } from '@preact/signals';
import { Dots } from '../../scene/dots.ts';
import { FatLines, pathOf } from '../../scene/fat_line.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import type { Stage } from '../../scene/stage.ts';
import type { Point } from '../../shapes/vec.ts';
import { shown } from '../../state/store.ts';
import { Fill, trianglesOfStrips } from './fill.ts';
import { flooding } from './flooding.ts';
import { failures, triangulated } from './triangulating.ts';

/** In CSS pixels. */
const kAddedDot = 7;
const kFaultRing = 22.5;
const kChainWidth = 2.5;
const kChainDot = 10;

/** Draws from now on whatever there is. */
export function drawTriangulation({ view, theme }: Stage, { root, placement }: ModeScene): void {
  const [fill, points, chain, chainEnds] = [new Fill(), new Dots(false), new FatLines(), new Dots(false)];
  root.add(fill.object, points.object, chain.object, chainEnds.object);
  const flood = computed(() => flooding.value?.flood ?? null);

  view.follow(() => {
    const found = triangulated.value;
    if (flood.value) fill.setTriangles(flood.value.positions, flood.value.triangles, placement.value);
    else if (found && found.strips.length > 0) {
      const { triangles, stripOf } = trianglesOfStrips(found.strips, found.stripStarts);
      fill.setTriangles(found.positions, triangles, placement.value, stripOf);
    } else if (found) fill.setTriangles(found.positions, found.triangles, placement.value);
  });
  view.follow(() => {
    const now = flooding.value;
    fill.object.visible = now !== null || (triangulated.value !== null && shown.value.surface);
    fill.showFirst(now ? now.flood.steps[now.taken].triangles : Infinity);
  });
  view.follow(() => {
    fill.setLook(theme.value.surface, shown.value.wires);
  });

  view.follow(() => {
    const found = triangulated.value;
    const { curves } = theme.value;
    const dots = points.begin(placement.value);
    if (found) {
      for (let at = found.positions.length - 2 * found.added; at < found.positions.length; at += 2) {
        dots.put([found.positions[at], found.positions[at + 1], 0], curves.inserted, kAddedDot);
      }
    }
    for (const { point } of failures.value) if (point) dots.put(point, curves.fault, kFaultRing, 'ring');
    points.show(view.pixelRatio.value, curves.rim);
  });

  // The active chain's ends, and the level of the water between them.
  view.follow(() => {
    const now = flooding.value;
    const { curves } = theme.value;
    const dots = chainEnds.begin(placement.value);
    chain.clear();
    if (now) {
      const { positions, steps } = now.flood;
      const { left, right } = steps[now.taken];
      const ends = [left, right].filter((v) => 2 * v + 1 < positions.length);
      const path = ends.map((v): Point => [positions[2 * v], positions[2 * v + 1], 0]);
      if (path.length > 1) chain.put(pathOf(path, false, placement.value), { color: curves.selected, width: kChainWidth, isOnTop: true, order: 3 });
      for (const point of path) dots.put(point, curves.selected, kChainDot);
    }
    chainEnds.show(view.pixelRatio.value, curves.rim);
  });
}

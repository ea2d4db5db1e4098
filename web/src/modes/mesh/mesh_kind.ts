// The kind of object that is a mesh. Its parts are its rims, once they have been found: they are chosen, and never moved.
import { Group, type Object3D } from 'three';
import { areSame, type DrawnKind, type Drawn, type Hit, type Layer, type Marks } from '../../scene/kind.ts';
import { distanceOf, isBoxNear, shareAlong, type Eye, type Projected, type Spot } from '../../scene/eye.ts';
import { allToScene, type Placement } from '../../scene/placement.ts';
import { add, boxOfPoints, scale, subtract, type Point } from '../../shapes/vec.ts';
import type { Item } from '../../state/document.ts';
import { colorsOf, readAttributes } from './attributes.ts';
import { LitSurface } from './lit_surface.ts';
import { looksFor } from './looks.ts';
import { kMesh, type MeshShape } from './settings.ts';
import { rimsOf, shapeOf, vertexAt, type Rims } from './whole.ts';

export const meshKind: DrawnKind<MeshShape> = {
  name: kMesh,
  isFixed: true,
  boxOf: ({ positions }) => boxOfPoints(positions, 3),
  partStarts: (shape) => rimsOf(shape).starts,
  handleAt: (shape, handle) => vertexAt(shape, rimsOf(shape).vertices[handle]),
  move: (shape) => shape,
  remove: (shape) => shape,
  read: readShape,
  pick: pickRim,
  makeLayer: () => new MeshLayer(),
};

function readShape(saved: unknown): MeshShape | null {
  const { positions, faces, attributes } = (saved ?? {}) as Partial<Record<keyof MeshShape, unknown>>;
  if (!(positions instanceof Float32Array) || !(faces instanceof Uint32Array)) return null;
  const isWhole = positions.length % 3 === 0 && faces.length % 3 === 0 && positions.every(Number.isFinite);
  if (!isWhole || !faces.every((vertex) => 3 * vertex < positions.length)) return null;
  const sound = readAttributes(attributes, positions.length / 3);
  return { positions, faces, ...(sound && { attributes: sound }) };
}

/** The rims of runs whose boxes a place is near. */
function* partsNear(runs: Rims['runs'], eye: Eye, at: Spot, reach: number): Iterable<number> {
  for (const { from, to, box } of runs) {
    if (isBoxNear(box, eye, at, reach)) for (let part = from; part < to; part++) yield part;
  }
}

/** The rim nearest to a place. Of rims alike near, the one that is nearer to the eye. */
function pickRim(shape: MeshShape, eye: Eye, at: Spot, reach: number): Hit | null {
  const { starts, vertices, runs } = rimsOf(shape);
  let best: Hit | null = null;
  let least = Infinity;
  for (const part of partsNear(runs, eye, at, reach)) {
    let before: { readonly point: Point; readonly at: Projected } | null = null;
    for (let i = starts[part]; i <= starts[part + 1]; i++) {
      const point = vertexAt(shape, vertices[i < starts[part + 1] ? i : starts[part]]);
      const here = { point, at: eye.project(point) };
      if (before?.at.visible && here.at.visible) {
        const share = shareAlong(at, before.at, here.at);
        const on = { x: before.at.x + share * (here.at.x - before.at.x), y: before.at.y + share * (here.at.y - before.at.y) };
        const distance = distanceOf(on, at);
        if (distance < reach) {
          // Three pixels nearer on the screen count as much as half as near to the eye.
          const score = distance + 3 * Math.log2(eye.pixelSize(point));
          if (score < least) {
            least = score;
            best = { part, handle: null, distance, point: add(before.point, scale(subtract(here.point, before.point), share)) };
          }
        }
      }
      before = here;
    }
  }
  return best;
}

/** All meshes. */
class MeshLayer implements Layer {
  readonly object: Object3D = new Group();
  private surfaces = new Map<MeshShape, LitSurface>();
  private shown: { readonly items: readonly Item[]; readonly placement: Placement } | null = null;

  update(items: readonly Item[], _: Marks, { placement, theme }: Drawn): void {
    // Pointing at something comes here too, and changes nothing of this.
    const { shown } = this;
    const isSame = shown?.placement === placement && areSame(shown.items, items);
    if (!isSame) {
      const before = shown?.placement === placement ? this.surfaces : new Map<MeshShape, LitSurface>();
      const next = new Map<MeshShape, LitSurface>();
      for (const shape of items.map(shapeOf)) next.set(shape, before.get(shape) ?? surfaceOf(shape, placement));
      for (const [shape, surface] of this.surfaces) if (next.get(shape) !== surface) surface.set(null);
      this.object.clear();
      for (const surface of next.values()) this.object.add(surface.object);
      this.surfaces = next;
      this.shown = { items, placement };
    }
    const look = looksFor(theme).mesh;
    for (const surface of this.surfaces.values()) surface.setLook(look);
  }
}

function surfaceOf(shape: MeshShape, placement: Placement): LitSurface {
  const made = new LitSurface(0, 0.25);
  made.set({ positions: allToScene(placement, shape.positions), faces: shape.faces, colors: colorsOf(shape) });
  return made;
}

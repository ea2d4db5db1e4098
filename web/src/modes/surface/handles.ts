// What of a model can be dragged: poles of surfaces, and of trimming curves, as far as no other face depends on them.
import type { EdgeUse, Model, ModelEdge, ModelFace } from 'soapfilm/surfaces';
import type { Point } from '../../shapes/vec.ts';
import { pointOn, poleOf, stepOn } from './evaluate.ts';

export type Handle =
  | { readonly kind: 'pole'; readonly face: number; readonly pole: number }
  | { readonly kind: 'trim'; readonly face: number; readonly loop: number; readonly use: number; readonly pole: number };

/** More than these are not offered: one could not tell them apart. */
const kMostHandles = 600;

const known = new WeakMap<Model, readonly Handle[]>();

export function handlesOf(model: Model): readonly Handle[] {
  const found = known.get(model);
  if (found) return found;
  const { faces = [] } = model;
  const handles: Handle[] = [];
  const edgeAt = edgesById(model);
  // How many uses each edge has, and whether they are all of one face.
  const uses = new Map<number, { count: number; face: number | null }>();
  faces.forEach(({ loops = [] }, face) => {
    for (const { edge } of loops.flatMap((loop) => loop.uses)) {
      const before = uses.get(edge);
      uses.set(edge, { count: (before?.count ?? 0) + 1, face: before && before.face !== face ? null : face });
    }
  });
  faces.forEach(({ surface, loops = [] }, face) => {
    const isAlone = loops.every((loop) => loop.uses.every(({ edge }) => uses.get(edge)?.face === face && !edgeAt(edge)?.degenerate));
    if (isAlone) for (let pole = 0; pole < surface.poles.length; pole++) handles.push({ kind: 'pole', face, pole });
    loops.forEach((each, loop) => {
      each.uses.forEach(({ edge, pcurve }, use) => {
        if (uses.get(edge)?.count !== 1 || !pcurve || pcurve.poles.length > 40) return;
        // The last pole is the first of the next curve, or of the same one.
        for (let pole = 0; pole + 1 < pcurve.poles.length; pole++) handles.push({ kind: 'trim', face, loop, use, pole });
      });
    });
  });
  const few = handles.length <= kMostHandles ? handles : [];
  known.set(model, few);
  return few;
}

const useOf = ({ loops = [] }: ModelFace, { loop, use }: { loop: number; use: number }): EdgeUse => loops[loop].uses[use];

export function placeOf({ faces = [] }: Model, handle: Handle): Point {
  const face = faces[handle.face];
  if (handle.kind === 'pole') return Array.from(face.surface.poles[handle.pole], Number) as unknown as Point;
  const { pcurve } = useOf(face, handle);
  return pcurve ? pointOn(face.surface, poleOf(pcurve, handle.pole)) : [0, 0, 0];
}

/** The model with a handle elsewhere. Edges that moved lie where their surface has them. */
export function withMoved(model: Model, handle: Handle, by: Point): Model {
  const { faces = [], edges = [] } = model;
  const face = faces[handle.face];
  const free = new Set<number>();
  let next: ModelFace;
  if (handle.kind === 'pole') {
    const poles = face.surface.poles.slice();
    poles[handle.pole] = Array.from(poles[handle.pole], (x, axis) => (x as number) + by[axis]);
    for (const { edge } of (face.loops ?? []).flatMap((loop) => loop.uses)) free.add(edge);
    next = { ...face, surface: { ...face.surface, poles } };
  } else {
    const { pcurve } = useOf(face, handle);
    if (!pcurve) return model;
    const at = poleOf(pcurve, handle.pole);
    const step = stepOn(face.surface, at, by);
    // Poles of the loop at the same place move along: ends that meet.
    const near = 1e-9 * (1 + Math.abs(at[0]) + Math.abs(at[1]));
    const loops = (face.loops ?? []).map((loop, l) =>
      l !== handle.loop
        ? loop
        : {
            uses: loop.uses.map((use) => {
              if (!use.pcurve) return use;
              const last = use.pcurve.poles.length - 1;
              const poles = use.pcurve.poles.map((pole, k) => {
                const isIt = use.pcurve === pcurve && k === handle.pole;
                const isEnd = (handle.pole === 0 || handle.pole === pcurve.poles.length - 1) && (k === 0 || k === last);
                const isThere = isEnd && Math.hypot((pole[0] as number) - at[0], (pole[1] as number) - at[1]) < near;
                if (!isIt && !isThere) return pole;
                free.add(use.edge);
                return [(pole[0] as number) + step[0], (pole[1] as number) + step[1]];
              });
              return { ...use, pcurve: { ...use.pcurve, poles } };
            }),
          },
    );
    next = { ...face, loops };
  }
  const idOf = (edge: ModelEdge, i: number): number => edge.id ?? i;
  return {
    ...model,
    faces: faces.map((each, f) => (f === handle.face ? next : each)),
    edges: edges.map((edge, i) => (free.has(idOf(edge, i)) ? { ...edge, curve3d: null } : edge)),
  };
}

function edgesById({ edges = [] }: Model): (id: number) => ModelEdge | undefined {
  const byId = new Map(edges.map((edge, i) => [edge.id ?? i, edge]));
  return (id) => byId.get(id);
}

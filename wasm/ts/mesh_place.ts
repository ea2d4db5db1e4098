// Where meshes are open in this thread: for the time of one call, or for a session.
import type { HolesArrays } from './border.js';
import { computeCarry, computeCrossings, computeHoles, computeWeld, fillIn, kClose, openIn, type MeshCall } from './compute_holes.js';
import type { MeshPlace, OpenMesh } from './hole_filling.js';
import { callCore, shared } from './runtime.js';
import { Session } from './session.js';

/** For calls that leave nothing behind. */
export const passingPlace: MeshPlace = {
  weld: computeWeld,
  find: computeHoles,
  crossings: computeCrossings,
  carryOn: computeCarry,
  open(mesh, budget) {
    const call: MeshCall = (name, args, read, watch) => callCore(shared.meshes, name, args, read, watch).arrays;
    const { value: holes, seconds } = openIn(call, mesh, budget);
    const [session] = holes.session;
    const close = (): void => {
      // If its instance is gone, so is the mesh.
      if (shared.meshes.core) call(kClose, [session], () => undefined, {});
    };
    return { value: { open: opened(call, () => session, close), holes }, seconds };
  },
};

/** For one mesh in an instance of its own, where it stays until it is closed, or until its owner is garbage. */
export function sessionPlace(owner: object): MeshPlace & { readonly session: Session | undefined } {
  let session: Session | undefined;
  return {
    ...passingPlace,
    open(mesh, budget) {
      const own = new Session('meshes', kClose);
      session = own;
      const open: MeshCall = (name, args, read, watch) =>
        own.open(owner, name, args, read, (arrays) => (arrays as HolesArrays).session[0], watch);
      const { value: holes, seconds } = openIn(open, mesh, budget);
      const call: MeshCall = (name, args, read, watch) => own.call(name, args, read, watch);
      const close = (): void => {
        own.dispose();
      };
      return { value: { open: opened(call, () => own.alive(), close), holes }, seconds };
    },
    get session() {
      return session;
    },
  };
}

function opened(call: MeshCall, session: () => number, close: () => void): OpenMesh {
  return {
    size: 1,
    fill: (parts, budget, listeners) => parts.map((work, i) => fillIn(call, session(), work, { ...budget, onProgress: listeners[i] })),
    close,
  };
}

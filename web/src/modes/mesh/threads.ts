// What of the library this mode has done in threads.
import type { FillOptions, FillResult, HoleOptions, HoleReport, MeshInput } from 'soapfilm';
import type { CallOptions, Film } from 'soapfilm/worker';

export interface HoleThreads {
  findHoles(mesh: MeshInput, options?: HoleOptions & CallOptions): Promise<HoleReport>;
  fillHoles(mesh: MeshInput, options?: FillOptions & CallOptions): Promise<FillResult>;
}

/** TODO: `Film` itself, as soon as `soapfilm/worker` has these calls; until then they hold up the page. */
export function holeThreads(film: Film): HoleThreads {
  const threads = film as Film & Partial<HoleThreads>;
  if (threads.findHoles && threads.fillHoles) return threads as HoleThreads;
  const call = async <T>(signal: AbortSignal | undefined, of: (library: typeof import('soapfilm')) => T): Promise<T> => {
    const library = await import('soapfilm');
    await library.load({ parts: ['meshes'] });
    signal?.throwIfAborted();
    return of(library);
  };
  return {
    findHoles: (mesh, { signal, ...options } = {}) => call(signal, (library) => library.findHoles(mesh, options)),
    fillHoles: (mesh, { signal, ...options } = {}) => call(signal, (library) => library.fillHoles(mesh, options)),
  };
}

// How files are read: by `fetch`, unless `node_host.ts` has put Node's way in its place.

/** Reads the file at a URL, or at a path where the surroundings have paths. */
export type Reader = (source: URL | string) => Promise<Response | BufferSource>;

let reader: Reader = (source) => fetch(source);

export function readFrom(source: URL | string): Promise<Response | BufferSource> {
  return reader(source);
}

export function setReader(other: Reader): void {
  reader = other;
}

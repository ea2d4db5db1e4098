// How files are read: by `fetch`, which `node_host.ts` replaces in Node.

/** Reads the file at a URL, or at a path if the host has paths. */
export type Reader = (source: URL | string) => Promise<Response | BufferSource>;

let reader: Reader = (source) => fetch(source);

export function readFrom(source: URL | string): Promise<Response | BufferSource> {
  return reader(source);
}

export function setReader(other: Reader): void {
  reader = other;
}

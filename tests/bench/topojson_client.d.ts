declare module 'topojson-client' {
  interface Topology {
    readonly objects: Readonly<Record<string, unknown>>;
  }
  interface Feature {
    readonly geometry: { readonly type: string; readonly coordinates: unknown } | null;
  }
  export function feature(topology: Topology, object: unknown): { readonly features: Feature[] };
}

// What the vertices of meshes have besides places, such as colours: kept through all that is done to a mesh.

export interface Attribute {
  /** `[size n]` */
  readonly data: Float32Array;
  readonly size: number;
}

export type Attributes = Readonly<Record<string, Attribute>>;

interface Attributed {
  readonly attributes?: Attributes;
}

/** The numbers of colours, 3 or 4 a vertex; null: there are none. */
export function colorsOf({ attributes }: Attributed): Attribute | null {
  const color = attributes?.color;
  return color && (color.size === 3 || color.size === 4) ? color : null;
}

/** What was saved as attributes of so many vertices: those that are such, of finite numbers. Null: there are none. */
export function readAttributes(saved: unknown, vertices: number): Attributes | null {
  if (typeof saved !== 'object' || saved === null) return null;
  const sound = Object.entries(saved).filter(([, each]: [string, Partial<Record<keyof Attribute, unknown>> | null]) => {
    const { data, size } = each ?? {};
    if (!(data instanceof Float32Array) || !Number.isInteger(size) || (size as number) <= 0) return false;
    return data.length === (size as number) * vertices && data.every(Number.isFinite);
  });
  return sound.length > 0 ? Object.fromEntries(sound) : null;
}

/** Those of some vertices, in an order of their own. */
export function picked(attributes: Attributes | undefined, vertices: ArrayLike<number>): Attributed {
  if (attributes === undefined) return {};
  return mapped(attributes, ({ data, size }) => {
    const some = new Float32Array(size * vertices.length);
    for (let i = 0; i < vertices.length; i++) some.set(data.subarray(size * vertices[i], size * (vertices[i] + 1)), size * i);
    return some;
  });
}

/** Those that all of some meshes have, one mesh after the other. */
export function joined(all: readonly Attributed[]): Attributed {
  const [first, ...others] = all.map(({ attributes = {} }) => attributes);
  const common = Object.entries(first).filter(([name, { size }]) => others.every((each) => name in each && each[name].size === size));
  if (common.length === 0) return {};
  return mapped(Object.fromEntries(common), (_, name) => {
    const parts = all.flatMap(({ attributes }) => attributes?.[name].data ?? []);
    const data = new Float32Array(parts.reduce((sum, { length }) => sum + length, 0));
    let to = 0;
    for (const part of parts) {
      data.set(part, to);
      to += part.length;
    }
    return data;
  });
}

function mapped(attributes: Attributes, make: (of: Attribute, name: string) => Float32Array): Attributed {
  const entries = Object.entries(attributes).map(([name, of]) => [name, { data: make(of, name), size: of.size }] as const);
  return { attributes: Object.fromEntries(entries) };
}

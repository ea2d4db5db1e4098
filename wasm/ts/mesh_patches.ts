// The mesh that updates patch: what the core has written is copied into arrays that stay.
import type { ChangeArrays, TessellationArrays } from './border.js';
import type { SoapfilmError } from './errors.js';
import { tessellationOf } from './sampling_input.js';
import type { Change } from './surface_types.js';

type Numbers = Float32Array | Uint32Array;

/** The arrays of a mesh of which updates write ranges. */
interface Blocks {
  positions: Float32Array;
  normals: Float32Array;
  uvs: Float32Array;
  triangles: Uint32Array;
  strips: Uint32Array;
}

/** Of one model: the mesh after its last tessellation or update. */
export class MeshPatches {
  #blocks: Blocks | undefined;
  /** Whether the arrays were handed out by a tessellation, whose mesh no update may change. */
  #isLent = false;

  /** A tessellation has handed out its mesh. */
  lend({ positions, normals, uvs, triangles, strips }: TessellationArrays): void {
    this.#blocks = { positions, normals, uvs, triangles, strips };
    this.#isLent = true;
  }

  /**
   * Writes what an update has changed. The arrays of the change may be views that are soon void.
   * @param faults of the model, as `faultsOf` has them
   */
  apply(change: ChangeArrays, faults: readonly SoapfilmError[]): Change {
    const { vertexRanges, indexRanges, stripRanges, faces, faceStarts, stripStarts, edges, edgeStarts, same, reports, numbers } = change;
    const rest = copiesOf({ faceStarts, stripStarts, edges, edgeStarts, same });
    const mesh = tessellationOf({ ...rest, ...this.#write(change), reports, numbers }, faults);
    return { mesh, ...copiesOf({ vertexRanges, indexRanges, stripRanges, faces }) };
  }

  #write(change: ChangeArrays): Blocks {
    const [vertices, corners, stripVertices] = change.sizes;
    const before = this.#blocks;
    const fit = <T extends Numbers>(old: T | undefined, length: number, type: new (length: number) => T): T => {
      if (old?.length === length && !this.#isLent) return old;
      const fresh = new type(length);
      if (old) fresh.set(old.length > length ? old.subarray(0, length) : old);
      return fresh;
    };
    const blocks: Blocks = {
      positions: fit(before?.positions, 3 * vertices, Float32Array),
      normals: fit(before?.normals, 3 * vertices, Float32Array),
      uvs: fit(before?.uvs, 2 * vertices, Float32Array),
      triangles: fit(before?.triangles, corners, Uint32Array),
      strips: fit(before?.strips, stripVertices, Uint32Array),
    };
    write(blocks.positions, change.positions, change.vertexRanges, 3);
    write(blocks.normals, change.normals, change.vertexRanges, 3);
    write(blocks.uvs, change.uvs, change.vertexRanges, 2);
    write(blocks.triangles, change.triangles, change.indexRanges, 1);
    write(blocks.strips, change.strips, change.stripRanges, 1);
    this.#isLent = false;
    this.#blocks = blocks;
    return blocks;
  }
}

const copiesOf = <T extends Readonly<Record<string, Uint32Array>>>(arrays: T): T =>
  Object.fromEntries(Object.entries(arrays).map(([name, array]) => [name, array.slice()])) as T;

/** Writes parts that follow each other to the ranges, `width` numbers to each element. */
function write(to: Numbers, parts: Numbers, ranges: Uint32Array, width: number): void {
  let from = 0;
  for (let i = 0; i < ranges.length; i += 2) {
    const length = width * (ranges[i + 1] - ranges[i]);
    to.set(parts.subarray(from, from + length), width * ranges[i]);
    from += length;
  }
}

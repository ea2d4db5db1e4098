// Files of meshes, damaged at random: reading them gives a sound mesh or an error of ours, and nothing else.
import { SoapfilmError, type MeshLike } from 'soapfilm';
import { readMesh, writeMesh, type MeshFile } from 'soapfilm/files';
import { expect, test } from 'vitest';
import { Random } from '../support/generators.js';
import { binaryPly, binaryStl, bytesOf, kGlb, kObj, kPly, kStl } from '../support/mesh_files.js';

const kRounds = 1500;

function expectSound({ positions, faces, attributes = {}, warnings }: MeshFile): void {
  const n = positions.length / 3;
  expect(Number.isInteger(n) && Number.isInteger(faces.length / 3) && faces.length > 0).toBe(true);
  expect(positions.every(Number.isFinite)).toBe(true);
  expect(faces.every((v) => v < n)).toBe(true);
  for (const { data, size } of Object.values(attributes)) {
    expect(data.length).toBe(size * n);
    expect(data.every(Number.isFinite)).toBe(true);
  }
  expect(warnings.every((text) => typeof text === 'string')).toBe(true);
}

/** The file cut off, with some bytes changed, with a piece twice or without one, or with another number in text. */
function damaged(bytes: Uint8Array, random: Random): Uint8Array {
  const kind = random.below(5);
  const [a, b] = [random.below(bytes.length), random.below(bytes.length)].sort((x, y) => x - y);
  if (kind === 0) return bytes.slice(0, a);
  if (kind === 1) return Uint8Array.from([...bytes.slice(0, a), ...bytes.slice(b)]);
  if (kind === 2) return Uint8Array.from([...bytes.slice(0, b), ...bytes.slice(a)]);
  const changed = bytes.slice();
  for (let left = 1 + random.below(4); left > 0; left--) {
    const at = random.below(bytes.length);
    const digits = bytesOf('0123456789-+.eE/# \n\\');
    changed[at] = kind === 3 ? random.below(256) : digits[random.below(digits.length)];
  }
  return changed;
}

const torn: MeshLike = {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0),
  faces: Uint32Array.of(0, 1, 2, 0, 2, 3),
  attributes: { color: { data: new Float32Array(16).fill(0.3), size: 4 }, uv: { data: new Float32Array(8).fill(0.7), size: 2 } },
};

test.each<[string, () => Promise<Uint8Array>]>([
  ['OBJ', () => Promise.resolve(bytesOf(kObj))],
  ['OBJ with all there is', () => writeMesh(torn, 'obj')],
  ['PLY, text', () => Promise.resolve(bytesOf(kPly))],
  ['PLY, little-endian', () => Promise.resolve(binaryPly(true))],
  ['PLY, big-endian', () => Promise.resolve(binaryPly(false))],
  ['PLY with all there is', () => writeMesh(torn, 'ply')],
  ['STL, text', () => Promise.resolve(bytesOf(kStl))],
  ['STL, binary', () => Promise.resolve(binaryStl())],
  ['GLB', () => Promise.resolve(kGlb)],
  ['GLB with all there is', () => writeMesh(torn, 'glb')],
])('%s, damaged: a mesh or an error of ours (seed 5)', async (_, make) => {
  const bytes = await make();
  expectSound(await readMesh(bytes));
  const random = new Random(5);
  const outcomes = { read: 0, refused: 0 };
  for (let round = 0; round < kRounds; round++) {
    let file = damaged(bytes, random);
    while (random.chance(0.3) && file.length > 0) file = damaged(file, random);
    try {
      expectSound(await readMesh(file, random.chance(0.5) ? `a.${['obj', 'ply', 'stl', 'glb'][random.below(4)]}` : undefined));
      outcomes.read++;
    } catch (error) {
      if (!(error instanceof SoapfilmError)) throw new Error(`Round ${round}: ${JSON.stringify([...file])}`, { cause: error });
      expect(error.code).toBe('bad-file');
      outcomes.refused++;
    }
  }
  expect(outcomes.refused).toBeGreaterThan(kRounds / 10);
});

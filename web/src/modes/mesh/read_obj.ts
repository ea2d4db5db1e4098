// Meshes in OBJ: vertices and faces; polygons become fans of triangles. A reader of its own, since vertices must stay
// shared, which three's OBJLoader undoes.
import type { MeshShape } from './settings.ts';
import { bad, Growing, Scanner } from './scanner.ts';

/** @throws SoapfilmError `bad-file` */
export function readObj(text: string): MeshShape {
  const scan = new Scanner(text);
  const positions = new Growing(new Float32Array(3072));
  const faces = new Growing(new Uint32Array(3072));
  /** Faces may come before their vertices: the largest number so far, and its line. */
  let [most, mostLine] = [0, 0];
  do {
    const name = scan.word();
    if (name === 'v') for (let axis = 0; axis < 3; axis++) positions.push(scan.number('the vertex'));
    if (name !== 'f') continue;
    let [first, before, count] = [0, 0, 0];
    for (let word = scan.word(); word !== '' && !word.startsWith('#') && word !== '\\'; word = scan.word()) {
      const vertex = vertexIn(word, positions.length / 3, scan.line);
      if (vertex > most) [most, mostLine] = [vertex, scan.line];
      count++;
      if (count === 1) first = vertex;
      if (count > 2) for (const each of [first, before, vertex]) faces.push(each - 1);
      before = vertex;
    }
    if (count < 3) throw bad('a face has fewer than three vertices', scan.line);
  } while (scan.nextLine());
  if (most > positions.length / 3) throw bad(`there is no vertex ${most}`, mostLine);
  if (faces.length === 0) throw bad('it has no faces');
  return { positions: positions.taken(), faces: faces.taken() };
}

/** The number of a vertex, from 1, in `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative numbers count backwards. */
function vertexIn(word: string, count: number, line: number): number {
  const slash = word.indexOf('/');
  const number = Number(slash < 0 ? word : word.slice(0, slash));
  const vertex = number < 0 ? count + 1 + number : number;
  if (Number.isInteger(vertex) && vertex > 0) return vertex;
  throw bad(`“${word.slice(0, 30)}” names no vertex`, line);
}

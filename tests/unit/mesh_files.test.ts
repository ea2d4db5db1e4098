// soapfilm/files: all formats give the same mesh, what is written comes back, and what is broken is said with its place.
import { fillHoles, findHoles, load, SoapfilmError, type MeshLike } from 'soapfilm';
import { readMesh, writeMesh, type MeshFormat, type ReadMeshOptions } from 'soapfilm/files';
import { Matrix4 } from 'three';
import { beforeAll, describe, expect, test } from 'vitest';
import { rejectionOf } from '../support/errors.js';
import {
  binaryPly, binaryStl, bytesOf, facet, glbOf, gltfOf, kFaces, kGlb, kGlbData, kMesh, kObj, kPly, kPoints, kStl,
} from '../support/mesh_files.js';

const read = (content: string | Uint8Array, name?: string, options?: ReadMeshOptions) =>
  readMesh(typeof content === 'string' ? bytesOf(content) : content, name, options);
const lists = ({ positions, faces }: MeshLike) => [Array.from(positions, Math.fround), [...faces]];

/** The corners of all triangles, whatever the numbers of their vertices. */
const corners = ({ positions, faces }: MeshLike) => Array.from(faces, (v) => [...positions.subarray(3 * v, 3 * v + 3)]);

/** In order, each triangle from its least corner on. */
const triangles = ({ faces }: MeshLike) =>
  Array.from({ length: faces.length / 3 }, (_, f) => {
    const face = [...faces.subarray(3 * f, 3 * f + 3)];
    const least = face.indexOf(Math.min(...face));
    return [...face.slice(least), ...face.slice(0, least)].join(' ');
  }).sort();

const messageOf = async (content: string | Uint8Array, name?: string) => {
  const { code, message, line } = await rejectionOf(read(content, name));
  expect(code).toBe('bad-file');
  // The message begins with the line.
  expect(/^Line (\d+): /.exec(message)?.[1]).toBe(line === undefined ? undefined : String(line));
  return message;
};

describe('any format', () => {
  test.each<[string, string | Uint8Array, MeshFormat]>([
    ['OBJ', kObj, 'obj'],
    ['PLY, text', kPly, 'ply'],
    ['PLY, little-endian', binaryPly(true), 'ply'],
    ['PLY, big-endian', binaryPly(false), 'ply'],
    ['STL, text', kStl, 'stl'],
    ['STL, binary, which begins as text does', binaryStl('solid facet'), 'stl'],
    ['GLB', kGlb, 'glb'],
  ])('%s: the same triangles, whatever the name and wherever the bytes lie', async (_, content, format) => {
    const bytes = typeof content === 'string' ? bytesOf(content) : content;
    const shifted = new Uint8Array(bytes.length + 7);
    shifted.set(bytes, 3);
    for (const given of [bytes, bytes.slice().buffer, shifted.subarray(3, 3 + bytes.length)]) {
      const mesh = await readMesh(given, 'a mesh.without');
      expect(mesh.format).toBe(format);
      expect(corners(mesh).map((p) => p.map(Math.fround))).toEqual(corners(kMesh));
      expect(mesh.positions.length).toBe(kPoints.length);
    }
  });

  test.each([
    ['OBJ', kObj],
    ['PLY', kPly],
    ['STL', kStl],
  ])('%s as text: any ends of lines, none at the end, a mark of the encoding, 16 bits', async (_, text) => {
    const utf16 = (isLittle: boolean) => {
      const view = new DataView(new ArrayBuffer(2 * text.length + 2));
      Array.from(`\ufeff${text}`).forEach((letter, i) => { view.setUint16(2 * i, letter.charCodeAt(0), isLittle); });
      return new Uint8Array(view.buffer);
    };
    const whole = await read(text);
    const others = [text.replaceAll('\n', '\r\n'), text.replaceAll('\n', '\r'), text.trimEnd(), `\ufeff${text}`, `${text}\n\n`, utf16(true), utf16(false)];
    for (const other of others) expect(lists(await read(other))).toEqual(lists(whole));
  });

  test.each<[string, string | Uint8Array, string, string?]>([
    ['nothing', '', 'The file is empty'],
    ['blanks', ' \n', 'The file is in none of the formats OBJ, PLY, STL and GLB'],
    ['a picture', Uint8Array.of(137, 80, 78, 71, 0, 0), 'The file is in none of the formats OBJ, PLY, STL and GLB'],
    ['a table', 'x,y,z\n1,2,3\n', 'The file is in none of the formats OBJ, PLY, STL and GLB'],
    ['nothing that is said to be OBJ', '', 'The file has no faces', 'a.obj'],
    ['nothing that is said to be STL', '', 'The file has no triangles', 'a.STL'],
  ])('%s: is said', async (_, content, message, name) => {
    expect(await messageOf(content, name)).toBe(message);
  });

  test('arguments of other kinds: are said', async () => {
    for (const bytes of [undefined, null, 'v 0 0 0', 7, [1, 2], new Float32Array(3)]) {
      expect((await rejectionOf(readMesh(bytes as unknown as Uint8Array))).code).toBe('bad-file');
    }
    expect((await rejectionOf(readMesh(kGlb, 7 as unknown as string))).code).toBe('bad-option');
  });

  test('memory that is shared: is read too', async () => {
    const shared = new Uint8Array(new SharedArrayBuffer(kGlb.length));
    shared.set(kGlb);
    expect(lists(await readMesh(shared))).toEqual(lists(kMesh));
  });
});

describe('OBJ', () => {
  test('coordinates: exact to the last bit of a double', async () => {
    const numbers = ['0.1', '-12345678.912345678', '1e-30', '.5e+2', '+3.', '179769.31348623157', '4.9406564584124654e-30', '9007199254740993', '1e22', '123456789012345e-22', '0.000001', '-0'];
    const { positions } = await read(`${numbers.map((x) => `v ${x} ${x} 0\n`).join('')}f 1 2 3\n`);
    expect(positions).toBeInstanceOf(Float64Array);
    numbers.forEach((x, v) => { expect(positions[3 * v]).toBe(Number(x)); });
  });

  test('lines that go on, blanks of any kind, statements that are of no use', async () => {
    const text = 'mtllib a.mtl\no all\ng part#1 # a\\\n\tv 0 0\\\n 0\nv\t1 0 0\nvn 0 0 1\n  v 1 1 0 \r\ns off\nusemtl red\nf 1 \\\n2\\\n 3\nl 1 2\n';
    const mesh = await read(text);
    expect(lists(mesh)).toEqual([[0, 0, 0, 1, 0, 0, 1, 1, 0], [0, 1, 2]]);
    expect(mesh.warnings).toEqual(['Materials are left out', 'Lines and points are left out']);
  });

  test('faces before their vertices', async () => {
    expect(lists(await read('f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n'))[1]).toEqual([0, 1, 2]);
  });

  test('colours: of 3 or 4 numbers, up to 1 or up to 255; only if all have one', async () => {
    const text = (...colors: string[]) => `${colors.map((color, i) => `v ${i} ${i * i} 0 ${color}\n`).join('')}f 1 2 3\n`;
    const color = async (...colors: string[]) => (await read(text(...colors))).attributes?.color;
    expect(await color('1 0 0', '0 1 0', '0 0 .5')).toEqual({ data: Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 0.5), size: 3 });
    expect(await color('255 0 0', '0 51 0', '0 0 0')).toEqual({ data: Float32Array.of(1, 0, 0, 0, 51 / 255, 0, 0, 0, 0), size: 3 });
    expect(await color('1 0 0 .5', '0 1 0', '0 0 0')).toEqual({ data: Float32Array.of(1, 0, 0, 0.5, 0, 1, 0, 1, 0, 0, 0, 1), size: 4 });
    const some = await read(text('1 0 0', '', '0 0 1'));
    expect(some.attributes).toBeUndefined();
    expect(some.warnings).toEqual(['Only some vertices have a colour: colours are left out']);
  });

  const square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0 0\nvt 1 1\nvt 0 1\nvt 0 0\nvt .5 .5\n';
  test('texture coordinates: kept where each vertex has one', async () => {
    const uv = { data: Float32Array.of(0, 0, 1, 0, 1, 1, 0, 1), size: 2 };
    expect((await read(`${square}f 1/1 2/2 3/3\nf 1/5 3/3/1 4/-3\n`)).attributes).toEqual({ uv });
    const torn = await read(`${square}f 1/1 2/2 3/3\nf 1/6 3/3 4/4\n`);
    expect([torn.attributes, torn.positions.length]).toEqual([undefined, 12]);
    expect(torn.warnings).toEqual(['Some vertices have several texture coordinates: these are left out, for the mesh would have a seam there']);
    const split = await read(`${square.replaceAll(' 0\nv', ' 0 .1 .2 .3\nv').replace('0 1 0\n', '0 1 0 .1 .2 .3\n')}f 1/1 2/2 3/3\nf 1/6 3/3 4/4\n`, '', { seams: 'split' });
    expect(lists(split)).toEqual([[0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0], [0, 1, 2, 4, 2, 3]]);
    expect(split.attributes?.uv).toEqual({ data: Float32Array.of(0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5), size: 2 });
    expect(split.attributes?.color.data).toHaveLength(15);
    expect(split.warnings).toEqual([]);
    const some = await read(`${square}f 1/1 2/2 3/3\nf 1 3 4\n`);
    expect([some.attributes, some.warnings]).toEqual([undefined, ['Only some vertices have texture coordinates: these are left out']]);
  });

  test.each([
    ['v 0 0\n', 'Line 1: a number of the vertex is missing'],
    ['v 0 0 zero\n', 'Line 1: “zero” is not a number'],
    ['v 0 0 0x10\n', 'Line 1: “0x10” is not a number'],
    ['v 0 0 1,5\n', 'Line 1: “1,5” is not a number'],
    ['v 0 . 0\n', 'Line 1: “.” is not a number'],
    ['v 0 1e 0\n', 'Line 1: “1e” is not a number'],
    ['v 0 0 nan\n', 'Line 1: a number of the vertex is not finite'],
    ['v 0 0 -Infinity\n', 'Line 1: a number of the vertex is not finite'],
    ['v 0 0 1e300\n', 'Line 1: a number of the vertex is not finite'],
    ['v 0 0 0\r\n\r\nf 1 2\r\n', 'Line 3: a face has fewer than three vertices'],
    ['v 0 0 \\\n0\nf 1 1\n', 'Line 3: a face has fewer than three vertices'],
    ['v 0 0 0\nf 1 1 7\n', 'Line 2: there is no vertex 7'],
    ['v 0 0 0\nf 1 1 99999999999\n', 'Line 2: there is no vertex 99999999999'],
    ['v 0 0 0\nf 1 1 -2\n', 'Line 2: “-2” names no vertex'],
    ['v 0 0 0\nf 1 1 0\n', 'Line 2: “0” names no vertex'],
    ['v 0 0 0\nf 1 1 1/x\n', 'Line 2: “1/x” names no vertex'],
    ['v 0 0 0\nf 1 1 1.5\n', 'Line 2: “1.5” names no vertex'],
    ['v 0 0 0\n', 'The file has no faces'],
  ])('%j: is said', async (text, message) => {
    expect(await messageOf(text)).toBe(message);
  });
});

describe('polygons', () => {
  /** Twice the area of all triangles, in the plane of x and y. */
  const areas = ({ positions: p, faces }: MeshLike) =>
    Array.from({ length: faces.length / 3 }, (_, f) => {
      const [a, b, c] = [...faces.subarray(3 * f, 3 * f + 3)].map((v) => [p[3 * v], p[3 * v + 1]]);
      return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    });
  const outlines: [string, number[][]][] = [
    ['an arrow, in from each of its corners', [[0, 0], [4, 4], [0, 2], [-4, 4]]],
    ['a star', Array.from({ length: 12 }, (_, i) => [(i % 2 ? 1 : 3) * Math.cos(i * Math.PI / 6), (i % 2 ? 1 : 3) * Math.sin(i * Math.PI / 6)])],
    ['a comb', Array.from({ length: 9 }, (_, i) => [i, i % 2 ? 5 : 1]).concat([[8, 0], [0, 0]]).reverse()],
    ['a square with vertices on its sides', [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]]],
    ['a spiral', [[0, 0], [6, 0], [6, 6], [1, 6], [1, 2], [4, 2], [4, 4], [3, 4], [3, 3], [2, 3], [2, 5], [5, 5], [5, 1], [0, 1]]],
  ];
  test.each(outlines)('%s: covered once, by triangles that all run as the polygon does', async (_, outline) => {
    for (let turn = 0; turn < outline.length; turn++) {
      const points = [...outline.slice(turn), ...outline.slice(0, turn)];
      const twice = points.reduce((sum, [x, y], i) => sum + x * points[(i + 1) % points.length][1] - y * points[(i + 1) % points.length][0], 0);
      const order = points.map((_, i) => i + 1).join(' ');
      // A second face keeps the corners' numbers apart from their order.
      const mesh = await read(`${points.map(([x, y]) => `v ${x} ${y} ${0.1 * x + 0.2 * y}\n`).join('')}f ${order}\n`);
      const found = areas(mesh);
      expect(found).toHaveLength(points.length - 2);
      const total = found.reduce((sum, area) => sum + area, 0);
      expect(total).toBeCloseTo(twice, 9);
      for (const area of found) expect(area * Math.sign(twice)).toBeGreaterThan(0);
      // Every edge of the outline is in one triangle, every other in two: no crack at vertices on straight sides.
      const edges = new Map<string, number>();
      mesh.faces.forEach((v, i) => {
        const w = mesh.faces[i - (i % 3) + ((i + 1) % 3)];
        const key = [v, w].sort((a, b) => a - b).join(' ');
        edges.set(key, (edges.get(key) ?? 0) + 1);
      });
      expect([...edges.values()].filter((count) => count === 1)).toHaveLength(points.length);
      expect(Math.max(...edges.values())).toBeLessThanOrEqual(2);
    }
  });

  test('what is no polygon: as many triangles as its vertices ask for', async () => {
    for (const order of ['1 2 1 2 1', '1 1 1 1', '1 3 2 4', '1 2 3 1 2 3']) {
      const { faces } = await read(`v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf ${order}\n`);
      expect(faces.length / 3).toBe(order.split(' ').length - 2);
    }
  });
});

const ply = (vertex: string, rows: string, faces = '3 0 1 2\n', count = rows.trim().split('\n').length) =>
  `ply\nformat ascii 1.0\nelement vertex ${count}\n${vertex.split(', ').map((p) => `property ${p}\n`).join('')}element face ${faces.trim().split('\n').length}\nproperty list uchar int vertex_index\nend_header\n${rows}${faces}`;

describe('PLY', () => {
  const xyz = 'float x, float y, float z';
  test('positions: as precise as in the file; what else vertices have keeps its name', async () => {
    const mesh = await read(kPly);
    expect(mesh.positions).toBeInstanceOf(Float64Array);
    expect(mesh.attributes).toEqual({ quality: { data: new Float32Array(5).fill(9), size: 1 } });
    expect(mesh.warnings).toEqual(['“weight” of faces is left out']);
    expect((await read(ply(xyz, '0 0 0\n1 0 0\n0 1 0\n'))).positions).toBeInstanceOf(Float32Array);
  });

  test.each([
    ['uchar', 'uchar red, uchar green, uchar blue', '255 0 51', [1, 0, 0.2]],
    ['with alpha, by other names', 'uchar diffuse_red, uchar diffuse_green, uchar diffuse_blue, uchar diffuse_alpha', '255 0 51 102', [1, 0, 0.2, 0.4]],
    ['ushort', 'ushort r, ushort g, ushort b', '65535 0 13107', [1, 0, 0.2]],
    ['float', 'float red, float green, float blue', '1 0 .2', [1, 0, 0.2]],
    ['float, up to 255', 'float red, float green, float blue', '255 0 51', [1, 0, 0.2]],
  ])('colours, %s: from 0 to 1', async (_, names, color, wanted) => {
    const { attributes } = await read(ply(`${xyz}, ${names}`, `0 0 0 ${color}\n1 0 0 ${color}\n0 1 0 ${color}\n`));
    expect(Object.keys(attributes ?? {})).toEqual(['color']);
    expect(attributes?.color).toEqual({ data: Float32Array.from([...wanted, ...wanted, ...wanted]), size: wanted.length });
  });

  test.each(['s, t', 'u, v', 'texture_u, texture_v', 'texture_s, texture_t'])('texture coordinates by the names %s', async (names) => {
    const { attributes } = await read(ply(`${xyz}, float ${names.replace(', ', ', float ')}`, '0 0 0 .5 1\n1 0 0 0 0\n0 1 0 1 1\n'));
    expect(attributes).toEqual({ uv: { data: Float32Array.of(0.5, 1, 0, 0, 1, 1), size: 2 } });
  });

  test('normals, lists and attributes that are not finite: left out, and said', async () => {
    const mesh = await read(ply(`${xyz}, float nx, float ny, float nz, list uchar int ring, float curvature`, '0 0 0 0 0 1 2 7 8 nan\n1 0 0 0 0 1 0 1\n0 1 0 0 0 1 1 4 2\n'));
    expect(mesh.attributes).toBeUndefined();
    expect(mesh.warnings).toEqual(['Normals are left out', 'The lists “ring” of vertices are left out', 'The attribute “curvature” has numbers that are not finite, and is left out']);
  });

  test('names that objects have themselves: are names as others', async () => {
    const { attributes } = await read(ply(`${xyz}, float __proto__, float constructor`, '0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n'));
    expect(Object.keys(attributes ?? {})).toEqual(['__proto__', 'constructor']);
  });

  test('faces before vertices, elements without properties, faces of few vertices', async () => {
    const text = 'ply\nformat ascii 1.0\nelement face 3\nproperty list uchar int vertex_indices\nelement nothing 7\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n2 0 1\n0\n0 0 0\n1 0 0\n0 1 0\n';
    const mesh = await read(text);
    expect([...mesh.faces]).toEqual([0, 1, 2]);
    expect(mesh.warnings).toEqual(['2 faces of fewer than three vertices are left out']);
  });

  test('strips of triangles', async () => {
    const text = 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n';
    expect([...(await read(text)).faces]).toEqual([0, 1, 2, 2, 1, 3, 3, 2, 1]);
  });

  test.each([
    ['ply\nformat ascii 1.0\n', 'The header of the file has no end'],
    ['ply\nformat zip 1.0\nend_header\n', 'The header of the file names no known format'],
    ['ply\nformat ascii 1.0\nelement vertex many\nend_header\n', 'Line 3: “many” is no number of elements'],
    ['ply\nformat ascii 1.0\nelement vertex -3\nend_header\n', 'Line 3: “-3” is no number of elements'],
    ['ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n', 'Line 4: a property of no known type'],
    ['ply\nformat ascii 1.0\nproperty float x\nend_header\n', 'Line 3: a property of no known type'],
    ['ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n', 'The vertices of the file have no x, y and z'],
    ['ply\nformat ascii 1.0\nend_header\n', 'The file has no vertices'],
    [kPly.replace('9 0.1', '9 one'), 'Line 15: “one” is not a number'],
    [kPly.replace('9 0.1', '9 1e300'), 'Line 15: a coordinate of vertex 2 is not a finite number'],
    [kPly.replace('9 0.1', '9 nan'), 'Line 15: a coordinate of vertex 2 is not a finite number'],
    [kPly.replace('3 4 1 0', '3 9 1 0'), 'Line 19: face 1 names the vertex 9, and there are only 5'],
    [kPly.replace('3 4 1 0', '3 -1 1 0'), 'Line 19: face 1 names the vertex -1'],
    [kPly.replace('3 4 1 0', '3 0.5 1 0'), 'Line 19: face 1 names the vertex 0.5'],
    [kPly.replace('3 4 1 0', '4 4 1 0'), 'Line 19: there are fewer numbers than the header and the lists in this line say'],
    [kPly.replace('3 4 1 0', '2 4 1 0'), 'Line 19: there are more numbers than the header and the lists in this line say'],
    [kPly.replace('3 4 1 0', '-3 4 1 0'), 'Line 19: -3 is no length of a list'],
    [kPly.slice(0, -12), 'Line 18: the file ends too early'],
    [kPly.slice(0, -22), 'The file ends too early: it has not 2 elements “face”'],
    [kPly.slice(0, -6), 'Line 19: the file ends too early'],
    [kPly.replace('element vertex 5', 'element vertex 4000000000'), 'The file ends too early: it has not 4000000000 elements “vertex”'],
  ])('%j: is said', async (text, message) => {
    expect(await messageOf(text)).toBe(message);
  });

  test('binary that is cut off, wherever: is said', async () => {
    for (const isLittle of [true, false]) {
      const bytes = binaryPly(isLittle);
      for (let length = 4; length < bytes.length; length++) await messageOf(bytes.subarray(0, length));
    }
  });
});

describe('STL', () => {
  test('corners at the same place are one vertex, zeros of either sign too', async () => {
    expect(lists(await read(kStl))).toEqual([kPoints.map(Math.fround), kFaces]);
  });

  test('text: several statements in a line, capitals, several solids', async () => {
    const text = kStl.toUpperCase().replaceAll('\n ', ' ').replace('FACET', 'facet');
    expect(lists(await read(text + text.replaceAll('.5', '.75')))[1]).toEqual([...kFaces, 0, 1, 2, 0, 2, 3, 5, 1, 0]);
  });

  test('more bytes than triangles: read if the name says so', async () => {
    const longer = new Uint8Array([...binaryStl('any'), 1, 2, 3]);
    expect(lists(await read(longer, 'a.stl'))).toEqual([kPoints.map(Math.fround), kFaces]);
  });

  test.each<[string, string | Uint8Array, string]>([
    ['a facet of two vertices', `solid\n${facet('0 0 0', '1 0 0')}`, 'Line 2: a facet has not three vertices'],
    ['an end within a facet', `solid\n${facet('0 0 0', '1 0 0', '0 1 0').slice(0, -12)}`, 'Line 2: the file ends within this facet'],
    ['a word', `solid\n${facet('0 0 0', '1 0 x', '0 0 1')}`, 'Line 5: “x” is not a number'],
    ['no facets', 'solid facet\nendsolid\n', 'The file has no triangles'],
    ['cut off', binaryStl('any').subarray(0, -7), 'The file ends too early: it has 2 of 3 triangles'],
    ['nothing but a head', new Uint8Array(60), 'The file ends too early'],
    ['NaN', (() => { const b = binaryStl(); b.fill(255, 84 + 62, 84 + 66); return b; })(), 'A coordinate of triangle 1 is not a finite number'],
  ])('%s: is said', async (_, content, message) => {
    expect(await messageOf(content, 'a.stl')).toBe(message);
  });

  test('text without its end: read, and said', async () => {
    const { warnings } = await read(kStl.replace('endsolid two vertex\n', ''));
    expect(warnings).toEqual(['The file has no end, and may be cut off']);
  });
});

const view = (bufferView: number, componentType: number, count: number, type: string, rest: object = {}) => ({ bufferView, componentType, count, type, ...rest });

describe('GLB', () => {
  test('triangles of a node, and where its parents put them', async () => {
    expect(lists(await read(kGlb))).toEqual(lists(kMesh));
    const moved = await read(glbOf(gltfOf({ nodes: [{ translation: [1, 2, 3], children: [1] }, { mesh: 0, scale: [2, 2, 2] }] }), kGlbData));
    expect(corners(moved)).toEqual(corners(kMesh).map(([x, y, z]) => [2 * x + 1, 2 * y + 2, Math.fround(2 * z + 3)]));
  });

  test('mirrored: faces are turned, so that outside stays outside', async () => {
    const matrix = new Matrix4().makeScale(-1, 1, 1).toArray();
    const [a, b, c] = corners(await read(glbOf(gltfOf({ nodes: [{ matrix, mesh: 0 }] }), kGlbData)));
    expect([a, c, b]).toEqual(corners(kMesh).slice(0, 3).map(([x, y, z]) => [0 - x, y, z]));
  });

  test('several meshes and nodes of one mesh: joined; nodes of other scenes: not', async () => {
    const nodes = [{ mesh: 0 }, { mesh: 0, translation: [5, 0, 0] }, { mesh: 0, translation: [9, 0, 0] }];
    const both = await read(glbOf(gltfOf({ nodes, scenes: [{ nodes: [0, 1] }, { nodes: [2] }] }), kGlbData));
    expect(both.faces.length).toBe(2 * kFaces.length);
    expect((await read(glbOf(gltfOf({ nodes, scene: undefined, scenes: undefined }), kGlbData))).faces.length).toBe(3 * kFaces.length);
  });

  test('strips, fans, no indices; points and lines: left out', async () => {
    const of = async (mode: number) => triangles(await read(glbOf(gltfOf({}, { mode, indices: undefined }), kGlbData)));
    expect(await of(5)).toEqual(['0 1 2', '1 3 2', '2 3 4']);
    expect(await of(6)).toEqual(['0 1 2', '0 2 3', '0 3 4']);
    expect(await of(4)).toEqual(['0 1 2']);
    const primitive = { attributes: { POSITION: 0 }, indices: 1 };
    const mesh = await read(glbOf(gltfOf({ meshes: [{ primitives: [{ ...primitive, mode: 1 }, primitive] }] }), kGlbData));
    expect([lists(mesh), mesh.warnings]).toEqual([lists(kMesh), ['Lines and points are left out']]);
  });

  test('quantised and interleaved positions, sparse ones, colours and texture coordinates', async () => {
    const data = new ArrayBuffer(200);
    const bytes = new DataView(data);
    // Positions as shares of 32767 and colours of 8 bits, side by side.
    const points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
    points.forEach((p, v) => {
      p.forEach((x, k) => { bytes.setInt16(12 * v + 2 * k, 32767 * x, true); });
      p.forEach((x, k) => { bytes.setUint8(12 * v + 8 + k, 255 * x); });
    });
    [0, 0, 1, 0, 0, 1].forEach((x, i) => { bytes.setFloat32(40 + 4 * i, x, true); });
    // In place of vertex 1.
    bytes.setUint8(64, 1);
    [32767, 0, 32767].forEach((x, k) => { bytes.setInt16(68 + 2 * k, x, true); });
    const json = gltfOf({
      extensionsUsed: ['KHR_mesh_quantization', 'KHR_materials_unlit'],
      extensionsRequired: ['KHR_mesh_quantization', 'KHR_materials_unlit'],
      materials: [{}],
      meshes: [{ primitives: [{ attributes: { POSITION: 0, COLOR_0: 1, TEXCOORD_0: 2, NORMAL: 9 }, material: 0 }] }],
      accessors: [
        view(0, 5122, 3, 'VEC3', {
          normalized: true,
          sparse: { count: 1, indices: { bufferView: 2, componentType: 5121 }, values: { bufferView: 3 } },
        }),
        view(0, 5121, 3, 'VEC3', { normalized: true, byteOffset: 8 }),
        view(1, 5126, 3, 'VEC2'),
      ],
      bufferViews: [
        { buffer: 0, byteLength: 36, byteStride: 12 },
        { buffer: 0, byteOffset: 40, byteLength: 24 },
        { buffer: 0, byteOffset: 64, byteLength: 1 },
        { buffer: 0, byteOffset: 68, byteLength: 6 },
      ],
    });
    const mesh = await read(glbOf(json, new Uint8Array(data)));
    expect(lists(mesh)).toEqual([[0, 0, 0, 1, 0, 1, 0, 1, 0], [0, 1, 2]]);
    expect(mesh.attributes).toEqual({
      color: { data: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), size: 3 },
      uv: { data: Float32Array.of(0, 1, 1, 1, 0, 0), size: 2 },
    });
    expect(mesh.warnings).toEqual(['Materials are left out']);
  });

  test('vertices that a texture splits: one again, without its coordinates', async () => {
    const at = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
    const uv = [0, 0, 1, 0, 0, 1, 0.5, 0, 1, 1, 0.5, 1];
    const data = new Uint8Array(new Float32Array([...at, ...uv]).buffer);
    const json = gltfOf({
      meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 } }] }],
      accessors: [view(0, 5126, 6, 'VEC3'), view(1, 5126, 6, 'VEC2')],
      bufferViews: [{ buffer: 0, byteLength: 72 }, { buffer: 0, byteOffset: 72, byteLength: 48 }],
    });
    const mesh = await read(glbOf(json, data));
    expect(lists(mesh)).toEqual([[0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0], [0, 1, 2, 1, 3, 2]]);
    const split = await read(glbOf(json, data), '', { seams: 'split' });
    expect(lists(split)).toEqual([at, [0, 1, 2, 3, 4, 5]]);
    expect(split.attributes).toEqual({ uv: { data: Float32Array.from(uv, (x, i) => (i % 2 === 1 ? 1 - x : x)), size: 2 } });
    // The seam is no rim once its vertices are one.
    expect(findHoles(split, { weld: 0 }).loops).toHaveLength(1);
    expect([mesh.attributes, mesh.warnings]).toEqual([undefined, ['Some vertices have several texture coordinates: these are left out, for the mesh would have a seam there']]);
  });

  const positions = view(0, 5126, 5, 'VEC3');
  test.each([
    ['compressed', gltfOf({}, { extensions: { KHR_draco_mesh_compression: {} } }), 'The mesh is compressed (KHR_draco_mesh_compression), which is not read'],
    ['data elsewhere', gltfOf({ buffers: [{ uri: 'a.bin' }] }), 'The data of accessor 0 are in another file'],
    ['only lines', gltfOf({}, { mode: 1 }), 'The file has no triangles'],
    ['a loop of nodes', gltfOf({ nodes: [{}, { children: [2] }, { children: [1] }] }), 'The file is damaged: a node is below itself'],
    ['a node below itself', gltfOf({ nodes: [{ children: [0] }] }), 'The file is damaged: node 0 is below itself'],
    ['a node below two', gltfOf({ nodes: [{ children: [2] }, { children: [2] }, { mesh: 0 }] }), 'The file is damaged: node 2 is below two others'],
    ['a node that is not there', gltfOf({ nodes: [{ children: [9] }] }), 'The file is damaged: there is no node 9'],
    ['a mesh that is not there', gltfOf({ nodes: [{ mesh: 1 }] }), 'The file is damaged: there is no mesh 1'],
    ['accessors that are not there', gltfOf({ accessors: [] }), 'The file is damaged: there is no accessor 0'],
    ['data that end early', gltfOf({ bufferViews: [{ buffer: 0, byteLength: 59 }] }), 'The file is damaged: the data of accessor 0 go on beyond their end'],
    ['data beyond the file', gltfOf({ bufferViews: [{ buffer: 0, byteOffset: 40, byteLength: 60 }] }), 'The file is damaged: the data of accessor 0 go on beyond their end'],
    ['no data', gltfOf({ accessors: [{ ...positions, bufferView: undefined }] }), 'Accessor 0 has no data in the file'],
    ['another type', gltfOf({ accessors: [{ ...positions, type: 'VEC2' }] }), 'The file is damaged: accessor 0 is VEC2, and not VEC3'],
    ['too large an index', gltfOf({ accessors: [{ ...positions, count: 3 }, view(1, 5123, 9, 'SCALAR')] }), 'A triangle names the vertex 3, and there are only 3'],
    ['things of other kinds', gltfOf({ nodes: 7, meshes: 'no' }), 'The file is damaged'],
  ])('%s: is said', async (_, json, message) => {
    expect(await messageOf(glbOf(json, kGlbData))).toBe(message);
  });

  test('lengths that are wrong: are said', async () => {
    const changed = (at: number, value: number) => {
      const bytes = kGlb.slice();
      new DataView(bytes.buffer).setUint32(at, value, true);
      return messageOf(bytes);
    };
    expect(await changed(4, 1)).toBe('The file is of version 1 of GLB, and only 2 is read');
    expect(await changed(8, kGlb.length + 1)).toBe(`The file ends too early: it has ${kGlb.length} of ${kGlb.length + 1} bytes`);
    expect(await changed(12, kGlb.length)).toBe(`The file is damaged: a part of ${kGlb.length} bytes begins at byte 12, and goes on beyond the end`);
    expect(await changed(16, 7)).toBe('The file is damaged: it has no description');
    expect(await messageOf(kGlb.subarray(0, 15))).toBe('The file ends too early');
  });
});

describe('what is written', () => {
  const third = (x: number): number => Math.fround(x / 3 + 1e-7);
  const color = { data: Float32Array.from({ length: 20 }, (_, i) => (i % 6) / 5), size: 4 };
  const uv = { data: Float32Array.from({ length: 10 }, (_, i) => Math.fround(i / 10)), size: 2 };
  const heat = { data: Float32Array.of(-1, 0, 1e-9, 7, 1e20), size: 1 };
  const single: MeshLike = { ...kMesh, positions: Float32Array.from(kPoints, third), attributes: { color, uv, heat } };
  const double: MeshLike = { ...single, positions: Float64Array.from(kPoints, (x) => x / 3 + 1e6) };

  test.each<MeshFormat>(['obj', 'ply'])('%s: comes back bit for bit, in both precisions', async (format) => {
    for (const mesh of [single, double]) {
      const back = await readMesh(await writeMesh(mesh, format, { name: 'two\nlines' }));
      const exact = mesh === double ? back.positions : back.positions.map(Math.fround);
      expect([...exact]).toEqual([...mesh.positions]);
      expect([...back.faces]).toEqual(kFaces);
      expect(back.warnings).toEqual([]);
    }
  });

  test('STL and GLB: come back in single precision', async () => {
    expect(corners(await readMesh(await writeMesh(single, 'stl')))).toEqual(corners(single));
    expect(lists(await readMesh(await writeMesh(single, 'glb')))).toEqual(lists(single));
  });

  test('attributes: come back from where there is a place for them', async () => {
    const back = async (format: MeshFormat) => (await readMesh(await writeMesh(single, format))).attributes ?? {};
    const opaque = color.data.filter((_, i) => i % 4 < 3);
    const near = ({ data, size }: { data: Float32Array; size: number }, wanted: Float32Array, by: number) => {
      expect(data.length / size).toBe(5);
      data.forEach((x, i) => { expect(Math.abs(x - wanted[i])).toBeLessThan(by); });
    };
    const obj = await back('obj');
    expect(Object.keys(obj)).toEqual(['color', 'uv']);
    near(obj.color, opaque, 1e-6);
    expect(obj.uv).toEqual(uv);
    const made = await back('ply');
    expect(made).toEqual({ color, uv, heat });
    const glb = await back('glb');
    expect(Object.keys(glb)).toEqual(['color', 'uv']);
    near(glb.color, color.data, 1e-6);
    near(glb.uv, uv.data, 1e-7);
    expect(await back('stl')).toEqual({});
  });

  test('GLB: as glTF has it, colours linear in light and textures from the upper left corner', async () => {
    const bytes = await writeMesh({ ...single, attributes: { color: { data: new Float32Array(15).fill(0.5), size: 3 }, uv } }, 'glb', { name: 'bust' });
    const view = new DataView(bytes.buffer);
    expect([view.getUint32(0, true), view.getUint32(4, true), view.getUint32(8, true)]).toEqual([0x46546c67, 2, bytes.length]);
    const length = view.getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))) as {
      meshes: { name: string; primitives: { attributes: Record<string, number> }[] }[];
      accessors: { bufferView: number; byteOffset?: number; componentType: number; min?: number[] }[];
      bufferViews: { byteOffset?: number }[];
    };
    expect(json.meshes[0].name).toBe('bust');
    const at = (name: string, i: number) => {
      const accessor = json.accessors[json.meshes[0].primitives[0].attributes[name]];
      return view.getFloat32(28 + length + (json.bufferViews[accessor.bufferView].byteOffset ?? 0) + (accessor.byteOffset ?? 0) + 4 * i, true);
    };
    // 0.5 on a display is about a fifth of the light.
    expect(at('COLOR_0', 0)).toBeCloseTo(0.2140411, 6);
    expect(at('TEXCOORD_0', 1)).toBeCloseTo(1 - uv.data[1], 6);
    const { POSITION } = json.meshes[0].primitives[0].attributes;
    expect(json.accessors[POSITION].min).toEqual([0, 1, 2].map((k) => Math.min(...single.positions.filter((_, i) => i % 3 === k))));
  });

  test('names of attributes in PLY: without blanks, and none twice', async () => {
    const attributes = { 'x': heat, 'a b': heat, 'two': { data: new Float32Array(10), size: 2 } };
    const back = await readMesh(await writeMesh({ ...kMesh, attributes }, 'ply'));
    expect(Object.keys(back.attributes ?? {})).toEqual(['x_', 'a_b', 'two_0', 'two_1']);
  });

  test.each<[string, unknown, unknown, unknown, string]>([
    ['no mesh', null, 'obj', {}, 'bad-mesh'],
    ['no faces', { ...kMesh, faces: new Uint32Array() }, 'obj', {}, 'bad-mesh'],
    ['a vertex that is not there', { ...kMesh, faces: Uint32Array.of(0, 1, 5) }, 'obj', {}, 'bad-mesh'],
    ['NaN', { ...kMesh, positions: new Float32Array(15).fill(NaN) }, 'obj', {}, 'not-finite'],
    ['two numbers a colour', { ...kMesh, attributes: { color: { data: new Float32Array(10), size: 2 } } }, 'obj', {}, 'bad-attributes'],
    ['attributes of another length', { ...kMesh, attributes: { heat: { data: new Float32Array(4), size: 1 } } }, 'obj', {}, 'bad-attributes'],
    ['a format that there is not', kMesh, 'fbx', {}, 'bad-option'],
    ['no format', kMesh, undefined, {}, 'bad-option'],
    ['an option that there is not', kMesh, 'obj', { precision: 3 }, 'bad-option'],
    ['a name of another kind', kMesh, 'obj', { name: 7 }, 'bad-option'],
  ])('%s: is said', async (_, mesh, format, options, code) => {
    const error = await rejectionOf(writeMesh(mesh as MeshLike, format as MeshFormat, options as object));
    expect(error).toBeInstanceOf(SoapfilmError);
    expect(error.code).toBe(code);
  });
});

beforeAll(() => load({ parts: ['meshes'] }));

describe('filled', () => {
  test('read, filled, written, read: no hole is left, old vertices keep their colours, new ones have some between', async () => {
    const size = 12;
    const rows = Array.from({ length: size * size }, (_, v) => [v % size, Math.floor(v / size)]);
    const isGone = (i: number, j: number) => i > 3 && i < 7 && j > 3 && j < 8;
    const cells = rows.filter(([i, j]) => i + 1 < size && j + 1 < size && !isGone(i, j));
    const text = ply(
      'float x, float y, float z, uchar red, uchar green, uchar blue',
      rows.map(([i, j]) => `${i} ${j} ${0.1 * i * i} ${20 * i} ${20 * j} 7\n`).join(''),
      cells.map(([i, j]) => `4 ${j * size + i} ${j * size + i + 1} ${(j + 1) * size + i + 1} ${(j + 1) * size + i}\n`).join(''),
    );
    const mesh = await read(text);
    const rims = findHoles(mesh).groups.length;
    const { mesh: filled, oldVertices } = fillHoles(mesh, { holes: [0, 1].filter((g) => !findHoles(mesh).groups[g].isOpenRim) });
    expect(filled.positions.length / 3).toBeGreaterThan(oldVertices);
    for (const format of ['obj', 'ply', 'glb'] as const) {
      const back = await readMesh(await writeMesh(filled, format));
      expect(findHoles(back).groups).toHaveLength(rims - 1);
      const color = back.attributes?.color.data ?? new Float32Array();
      expect(Array.from(color.subarray(0, 3 * oldVertices), (x) => Math.round(255 * x))).toEqual(rows.flatMap(([i, j]) => [20 * i, 20 * j, 7]));
      const fresh = color.subarray(3 * oldVertices).filter((_, i) => i % 3 === 0);
      expect(Math.min(...fresh)).toBeGreaterThan(79 / 255);
      expect(Math.max(...fresh)).toBeLessThan(141 / 255);
    }
  });
});

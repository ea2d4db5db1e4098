// Files are told apart by what is in them: by the kinds of the modes, and by the formats of the field that none reads.
import { formatLoops, formatObj } from 'soapfilm';
import { describe, expect, test } from 'vitest';
import { Content } from '../../web/src/app/content.ts';
import { kKnownFiles } from '../../web/src/app/known_files.ts';
import { film } from '../../web/src/modes/film/mode.ts';
import { mesh } from '../../web/src/modes/mesh/mode.ts';
import { polygon } from '../../web/src/modes/polygon/mode.ts';

const bytesOf = (text: string) => new TextEncoder().encode(text);
const content = (data: string | Uint8Array) => new Content(typeof data === 'string' ? bytesOf(data) : data, 'stem');
const latin = (text: string) => Uint8Array.from(text, (letter) => letter.charCodeAt(0));
const utf16 = (text: string, isBig: boolean) => {
  const codes = Array.from(`\ufeff${text}`, (letter) => letter.charCodeAt(0));
  return Uint8Array.from(codes.flatMap((code) => (isBig ? [code >> 8, code & 255] : [code & 255, code >> 8])));
};
const kindOf = (data: string | Uint8Array, mode = film) => mode.files.find(({ isIt }) => isIt(content(data)))?.id;
const knownAs = (data: string | Uint8Array) => kKnownFiles.find(({ isIt }) => isIt(content(data)))?.what;

const kCurve = '1 3\n3\n0 0 0\n1 0 0\n0 1 0\n';
const kLines = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 1\n';
const kFaces = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n';
const triangle = { positions: new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), starts: new Uint32Array([0, 3]) };

describe('the kinds that film reads', () => {
  test.each([
    ['.curve', kCurve, 'curve'],
    ['.curve after comments and blank lines', `\n# by hand\n\n  # twice\n${kCurve}`, 'curve'],
    ['.curve with a comment between the counts', '1 # loop\n3 # vertices\n3\n0 0 0\n', 'curve'],
    ['.curve with Windows line ends', kCurve.replaceAll('\n', '\r\n'), 'curve'],
    ['.curve cut off after its counts', '1 3', 'curve'],
    ['.curve of a huge count', '99999999999999999999999 3\n', 'curve'],
    ['.curve broken further on', kCurve.replace('1 0 0', 'one 0 0'), 'curve'],
    ['loops as JSON', '{ "loops": [[[0,0,0],[1,0,0],[0,1,0]]] }', 'loops-json'],
    ['loops as a bare array', '\n [[[0,0,0],[1,0,0],[0,1e300,0]]]', 'loops-json'],
    ['JSON that is cut off', '{ "loops": [[[0,0,', 'loops-json'],
    ['OBJ lines', kLines, 'obj-lines'],
    ['OBJ lines after a long comment', `${'# words\n'.repeat(2000)}${kLines}`, 'obj-lines'],
    ['OBJ lines with Windows line ends and indented', kLines.replace(/^/gm, ' \t').replaceAll('\n', '\r\n'), 'obj-lines'],
    ['OBJ with lines and faces', kFaces + kLines, 'obj-lines'],
  ])('%s', (_, text, id) => {
    expect(kindOf(text)).toBe(id);
    expect(kindOf(bytesOf(`\ufeff${text}`)), 'with a mark of UTF-8').toBe(id);
    expect(kindOf(utf16(text, false)), 'in UTF-16').toBe(id);
    expect(kindOf(utf16(text, true)), 'in UTF-16, big end first').toBe(id);
  });

  test('what the library writes: told by all three formats, and by the loops of a surface', () => {
    expect(kindOf(formatLoops(triangle, 'curve'))).toBe('curve');
    expect(kindOf(formatLoops(triangle, 'json'))).toBe('loops-json');
    expect(kindOf(formatLoops(triangle, 'obj'))).toBe('obj-lines');
    const surface = { ...triangle, triangles: new Uint32Array([0, 1, 2]), loopVertices: new Uint32Array([0, 1, 2]) };
    expect(kindOf(formatObj(surface))).toBe('obj-lines');
  });

  test('GeoJSON in any wording: for polygons, not for films', () => {
    for (const type of ['FeatureCollection', 'Feature', 'GeometryCollection', 'MultiPolygon', 'Point']) {
      const text = JSON.stringify({ bbox: [0, 0, 1, 1], type });
      expect([kindOf(text), kindOf(text, polygon)]).toEqual([undefined, 'geojson']);
    }
  });
});

describe('the kinds that the mode of meshes reads', () => {
  const stl = new Uint8Array(84 + 2 * 50);
  stl[80] = 2;
  test.each<[string, string | Uint8Array, string]>([
    ['OBJ', kFaces, 'obj'],
    ['OBJ after comments', `# a bunny\nmtllib bunny.mtl\n${kFaces.replaceAll('\n', '\r\n')}`, 'obj'],
    ['STL as text', 'solid cube\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n', 'stl'],
    ['STL in binary', stl, 'stl'],
    ['PLY', 'ply\r\nformat ascii 1.0\r\n', 'ply'],
    ['GLB', latin('glTF\x02\0\0\0'), 'glb'],
  ])('%s', (_, data, id) => {
    expect([kindOf(data, mesh), kindOf(data), kindOf(data, polygon)]).toEqual([id, undefined, undefined]);
  });

  test('an OBJ of lines: is none', () => {
    expect(kindOf(kLines, mesh)).toBeUndefined();
  });
});

describe('the formats that no mode reads', () => {
  const table = 'name,x,y\nfirst,0,1\nsecond,1,0\n';
  test.each<[string, string | Uint8Array]>([
    ['an OBJ file without lines', 'v 0 0 0\nv 1 0 0\n'],
    ['a mesh (OFF)', 'OFF\n3 1 0\n'],
    ['a mesh (OFF)', 'COFF\n3 1 0\n'],
    ['a mesh (glTF)', '{ "asset": { "version": "2.0" }, "meshes": [] }'],
    ['a TopoJSON file', '{ "type": "Topology", "arcs": [] }'],
    ['a JSON file of something else', '{ "type": "module", "name": "x" }'],
    ['a JSON file of something else', '{ "curves": [] }'],
    ['an SVG drawing', '<?xml version="1.0"?>\n<!-- by hand -->\n<svg xmlns="http://www.w3.org/2000/svg"/>'],
    ['an SVG drawing', '<svg width="1">'],
    ['an HTML page', '<!DOCTYPE html>\n<html><svg ></svg>'],
    ['a KML file', '<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2">'],
    ['an XML file', '<?xml version="1.0"?><plist>'],
    ['a CAD model (STEP)', 'ISO-10303-21;\nHEADER;\n'],
    ['a CAD model (IGES)', `${'words'.padEnd(72)}S      1\n${'1H,,1H;'.padEnd(72)}G      1\n`],
    ['a CAD drawing (DXF)', '  0\r\nSECTION\r\n  2\r\nHEADER\r\n'],
    ['a VTK file', '# vtk DataFile Version 3.0\n'],
    ['a geometry in WKT', 'POLYGON ((0 0, 1 0, 0 1, 0 0))'],
    ['a grid of heights (ASC)', 'ncols 4\nnrows 3\n'],
    ['a PNG picture', latin('\x89PNG\r\n\x1a\n\0\0\0')],
    ['a JPEG picture', latin('\xff\xd8\xff\xe0\0')],
    ['a GIF picture', latin('GIF89a\0')],
    ['a WebP picture', latin('RIFF\0\0\0\0WEBPVP8 ')],
    ['a PDF document', '%PDF-1.7\n'],
    ['a ZIP archive, or a file packed in one, such as 3MF', latin('PK\x03\x04\0')],
    ['a table (CSV)', table],
    ['a table (CSV)', table.replaceAll(',', ';').replaceAll('\n', '\r\n')],
  ])('%s', (what, data) => {
    expect(kindOf(data) ?? kindOf(data, polygon)?.replace('geojson', '')).toBeUndefined();
    expect(knownAs(data)).toBe(what);
  });

  test.each([
    ['words', 'Dear Sir,\nl am here, as you know.\nv is a letter.\n'],
    ['one word', 'no'],
    ['bytes', Uint8Array.from({ length: 500 }, (_, i) => (i * 97) & 255)],
  ])('%s: of no known format', (_, data) => {
    expect([kindOf(data), kindOf(data, polygon), knownAs(data)]).toEqual([undefined, undefined, undefined]);
  });

  test('many blank lines and comments: told in a time that grows as they do', () => {
    for (const text of ['\n'.repeat(2e6), '# '.repeat(1e6), `1 ${'# # '.repeat(1e6)}`, ' \t'.repeat(1e6)]) {
      expect(kindOf(text)).toBeUndefined();
      knownAs(text);
    }
  });
});

// Formats of the field that no mode reads, to tell by name what a file is. A mode that learns to read one takes its
// entry over. Those with a mark of their own come before those that are told by how they look.
import type { Content } from './content.ts';
import type { FileKind } from './mode.ts';

type KnownFile = Pick<FileKind, 'what' | 'isIt'>;

const marked = (what: string, ...marks: readonly string[]): KnownFile => ({
  what,
  isIt: (content) => marks.some((mark) => content.hasMark(mark)),
});

/** Text that begins in such a way. */
const begun = (what: string, beginning: RegExp): KnownFile => ({
  what,
  isIt: ({ isText, head }) => isText && beginning.test(head),
});

/** Lines of equally many fields, two at least. */
function isTable({ isText, head }: Content): boolean {
  if (!isText) return false;
  // The last line may have been cut off.
  const lines = head.split(/\r\n?|\n/).slice(0, -1).filter((line) => line.trim() !== '').slice(0, 10);
  return [',', ';', '\t'].some((separator) => {
    const fields = lines.map((line) => line.split(separator).length);
    return lines.length > 1 && fields[0] > 1 && fields.every((count) => count === fields[0]);
  });
}

export const kKnownFiles: readonly KnownFile[] = [
  marked('a PNG picture', '\x89PNG'),
  marked('a JPEG picture', '\xff\xd8\xff'),
  marked('a GIF picture', 'GIF87a', 'GIF89a'),
  { what: 'a WebP picture', isIt: (content) => content.hasMark('RIFF') && content.hasMark('WEBP', 8) },
  marked('a TIFF picture', 'II*\0', 'MM\0*'),
  marked('a PDF document', '%PDF-'),
  marked('a ZIP archive, or a file packed in one, such as 3MF', 'PK\x03\x04', 'PK\x05\x06'),
  marked('a gzip archive', '\x1f\x8b'),
  { what: 'a mesh (glTF)', isIt: (content) => content.isJson && content.hasKey('asset') },
  marked('a mesh (binary FBX)', 'Kaydara FBX Binary'),
  marked('a Blender file', 'BLENDER'),
  marked('a Rhino model (3DM)', '3D Geometry File Format'),
  marked('a shapefile', '\0\0\x27\x0a'),
  marked('an SQLite database, such as a GeoPackage', 'SQLite format 3'),
  begun('a mesh (OFF)', /^(ST)?C?N?4?n?OFF\b/),
  begun('a VTK file', /^# vtk DataFile/),
  begun('a CAD model (STEP)', /^ISO-10303-21/),
  // Lines have 80 columns; those of the second section are numbered after a G.
  begun('a CAD model (IGES)', /^.{72}G[ 0]{0,6}1\s*$/m),
  begun('a CAD drawing (DXF)', /^(999\s*[\r\n].*\s+)?0\s+SECTION\b/),
  { what: 'a TopoJSON file', isIt: ({ jsonType }) => jsonType === 'Topology' },
  { what: 'a JSON file of something else', isIt: ({ isJson, json }) => isJson && json !== undefined },
  begun('an HTML page', /^(<!--[^]*?-->\s*)?<(!doctype html|html)[\s>]/i),
  begun('an SVG drawing', /^<([^]*<)?svg[\s>]/),
  begun('a KML file', /^<([^]*<)?kml[\s>]/),
  begun('a GPX file', /^<([^]*<)?gpx[\s>]/),
  begun('an XML file', /^<\?xml\s/),
  begun('a geometry in WKT', /^(SRID=\d+;\s*)?(MULTI)?(POINT|LINESTRING|POLYGON)\s*(Z|M|ZM)?\s*(\(|EMPTY)/i),
  begun('a grid of heights (ASC)', /^ncols\s+\d/i),
  { what: 'an OBJ file without lines', isIt: (content) => content.hasStatement('v') },
  { what: 'a table (CSV)', isIt: isTable },
];

// Triangulators of polygons behind one face: `prepare(polygons, points, repairs)` brings the input into
// the form that the library takes, outside the clock; what it returns triangulates all of them. The
// others take invalid polygons as they come, and give something.
import cdt2d from 'cdt2d';
import Constrainautor from '@kninnug/constrainautor';
import Delaunator from 'delaunator';
import earcut, { refine } from 'earcut';
import libtess from 'libtess';
import poly2tri from 'poly2tri';
import tess2 from 'tess2';
import { triangulatePolygon, triangulatePolygons } from 'soapfilm';

/** Flat arrays of many polygons. */
function toBatch(polygons) {
  const ringStarts = [0];
  const polygonStarts = [0];
  const coordinates = [];
  for (const polygon of polygons) {
    for (const ring of polygon) {
      for (const point of ring) coordinates.push(point[0], point[1]);
      ringStarts.push(coordinates.length / 2);
    }
    polygonStarts.push(ringStarts.length - 1);
  }
  return {
    positions: Float64Array.from(coordinates),
    ringStarts: Uint32Array.from(ringStarts),
    polygonStarts: Uint32Array.from(polygonStarts),
  };
}

const soapfilm = (own) => ({
  prepare(polygons, points, repairs) {
    const options = repairs ? { ...own, repair: 'even-odd' } : own;
    const batch = toBatch(polygons);
    if (polygons.length > 1) return () => triangulatePolygons(batch, options).triangles;
    const polygon = { positions: batch.positions, starts: batch.ringStarts, ...(points && { points }) };
    return () => triangulatePolygon(polygon, options).triangles;
  },
});

/** As earcut takes them: one list of coordinates a polygon. */
const toEarcut = (polygon) => {
  const holes = [];
  let count = polygon[0].length;
  for (const ring of polygon.slice(1)) {
    holes.push(count);
    count += ring.length;
  }
  return { coordinates: polygon.flat(2), holes };
};

const each = (polygons, convert, triangulate) => {
  const inputs = polygons.map(convert);
  return () => inputs.map(triangulate);
};

/** Rings as edges between numbered points. */
const toEdges = (polygon) => {
  const points = polygon.flat();
  let first = 0;
  const edges = polygon.flatMap((ring) => {
    const start = first;
    first += ring.length;
    return ring.map((_, i) => [start + i, start + ((i + 1) % ring.length)]);
  });
  return { points, edges };
};

function tessellate(tesselator, rings) {
  const triangles = [];
  tesselator.gluTessBeginPolygon(triangles);
  for (const ring of rings) {
    tesselator.gluTessBeginContour();
    for (const point of ring) tesselator.gluTessVertex(point, point);
    tesselator.gluTessEndContour();
  }
  tesselator.gluTessEndPolygon();
  return triangles;
}

function libtessTesselator() {
  const { GluTesselator, gluEnum } = libtess;
  const tesselator = new GluTesselator();
  tesselator.gluTessCallback(gluEnum.GLU_TESS_VERTEX_DATA, (data, all) => all.push(data[0], data[1]));
  tesselator.gluTessCallback(gluEnum.GLU_TESS_COMBINE, (at) => at);
  // Its presence asks for triangles alone, without fans and strips.
  tesselator.gluTessCallback(gluEnum.GLU_TESS_EDGE_FLAG, () => undefined);
  tesselator.gluTessNormal(0, 0, 1);
  return tesselator;
}

/** `most`: vertices of an input at which it is still worth waiting for. */
export const kEngines = {
  flooding: { ...soapfilm({}), most: Infinity },
  trapezoids: { ...soapfilm({ method: 'trapezoids' }), most: Infinity },
  delaunay: { ...soapfilm({ quality: 'delaunay' }), most: Infinity },
  verify: { ...soapfilm({ verify: true }), most: Infinity },
  strips: { ...soapfilm({ method: 'trapezoids', output: 'strips' }), most: 1e5 },
  'one by one': {
    most: 0,
    prepare: (polygons, points, repairs) =>
      each(
        polygons,
        (polygon) => {
          const { coordinates, holes } = toEarcut(polygon);
          return { coordinates, holeIndices: holes };
        },
        (input) => triangulatePolygon(input, { repair: repairs ? 'even-odd' : 'none' }).triangles,
      ),
  },
  earcut: {
    most: 5e4,
    prepare: (polygons) =>
      each(polygons, toEarcut, ({ coordinates, holes }) => earcut(coordinates, holes, 2)),
  },
  'earcut, refined': {
    most: 2e4,
    prepare: (polygons) =>
      each(polygons, toEarcut, ({ coordinates, holes }) => {
        const triangles = earcut(coordinates, holes, 2);
        refine(triangles, coordinates);
        return triangles;
      }),
  },
  libtess: {
    most: 2e4,
    prepare(polygons) {
      const tesselator = libtessTesselator();
      return () => polygons.map((rings) => tessellate(tesselator, rings));
    },
  },
  tess2: {
    most: 2e4,
    prepare: (polygons) =>
      each(
        polygons,
        (rings) => rings.map((ring) => ring.flat()),
        (contours) =>
          tess2.tesselate({
            contours,
            windingRule: tess2.WINDING_ODD,
            elementType: tess2.POLYGONS,
            polySize: 3,
            vertexSize: 2,
          }).elements,
      ),
  },
  poly2tri: {
    most: 2e4,
    prepare: (polygons) =>
      each(
        polygons,
        (rings) => rings,
        (rings) => {
          // It keeps its marks on the points, so that they cannot be used twice.
          const [outer, ...holes] = rings.map((ring) => ring.map(([x, y]) => new poly2tri.Point(x, y)));
          return new poly2tri.SweepContext(outer).addHoles(holes).triangulate().getTriangles();
        },
      ),
  },
  cdt2d: {
    most: 2e4,
    prepare: (polygons) =>
      each(polygons, toEdges, ({ points, edges }) => cdt2d(points, edges, { exterior: false }).flat()),
  },
  // Triangles outside the polygon are left in, which is in its favour.
  'delaunator, constrained': {
    most: 1e5,
    prepare: (polygons) =>
      each(polygons, toEdges, ({ points, edges }) => {
        const found = Delaunator.from(points);
        new Constrainautor(found).constrainAll(edges);
        return found.triangles;
      }),
  },
};

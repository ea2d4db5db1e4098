#include "support/polygon_families.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sftest {
namespace {

// A square of side 16 and things to put in it, in integers.
const Ring kSquare = {{0, 0}, {16, 0}, {16, 16}, {0, 16}};
Ring box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}
double below(Random& random, uint32_t n) { return random.below(n); }

/// Every ring with points repeated at random, or all of them `copies` times.
Polygon repeated(const Polygon& polygon, Random& random, uint32_t copies) {
  std::vector<Ring> rings = ringsOf(polygon);
  for (Ring& ring : rings) {
    Ring longer;
    for (const Point p : ring)
      for (uint32_t i = copies ? copies : 1 + random.below(3); i > 0; --i) longer.push_back(p);
    ring = longer;
  }
  return polygonOf(rings);
}

/// A ring of integers times 4 with up to three points put on each edge, at quarters.
Ring subdivided(const Ring& ring, Random& random) {
  Ring result;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    result.push_back({4 * a.x, 4 * a.y});
    for (int k = 1; k < 4; ++k)
      if (random.chance(0.6)) result.push_back({(4 - k) * a.x + k * b.x, (4 - k) * a.y + k * b.y});
  }
  return result;
}

Polygon latticePolygon(Random& random) {
  return latticeRegion(4 + random.below(5), 5 + random.below(40), false, random.chance(0.5),
                       random);
}

/// (q, p) coprime and (u, v) with q v - p u = 1: the lattice point nearest to the line on its left.
struct NearMiss {
  Point end, near;
};
NearMiss nearMiss(Random& random) {
  int64_t q = 1000 + random.below(1u << 25), p = 1 + random.below(uint32_t(q) - 1);
  for (;; ++p) {
    // Extended Euclid: u and v with q v - p u = gcd.
    int64_t a = q, b = p, va = 1, vb = 0, ua = 0, ub = 1;
    while (b != 0) {
      const int64_t k = a / b;
      std::tie(a, b) = std::make_pair(b, a - k * b);
      std::tie(va, vb) = std::make_pair(vb, va - k * vb);
      std::tie(ua, ub) = std::make_pair(ub, ua - k * ub);
    }
    if (a != 1) continue;
    int64_t v = va, u = -ua;
    while (u <= 0 || v <= 0) u += q, v += p;
    while (u > q) u -= q, v -= p;
    return {{double(q), double(p)}, {double(u), double(v)}};
  }
}

/// A triangle on the left of a long edge, whose tip is as near to the edge as can be: 1 just
/// inside, 0 on it, -1 just outside, in units of the least possible distance.
Polygon tipAtEdge(Random& random, int where, bool asHole) {
  const NearMiss m = nearMiss(random);
  const Point e = m.end;
  // The lattice's points just right of the line are those just left of it, seen from the end.
  Point tip = m.near;
  if (where < 0) tip = {e.x - m.near.x, e.y - m.near.y};
  if (where == 0) tip = {4 * e.x, 4 * e.y};
  Point end = where == 0 ? Point{8 * e.x, 8 * e.y} : e;
  const double far = 16 * (e.x + e.y);
  // The polygon reaches far to the left of the edge; the tip's triangle lies well inside.
  const Ring outer = {{0, 0}, end, {end.x - 4 * far, end.y + 4 * far}, {-4 * far, 4 * far}};
  const Ring hole = {tip, {tip.x - far, tip.y + far + 1}, {tip.x - far - 2, tip.y + far}};
  if (asHole) return polygonOf({outer, hole});
  // As a notch, let down from the far edge: the same tip on the same ring.
  return polygonOf({{{0, 0},
                     end,
                     outer[2],
                     {outer[2].x - 1, outer[2].y},
                     tip,
                     {outer[3].x + 1, outer[3].y},
                     outer[3]}});
}

Polygon scaledToMagnitude(const Polygon& polygon, double magnitude) {
  double largest = 0;
  for (const double x : polygon.positions) largest = std::max(largest, std::fabs(x));
  int exponent;
  std::frexp(magnitude / largest, &exponent);
  return scaledBy(polygon, std::ldexp(1.0, exponent - 1));
}

Polygon withCoordinate(Random& random, double value) {
  Polygon polygon = smallPolygon(random);
  polygon.positions[random.below(uint32_t(polygon.positions.size()))] = value;
  return polygon;
}

const std::vector<Family>& validFamilies() {
  static const std::vector<Family> families = {
      {"small polygons", kValid, "nothing touches, or as the convention has it", true,
       [](Random& random) { return smallPolygon(random); }},
      {"duplicate vertices", kValid, "consecutive equal points count once", false,
       [](Random& random) { return repeated(latticePolygon(random), random, 0); }},
      {"all vertices doubled", kValid, "consecutive equal points count once", true,
       [](Random& random) { return repeated(smallPolygon(random), random, 2); }},
      {"repeated end point", kValid, "closes the ring and is no vertex of its own", true,
       [](Random& random) {
         std::vector<Ring> rings = ringsOf(smallPolygon(random));
         for (Ring& ring : rings) ring.push_back(ring.front());
         return polygonOf(rings);
       }},
      {"collinear runs", kValid, "straight angles are angles", false,
       [](Random& random) {
         std::vector<Ring> rings = ringsOf(latticePolygon(random));
         for (Ring& ring : rings) ring = subdivided(ring, random);
         return polygonOf(rings);
       }},
      {"all vertices but one collinear", kValid, "one corner off the line spans area", false,
       [](Random& random) {
         Ring ring;
         for (uint32_t i = 0; i < 2 + random.below(20); ++i) ring.push_back({double(i), 0});
         ring.push_back({below(random, 30), 1 + below(random, 5)});
         return polygonOf({ring});
       }},
      {"vertices at two heights", kValid, "equal coordinates are no fault", false,
       [](Random& random) {
         const uint32_t n = 2 + random.below(20);
         Ring ring;
         for (uint32_t i = 0; i < n; ++i) ring.push_back({double(i), 0});
         for (uint32_t i = n; i-- > 0;) ring.push_back({2 * i + below(random, 2), 1});
         return polygonOf({ring});
       }},
      {"a notch's tip on the opposite edge", kValid, "touches; the polygon falls into two", false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf({{{0, 0}, {16, 0}, {16, 16}, {13, 16}, {x, 0}, {3, 16}, {0, 16}}});
       }},
      {"a notch's tip on the opposite vertex", kValid, "touches; the polygon falls into two", false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf(
             {{{0, 0}, {x, 0}, {16, 0}, {16, 16}, {13, 16}, {x, 0}, {3, 16}, {0, 16}}});
       }},
      {"a tooth's tip on an edge from outside", kValid, "touches; it encloses a pocket", false,
       [](Random& random) {
         const double x = 1 + below(random, 3);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {0, 16}, {0, 12}, {12, 12}, {12, 4}, {3, 4}, {x, 12}}});
       }},
      {"two lobes at a pinch point", kValid, "the ring touches itself from outside", false,
       [](Random& random) {
         const double a = 1 + below(random, 9), b = 1 + below(random, 9);
         return polygonOf(
             {{{0, 0}, {a, 0}, {a, a}, {a + b, a}, {a + b, a + b}, {a, a + b}, {a, a}, {0, a}}});
       }},
      {"many lobes at one point", kValid, "every other sector is inside", false,
       [](Random& random) {
         const Point tips[8] = {{8, 1},  {7, 4},  {4, 7},   {1, 8},
                                {-4, 7}, {-7, 2}, {-6, -5}, {3, -7}};
         Ring ring;
         for (int i = 0; i < 4; ++i) {
           const double s = 1 + below(random, 3);
           ring.push_back({0, 0});
           for (int k = 0; k < 2; ++k)
             ring.push_back({s * tips[2 * i + k].x, s * tips[2 * i + k].y});
         }
         return polygonOf({ring});
       }},
      {"lobes in crossing order", kValid, "passages cross at the point, but wind 0 or 1", false,
       [](Random& random) {
         const Point tips[6] = {{8, 1}, {7, 4}, {-4, 7}, {-7, 2}, {-6, -5}, {3, -7}};
         Ring ring;
         for (const int i : {0, 2, 1}) {
           const double s = 1 + below(random, 3);
           ring.push_back({0, 0});
           for (int k = 0; k < 2; ++k)
             ring.push_back({s * tips[2 * i + k].x, s * tips[2 * i + k].y});
         }
         return polygonOf({ring});
       }},
      {"a hole that is part of the outer ring", kValid, "the ring touches itself from inside",
       false,
       [](Random& random) {
         const double s = 1 + below(random, 4);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {0, 16}, {0, 0}, {2 * s, 3 * s}, {3 * s, 2 * s}}});
       }},
      {"a hole of two lobes", kValid, "a hole may pinch itself too", false,
       [](Random& random) {
         const double x = 6 + below(random, 4);
         return polygonOf(
             {kSquare, {{x, 8}, {x - 2, 4}, {x + 2, 4}, {x, 8}, {x + 2, 12}, {x - 2, 12}}});
       }},
      {"a hole with an island in it", kValid, "the hole's ring touches itself from inside", false,
       [](Random& random) {
         const double s = 1 + below(random, 3);
         return polygonOf({kSquare,
                           {{2, 2},
                            {14, 2},
                            {14, 14},
                            {2, 14},
                            {2, 2},
                            {2 + 2 * s, 2 + 3 * s},
                            {2 + 3 * s, 2 + 2 * s}}});
       }},
      {"a hole's vertex on a vertex of the outer ring", kValid, "touches", false,
       [](Random& random) {
         const double a = 1 + below(random, 14), b = 1 + below(random, 14);
         return polygonOf({kSquare, {{0, 0}, {a + 1, b}, {a, b + 1}}});
       }},
      {"a hole's vertex on an edge of the outer ring", kValid, "touches", false,
       [](Random& random) {
         const double a = 1 + below(random, 14);
         return polygonOf({kSquare, {{a, 0}, {a + 1, 8}, {a - 1, 9}}});
       }},
      {"an outer vertex on an edge of a hole", kValid, "touches", false,
       [](Random& random) {
         const double a = 5 + below(random, 6);
         return polygonOf({{{0, 0}, {16, 0}, {16, 16}, {a + 2, 16}, {a, 8}, {a - 1, 16}, {0, 16}},
                           {{2, 8}, {8, 2}, {14, 8}}});
       }},
      {"a hole from side to side", kValid, "touches twice; the polygon falls into two", false,
       [](Random& random) {
         const double a = 2 + below(random, 12), b = 2 + below(random, 12);
         return polygonOf({kSquare, {{a, 0}, {9, 8}, {b, 16}, {7, 8}}});
       }},
      {"a hole with all its vertices on the outer ring", kValid, "touches; only corners are left",
       false,
       [](Random& random) {
         const double a = 1 + below(random, 15), b = 1 + below(random, 15);
         return polygonOf({kSquare, {{a, 0}, {16, b}, {16 - a, 16}, {0, 16 - b}}});
       }},
      {"holes that touch at a vertex", kValid, "touches", false,
       [](Random& random) {
         const double a = 3 + below(random, 4);
         return polygonOf({kSquare, {{8, 8}, {2, a}, {a, 2}}, {{8, 8}, {14, 15 - a}, {13, 14}}});
       }},
      {"a hole's vertex on an edge of another", kValid, "touches", false,
       [](Random& random) {
         const double a = 4 + below(random, 9);
         return polygonOf({kSquare, {{2, 8}, {8, 2}, {14, 8}}, {{a, 8}, {a + 1, 12}, {a - 1, 14}}});
       }},
      {"holes around an island", kValid, "touch one another; the polygon falls into two", false,
       [](Random& random) {
         const double a = 1 + below(random, 3);
         return polygonOf({kSquare,
                           {{4, 4}, {12, 4}, {8, 4 - a}},
                           {{12, 4}, {8, 12}, {14, 12}},
                           {{8, 12}, {4, 4}, {a, 13}}});
       }},
      {"many holes at one point", kValid, "touch", false,
       [](Random& random) {
         const Point tips[8] = {{6, 1},  {5, 4},  {4, 5},   {1, 6},
                                {-4, 7}, {-7, 2}, {-6, -5}, {3, -7}};
         std::vector<Ring> rings = {kSquare};
         for (int i = 0; i < 4; ++i)
           if (random.chance(0.8))
             rings.push_back({{8, 8},
                              {8 + tips[2 * i].x, 8 + tips[2 * i].y},
                              {8 + tips[2 * i + 1].x, 8 + tips[2 * i + 1].y}});
         return polygonOf(rings);
       }},
      {"a hole in one of two lobes", kValid, "either lobe is inside", false,
       [](Random& random) {
         const double s = 1 + below(random, 3);
         return polygonOf({{{0, 0}, {8, 0}, {8, 8}, {16, 8}, {16, 16}, {8, 16}, {8, 8}, {0, 8}},
                           box(10, 10, s, s),
                           box(2, 2, s, s)});
       }},
      {"lattice regions", kValid, "touches at lattice points", false, latticePolygon},
      {"moved lattice regions", kValid, "touches at any points", true,
       [](Random& random) {
         return latticeRegion(4 + random.below(8), 5 + random.below(80), true, random.chance(0.5),
                              random);
       }},
      {"one-ulp grids", kValid, "every double is a place of its own", true,
       [](Random& random) {
         return placed(latticePolygon(random), 0, 0x1p-52, {1, random.chance(0.5) ? 1.0 : 1.5});
       }},
      {"slivers", kValid, "thin, but of positive area", true,
       [](Random& random) {
         const double h = std::ldexp(1 + random.unit(), -int(20 + random.below(900)));
         return rewritten(polygonOf({{{0, 0}, {random.unit(), -h}, {1, 0}, {random.unit(), h}}}),
                          random);
       }},
      {"a hole one ulp inside the outer ring", kValid, "a gap of one ulp is a gap", true,
       [](Random& random) {
         const double u = 0x1p-52;
         return rewritten(
             polygonOf({box(1, 1, 0.5, 0.5), box(1 + u, 1 + u, 0.5 - 2 * u, 0.5 - 2 * u)}), random);
       }},
      {"a hole's tip just inside an edge", kValid, "the nearest lattice point on the inner side",
       true, [](Random& random) { return tipAtEdge(random, 1, true); }},
      {"a hole's tip on a slanting edge", kValid, "exactly on it: touches", true,
       [](Random& random) { return tipAtEdge(random, 0, true); }},
      {"a notch's tip just inside an edge", kValid, "the nearest lattice point on the inner side",
       true, [](Random& random) { return tipAtEdge(random, 1, false); }},
      {"a notch's tip on a slanting edge", kValid, "exactly on it: touches", true,
       [](Random& random) { return tipAtEdge(random, 0, false); }},
      {"coordinates up to 1e150", kValid, "the largest that are accepted", true,
       [](Random& random) { return scaledToMagnitude(smallPolygon(random), 1e150); }},
      {"coordinates of 1e-150", kValid, "small is not zero", true,
       [](Random& random) { return scaledToMagnitude(smallPolygon(random), 1e-150); }},
      {"sides of 1e100 and 1e-100", kValid, "each axis has a size of its own", true,
       [](Random& random) {
         Polygon polygon = smallPolygon(random);
         for (size_t i = 0; i < polygon.positions.size(); ++i)
           polygon.positions[i] *= std::ldexp(1.0, i % 2 ? 332 : -332);
         return polygon;
       }},
      {"a hole of 1e-40 in a polygon of 1", kValid, "large and small in one", true,
       [](Random& random) {
         std::vector<Ring> rings = {box(-1, -1, 2, 2), starRing(6, 0.5, random)};
         for (Point& p : rings[1]) p = {p.x * 0x1p-133, p.y * 0x1p-133};
         return polygonOf(rings);
       }},
      {"a hole of 1e-140 in a polygon of 1e140", kValid, "large and small in one", true,
       [](Random& random) {
         std::vector<Ring> rings = {box(-1e140, -1e140, 2e140, 2e140), starRing(6, 0.5, random)};
         for (Point& p : rings[1]) p = {p.x * 0x1p-465, p.y * 0x1p-465};
         return polygonOf(rings);
       }},
      {"far offsets", kValid, "few digits are left, all exact", true,
       [](Random& random) {
         const double far = std::ldexp(1.0, int(30 + random.below(15)));
         return placed(latticePolygon(random), 0, 1, {random.chance(0.5) ? far : -far, far});
       }},
      {"negative zeros", kValid, "-0 and 0 are one number", true,
       [](Random& random) {
         Polygon polygon = latticePolygon(random);
         for (double& x : polygon.positions)
           if (x == 0 && random.chance(0.5)) x = -0.0;
         return polygon;
       }},
  };
  return families;
}

const double kInfinity = std::numeric_limits<double>::infinity();

const std::vector<Family>& faultyFamilies() {
  static const std::vector<Family> families = {
      {"a coordinate is NaN", kNotFinite, "no place in the plane", true,
       [](Random& random) { return withCoordinate(random, std::nan("")); }},
      {"a coordinate is infinite", kNotFinite, "no place in the plane", true,
       [](Random& random) {
         return withCoordinate(random, random.chance(0.5) ? kInfinity : -kInfinity);
       }},
      {"a coordinate beyond 1e150", kNotFinite, "products would overflow", true,
       [](Random& random) {
         return withCoordinate(random, random.chance(0.5) ? 1.1e150 : -1.7e308);
       }},
      {"fewer than 3 points", kDegenerate, "no area", false,
       [](Random& random) {
         Ring ring = kSquare;
         ring.resize(random.below(3));
         return polygonOf({ring});
       }},
      {"a hole of fewer than 3 points", kDegenerate, "no area", false,
       [](Random& random) {
         Ring ring = box(2 + below(random, 9), 2 + below(random, 9), 1, 1);
         ring.resize(random.below(3));
         return polygonOf({kSquare, ring});
       }},
      {"fewer than 3 distinct points", kDegenerate, "no area", false,
       [](Random& random) {
         const uint32_t distinct = 1 + random.below(2);
         Ring ring;
         for (uint32_t i = 0; i < 3 + random.below(6); ++i)
           ring.push_back(kSquare[random.below(distinct)]);
         return polygonOf({ring});
       }},
      {"two points and the first again", kDegenerate, "the third closes the ring", false,
       [](Random& random) {
         const Point p = {below(random, 9), 3};
         return polygonOf({{p, {20, below(random, 9)}, p}});
       }},
      {"all points collinear", kDegenerate, "no area: spikes at both ends", false,
       [](Random& random) {
         const uint32_t n = 3 + random.below(10);
         Ring ring;
         for (uint32_t i = 0; i < n; ++i) ring.push_back({double(i), 0});
         return polygonOf({ring});
       }},
      {"out and back through four points", kDegenerate, "no area: spikes at both ends", false,
       [](Random& random) {
         const Point b = {5, below(random, 9)};
         return polygonOf({{{0, 0}, b, {9, below(random, 9)}, b}});
       }},
      {"a spike outward", kDegenerate, "edges overlap next to each other", false,
       [](Random& random) {
         const double x = 1 + below(random, 14), y = -1 - below(random, 20);
         return polygonOf({{{0, 0}, {x, 0}, {x + 1, y}, {x, 0}, {16, 0}, {16, 16}, {0, 16}}});
       }},
      {"a spike inward", kDegenerate, "edges overlap next to each other", false,
       [](Random& random) {
         const double x = 1 + below(random, 14), y = 1 + below(random, 14);
         return polygonOf({{{0, 0}, {x, 0}, {x + 1, y}, {x, 0}, {16, 0}, {16, 16}, {0, 16}}});
       }},
      {"a spike beyond a corner", kDegenerate, "the ring turns back on its own edge", false,
       [](Random& random) {
         return polygonOf({{{0, 0}, {17 + below(random, 9), 0}, {16, 0}, {16, 16}, {0, 16}}});
       }},
      {"a spike back along an edge", kDegenerate, "the ring turns back on its own edge", false,
       [](Random& random) {
         return polygonOf({{{0, 0}, {16, 0}, {1 + below(random, 14), 0}, {16, 16}, {0, 16}}});
       }},
      {"a spike with equal points at its tip", kDegenerate, "repeating the tip is no excuse", false,
       [](Random& random) {
         const double x = 1 + below(random, 14);
         return repeated(
             polygonOf({{{0, 0}, {x, 0}, {x + 1, -3}, {x, 0}, {16, 0}, {16, 16}, {0, 16}}}), random,
             0);
       }},
      {"a spike of a hole", kDegenerate, "edges overlap next to each other", false,
       [](Random& random) {
         const double x = 5 + below(random, 5);
         return polygonOf({kSquare, {{4, 4}, {x, 4}, {x, 2}, {x, 4}, {12, 4}, {8, 12}}});
       }},
      {"a long way out and back", kDegenerate + kSelfIntersecting, "a spike of several edges",
       false,
       [](Random& random) {
         const Point a = {5, 20 + below(random, 9)}, b = {8, 30 + below(random, 9)};
         return polygonOf({{{0, 0}, {16, 0}, {16, 16}, {8, 16}, a, b, a, {8, 16}, {0, 16}}});
       }},
      {"bow-ties", kSelfIntersecting, "edges cross", false,
       [](Random& random) {
         return polygonOf(
             {{{0, 0}, {16, 16 + below(random, 9)}, {16, 0}, {0, 16 + below(random, 9)}}});
       }},
      {"bow-ties of no area", kSelfIntersecting, "two lobes of opposite sense cancel", false,
       [](Random& random) {
         const double w = 1 + below(random, 20), h = 1 + below(random, 20);
         return polygonOf({{{0, 0}, {w, h}, {w, 0}, {0, h}}});
       }},
      {"bow-ties crossing at a vertex", kSelfIntersecting, "the ring changes sides at the point",
       false,
       [](Random& random) {
         const double a = 1 + below(random, 9), b = 1 + below(random, 9);
         return polygonOf({{{0, 0}, {a, a}, {a + b, a + b}, {a + b, a}, {a, a}, {0, a}}});
       }},
      {"a figure of eight in two turns at a vertex", kSelfIntersecting, "lobes of opposite sense",
       false,
       [](Random& random) {
         const double a = 1 + below(random, 9), b = 1 + below(random, 9);
         return polygonOf({{{0, 0}, {a, 0}, {0, a}, {0, 0}, {0, -b}, {-b, 0}}});
       }},
      {"an edge that crosses a vertex", kSelfIntersecting, "sides are changed at the vertex", false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {12, 16}, {x, 0}, {x - 1, -5}, {x - 2, 16}, {0, 16}}});
       }},
      {"one small crossing", kSelfIntersecting, "two neighbours of a large ring swapped", true,
       [](Random& random) {
         const uint32_t n = 20 + random.below(200);
         Ring ring = regularRing(n, 1, {0, 0}, random.unit());
         std::swap(ring[3], ring[4]);
         return polygonOf({ring});
       }},
      {"a ring run twice", kSelfIntersecting, "every segment overlaps", false,
       [](Random& random) {
         Ring ring = starRing(5 + random.below(9), 0.5, random);
         ring.insert(ring.end(), ring.begin(), ring.end());
         return polygonOf({ring});
       }},
      {"a loop in a loop", kSelfIntersecting, "winding number 2", false,
       [](Random& random) {
         const double a = 2 + below(random, 5);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {0, 16}, {a, a}, {12, a}, {12, 12}, {a, 14}}});
       }},
      {"a loop in a loop from a common vertex", kSelfIntersecting,
       "winding number 2, nothing crosses an edge", false,
       [](Random& random) {
         const double s = 1 + below(random, 4);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {0, 16}, {0, 0}, {3 * s, 2 * s}, {2 * s, 3 * s}}});
       }},
      {"a keyhole", kSelfIntersecting, "the bridge is run there and back", false,
       [](Random& random) {
         const double a = 2 + below(random, 5);
         return polygonOf({{{0, 0},
                            {16, 0},
                            {16, 16},
                            {0, 16},
                            {0, 0},
                            {a, a},
                            {a, 10},
                            {10, 10},
                            {10, a},
                            {a, a}}});
       }},
      {"two edges that overlap in part", kSelfIntersecting, "a segment in common, in one sense",
       false,
       [](Random& random) {
         const double a = 1 + below(random, 6);
         return polygonOf({{{0, 0}, {16, 0}, {16, 16}, {8, 16}, {4, 0}, {4 + a, 0}, {0, 16}}});
       }},
      {"a tooth along an edge from outside", kSelfIntersecting,
       "a segment in common, in opposite senses", false,
       [](Random& random) {
         const double a = 1 + below(random, 2);
         return polygonOf({{{0, 0},
                            {16, 0},
                            {16, 16},
                            {0, 16},
                            {0, 12},
                            {12, 12},
                            {12, 4},
                            {3, 4},
                            {a + 1, 12},
                            {a, 12}}});
       }},
      {"a notch's tip just outside an edge", kSelfIntersecting,
       "the nearest lattice point on the outer side", true,
       [](Random& random) { return tipAtEdge(random, -1, false); }},
      {"a hole's tip just outside an edge", kHoleOutside,
       "the nearest lattice point on the outer side", true,
       [](Random& random) { return tipAtEdge(random, -1, true); }},
      {"a hole elsewhere", kHoleOutside, "nothing of it is in the polygon", false,
       [](Random& random) {
         return polygonOf({kSquare, box(20 + below(random, 9), below(random, 16), 3, 3)});
       }},
      {"a hole touching from outside", kHoleOutside, "nothing of it is in the polygon", false,
       [](Random& random) {
         return polygonOf({kSquare, {{16, 1 + below(random, 15)}, {20, 2}, {20, 14}}});
       }},
      {"a hole in a notch", kHoleOutside, "within the hull, but not in the polygon", false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {15, 16}, {x, 2}, {1, 16}, {0, 16}}, box(x, 12, 1, 1)});
       }},
      {"a hole that bridges a notch", kHoleOutside, "between vertices of the ring, but outside",
       false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {x, 2}, {0, 16}}, {{0, 16}, {16, 16}, {x, 6}}});
       }},
      {"a hole across an edge", kHoleOutside, "it crosses the outer ring", false,
       [](Random& random) {
         return polygonOf({kSquare, box(14, 1 + below(random, 12), 4, 2)});
       }},
      {"a hole across vertices alone", kHoleOutside, "in and out through common points", false,
       [](Random& random) {
         const double y = 3 + below(random, 9);
         return polygonOf({{{0, 0}, {16, 0}, {16, y - 1}, {16, y + 1}, {16, 16}, {0, 16}},
                           {{12, y}, {16, y - 1}, {20, y}, {16, y + 1}}});
       }},
      {"a hole around the outer ring", kHoleOutside, "nothing is left", false,
       [](Random& random) {
         return polygonOf({kSquare, box(-1 - below(random, 9), -1, 40, 18)});
       }},
      {"a hole with the outer ring's vertices", kHoleOutside, "it has all its edges in common",
       false,
       [](Random& random) {
         const Polygon polygon = latticePolygon(random);
         return polygonOf({ringsOf(polygon)[0], ringsOf(polygon)[0]});
       }},
      {"a hole with an edge on the outer ring", kHoleOutside, "a segment in common", false,
       [](Random& random) {
         return polygonOf({kSquare, box(below(random, 13), 0, 3, 5)});
       }},
      {"a hole around a pocket", kHoleOutside, "it holds what the outer ring leaves out", false,
       [](Random& random) {
         const double s = 1 + below(random, 2);
         return polygonOf(
             {{{0, 0}, {16, 0}, {16, 16}, {0, 16}, {0, 0}, {2 * s, 3 * s}, {3 * s, 2 * s}},
              {{0, 0}, {12, 5}, {10, 10}, {5, 12}}});
       }},
      {"a hole that crosses a far corner by an ulp", kHoleOutside, "little is enough", true,
       [](Random& random) {
         const double u = random.chance(0.5) ? 0x1p-52 : 0x1p-50;
         return polygonOf({box(1, 1, 0.5, 0.5), {{1.25, 1.25}, {1.5 + u, 1.375}, {1.25, 1.4375}}});
       }},
      {"a hole in a hole", kNestedHole, "winding number -1", false,
       [](Random& random) {
         return polygonOf({kSquare, box(2, 2, 12, 12), box(3 + below(random, 9), 4, 1, 9)});
       }},
      {"a hole in a hole, touching", kNestedHole, "winding number -1", false,
       [](Random& random) {
         const double x = 4 + below(random, 8);
         return polygonOf({kSquare, box(2, 2, 12, 12), {{x, 2}, {x + 1, 9}, {x - 1, 9}}});
       }},
      {"a hole in a hole, touching all around", kNestedHole, "winding number -1", false,
       [](Random& random) {
         const double x = 4 + below(random, 8), y = 4 + below(random, 8);
         return polygonOf({kSquare, box(2, 2, 12, 12), {{x, 2}, {14, y}, {x, 14}, {2, y}}});
       }},
      {"holes that cross", kHolesOverlap, "edges cross", false,
       [](Random& random) {
         return polygonOf({kSquare, box(2, 4, 8, 8), box(8, 1 + below(random, 8), 5, 5)});
       }},
      {"holes that cross at vertices alone", kHolesOverlap, "in and out through common points",
       false,
       [](Random& random) {
         const double x = 6 + below(random, 4);
         return polygonOf(
             {kSquare, {{x, 4}, {12, 8}, {x, 12}, {3, 8}}, {{x, 4}, {14, 8}, {x, 12}, {5, 8}}});
       }},
      {"duplicated holes", kHolesOverlap, "all edges in common", false,
       [](Random& random) {
         const Ring hole = box(2 + below(random, 5), 3, 4, 4);
         return polygonOf({kSquare, hole, hole});
       }},
      {"holes with an edge in common", kHolesOverlap, "a segment in common", false,
       [](Random& random) {
         const double x = 5 + below(random, 6);
         return polygonOf({kSquare, box(2, 3, x - 2, 6), box(x, 3, 15 - x, 6)});
       }},
      {"holes along a part of an edge", kHolesOverlap, "a segment in common", false,
       [](Random& random) {
         return polygonOf({kSquare, box(2, 3, 5, 6), box(7, 1 + below(random, 7), 6, 6)});
       }},
      {"a hole in a hole, along an edge", kHolesOverlap, "a segment in common comes before nesting",
       false,
       [](Random& random) {
         return polygonOf({kSquare, box(2, 2, 12, 12), box(3 + below(random, 8), 2, 2, 2)});
       }},
  };
  return families;
}

}  // namespace

const std::vector<Family>& polygonFamilies() {
  static const std::vector<Family> families = [] {
    std::vector<Family> all = validFamilies();
    all.insert(all.end(), faultyFamilies().begin(), faultyFamilies().end());
    return all;
  }();
  return families;
}

Polygon instanceOf(const Family& family, Random& random) {
  Polygon polygon = family.make(random);
  if (!family.exactlyAsMade) {
    // x' = a x + b y + e, y' = c x + d y + f of small integers: exact, and not singular.
    int a, b, c, d;
    do {
      a = int(random.below(15)) - 7, b = int(random.below(15)) - 7;
      c = int(random.below(15)) - 7, d = int(random.below(15)) - 7;
    } while (a * d == b * c);
    const double e = int(random.below(101)) - 50, f = int(random.below(101)) - 50;
    for (uint32_t v = 0; v < polygon.vertexCount(); ++v) {
      const Point p = polygon.point(v);
      polygon.positions[2 * v] = a * p.x + b * p.y + e;
      polygon.positions[2 * v + 1] = c * p.x + d * p.y + f;
    }
    polygon = scaledBy(polygon, std::ldexp(1.0, int(random.below(81)) - 40));
  }
  if (random.chance(0.5)) polygon = quarterTurned(polygon);
  if (random.chance(0.5)) polygon = mirrored(polygon);
  return rewritten(polygon, random);
}

}  // namespace sftest

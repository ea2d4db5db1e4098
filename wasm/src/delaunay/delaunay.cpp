#include "delaunay/delaunay.h"

#include <algorithm>

#include "base/predicates.h"
#include "base/sort.h"

namespace sf {

bool sortedFacets(const Tetrahedralization& cells, Work& work, std::vector<uint32_t>& facets,
                  ArrayView<const uint32_t> number) {
  struct Rest {  // of a facet, without its least vertex
    uint32_t b, c;
    bool operator<(const Rest& o) const { return b != o.b ? b < o.b : c < o.c; }
  };
  size_t n = cells.pointCount(), count = 0;
  facets.clear();
  size_t bytes = (n + 1) * sizeof(uint32_t);
  if (!work.charge(bytes)) {
    work.release(bytes);
    return false;
  }
  std::vector<uint32_t> start(n + 1, 0);
  auto forEachFacet = [&](auto f) {
    cells.forEachFacet([&](uint32_t a, uint32_t b, uint32_t c) {
      if (number.empty())
        f(a, b, c);
      else
        f(number[a], number[b], number[c]);
    });
  };
  forEachFacet([&](uint32_t a, uint32_t b, uint32_t c) {
    ++count;
    ++start[std::min({a, b, c}) + 1];
  });
  size_t more = count * (sizeof(Rest) + 3 * sizeof(uint32_t));
  bytes += more;
  if (!work.charge(more)) {
    work.release(bytes);
    return false;
  }
  for (size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  std::vector<Rest> rest(count);
  forEachFacet([&](uint32_t a, uint32_t b, uint32_t c) {
    uint32_t least = std::min({a, b, c}), most = std::max({a, b, c});
    rest[start[least]++] = {a ^ b ^ c ^ least ^ most, most};
  });
  facets.reserve(3 * count);
  for (uint32_t a = 0, from = 0; a < n && work.tick(30 * (start[a] - from) + 1); ++a) {
    // Filling moved each start to the next one.
    sf::sort(rest.begin() + from, rest.begin() + start[a]);
    for (; from < start[a]; ++from) facets.insert(facets.end(), {a, rest[from].b, rest[from].c});
  }
  work.release(bytes);
  return work.going();
}

Status delaunay(ArrayView<const Vec3> points, Work& work, Delaunay& result) {
  result = Delaunay();
  size_t n = points.size();
  size_t bytes = n * sizeof(Vec3);
  auto finish = [&] {
    work.release(bytes);
    return work.status();
  };
  if (!work.charge(bytes)) return finish();
  std::vector<Vec3> scaled;
  scaleToUnit(points, scaled);
  Tetrahedralization cells(work);
  if (!cells.add(scaled)) return finish();

  result.dimension = cells.dimension();
  if (!sortedFacets(cells, work, result.facets)) return finish();
  size_t count = 0;
  cells.forEachTetrahedron([&](uint32_t, uint32_t, uint32_t, uint32_t) { ++count; });
  size_t more = (4 * count + result.facets.size() + n) * sizeof(uint32_t);
  bytes += more;
  if (!work.charge(more)) return finish();
  result.tetrahedra.reserve(4 * count);
  cells.forEachTetrahedron([&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    result.tetrahedra.insert(result.tetrahedra.end(), {a, b, c, d});
  });
  result.duplicateOf.resize(n);
  for (uint32_t i = 0; i < n; ++i) result.duplicateOf[i] = cells.duplicateOf(i);
  return finish();
}

}  // namespace sf

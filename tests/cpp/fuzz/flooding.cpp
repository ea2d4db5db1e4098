// Fuzzes flooding, and repair, which triangulates by it: accepted polygons have to be certified by
// the complement, and repair has to make something of everything finite.
#include "fuzz/polygon_input.h"

using namespace sffuzz;

namespace {

/// Whether there are places for points between those given: along an axis that subnormal numbers
/// span, rounding can merge what repair adds with its neighbours.
bool hasRoom(const std::vector<double>& positions) {
  double largest[2] = {0, 0};
  for (size_t i = 0; i < positions.size(); ++i)
    largest[i % 2] = std::fmax(largest[i % 2], std::fabs(positions[i]));
  for (const double x : largest)
    if (x > 0 && x < 1e-290) return false;
  return true;
}

}  // namespace

extern "C" int32_t sf_host_progress(double, double, double) { return 1; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  sf::PolygonOptions options, repairing;
  options.method = sf::PolygonMethod::Flooding, options.verify = options.trace = true;
  options.delaunay = in.below(2), options.strips = in.below(4) == 0;
  repairing.repair = in.below(2) ? sf::Repair::EvenOdd : sf::Repair::NonZero;
  PolygonInput polygon = readPolygon(in);

  static sf::PolygonTriangulator triangulator;  // its memory goes from input to input
  triangulateChecked(triangulator, polygon, options);

  polygon.points.clear();
  sf::PolygonTriangulation repaired;
  sf::Work work(64u << 20, nullptr, nullptr);
  const sf::Outcome outcome = triangulator.triangulate(polygon.view(), repairing, work, repaired);
  require(outcome.ok() || outcome.status == sf::Status::BadStarts ||
              outcome.status == sf::Status::NotFinite || !hasRoom(polygon.positions),
          "repair makes something of everything finite");
  if (outcome.ok())
    checkTriangles(repaired.triangles, polygon.vertices() + repaired.added.size() / 2);
  return 0;
}

// Fuzzes trapezoids and u-trees, with strips: accepted polygons have to be certified by the
// complement; what is refused flooding has to refuse, in the same words, and nothing else.
#include "fuzz/polygon_input.h"

using namespace sffuzz;

extern "C" int32_t sf_host_progress(double, double, double) { return 1; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  sf::PolygonOptions options, flooding;
  options.method = sf::PolygonMethod::Trapezoids, options.verify = true;
  options.delaunay = in.below(4) == 0, options.strips = in.below(2);
  const PolygonInput polygon = readPolygon(in);

  static sf::PolygonTriangulator triangulator;  // its memory goes from input to input
  const sf::Outcome outcome = triangulateChecked(triangulator, polygon, options);
  require(equal(outcome, triangulateChecked(triangulator, polygon, flooding)),
          "methods agree on what is wrong");
  return 0;
}

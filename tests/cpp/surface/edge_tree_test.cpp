// Samples of edges: nested, near enough, and more of them where they are asked for.
#include "surface/edge_tree.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "support/surface_models.h"

using namespace sf;

namespace {

/// The edges of a solid cylinder of radius 1 and height 2: two circles, 0 to 4, and a seam.
struct Edges {
  Work work;
  Charge charge{work};
  Model model;
  std::vector<ModelFault> faults;
  Edges() {
    const ModelBuilder builder = solidCylinder(1, 2);
    const std::vector<uint32_t> shape = builder.shape();
    const std::vector<double> numbers = builder.numbers();
    REQUIRE(readModel({shape, numbers}, work, charge, model, faults));
    REQUIRE(faults.empty());
  }
  EdgeTree tree(uint32_t edge) const {
    std::vector<uint32_t> uses;
    for (uint32_t u = 0; u < model.uses.size(); ++u)
      if (model.uses[u].edge == edge) uses.push_back(u);
    return EdgeTree(model, edge, uses);
  }
};

std::vector<EdgeSample> select(EdgeTree& tree, double tolerance, double angle = 10,
                               double longest = Sampling::kNoLimit) {
  Sampling sampling;
  sampling.tolerance = tolerance, sampling.angle = angle;
  std::vector<EdgeSample> samples;
  tree.select(Fineness(sampling), longest, samples);
  return samples;
}

}  // namespace

TEST_CASE("EdgeTree: samples of a circle keep the tolerance, and are nested") {
  const Edges edges;
  EdgeTree tree = edges.tree(0);
  std::vector<EdgeSample> coarser;
  for (const double tolerance : {0.1, 0.02, 0.004, 0.0008}) {
    const std::vector<EdgeSample> samples = select(tree, tolerance);
    CHECK(samples.front().t == 0);
    CHECK(samples.back().t == 4);
    for (size_t i = 0; i + 1 < samples.size(); ++i) {
      REQUIRE(samples[i].t < samples[i + 1].t);
      CHECK(length(samples[i].at) == doctest::Approx(1));
      // The chord's middle is where it is off most.
      const Vec3 middle = 0.5 * (samples[i].at + samples[i + 1].at);
      CHECK(1 - length(middle) <= tolerance);
    }
    for (const EdgeSample& s : coarser)
      CHECK(std::any_of(samples.begin(), samples.end(), [&](const EdgeSample& other) {
        return other.t == s.t && other.at == s.at;
      }));
    CHECK(samples.size() > coarser.size());
    coarser = samples;
  }
  // And back.
  CHECK(select(tree, 0.1).size() < coarser.size());
}

TEST_CASE("EdgeTree: samples keep the angle and the length") {
  const Edges edges;
  EdgeTree around = edges.tree(0), seam = edges.tree(2);
  const std::vector<EdgeSample> turns = select(around, 10, 0.3);
  for (size_t i = 0; i + 1 < turns.size(); ++i)
    CHECK(angleBetween(turns[i].at, turns[i + 1].at) <= 0.31);
  CHECK(select(seam, 1e-6).size() == 2);
  const std::vector<EdgeSample> pieces = select(seam, 1e-6, 10, 0.3);
  CHECK(pieces.size() == 9);
}

TEST_CASE("EdgeTree: an interval halved by force stays so, and can be taken back") {
  const Edges edges;
  EdgeTree tree = edges.tree(0);
  const std::vector<EdgeSample> before = select(tree, 0.01);
  REQUIRE(tree.force(before[1].node));
  CHECK(tree.forced() == 1);
  for (const double tolerance : {0.01, 0.01, 0.1}) {
    const std::vector<EdgeSample> samples = select(tree, tolerance);
    if (tolerance == 0.01) CHECK(samples.size() == before.size() + 1);
  }
  const std::vector<EdgeSample> forced = select(tree, 0.01);
  CHECK(forced[2].t == doctest::Approx(0.5 * (before[1].t + before[2].t)));
  // Until an interval is too short to be told apart.
  std::vector<EdgeSample> samples = forced;
  int halvings = 0;
  while (halvings < 100 && tree.force(samples[0].node)) ++halvings, samples = select(tree, 0.01);
  CHECK(halvings < 60);
  CHECK(halvings > 10);
}

// Models of trimmed surfaces made by hand, as the core reads them.
#pragma once
#include <cmath>
#include <random>
#include <vector>

#include "surface/model.h"

namespace sf {

/// A spline in its own arrays: a curve of space or of a domain, or with `v` a surface.
struct TestSpline {
  uint32_t degree = 1;
  std::vector<double> knots, poles, weights;
  uint32_t degreeV = 0;
  std::vector<double> knotsV;

  uint32_t count() const { return uint32_t(knots.size()) - degree - 1; }
  uint32_t countV() const { return uint32_t(knotsV.size()) - degreeV - 1; }
};

inline TestSpline segment(Point2 a, Point2 b, double from = 0, double to = 1) {
  return {1, {from, from, to, to}, {a.x, a.y, b.x, b.y}, {}, 0, {}};
}

/// A circle of four quarters, from 0 to 4; counter-clockwise, or clockwise.
inline TestSpline circle(Point2 middle, double radius, bool isClockwise = false) {
  TestSpline c{2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {}, {}, 0, {}};
  const double at[9][2] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                           {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  for (int k = 0; k < 9; ++k) {
    c.poles.push_back(middle.x + radius * at[k][0]);
    c.poles.push_back(middle.y + (isClockwise ? -radius : radius) * at[k][1]);
    c.weights.push_back(k % 2 ? std::sqrt(0.5) : 1);
  }
  return c;
}

/// A curve of the plane, at a height in space.
inline TestSpline lifted(const TestSpline& flat, double z) {
  TestSpline c = flat;
  c.poles.clear();
  for (size_t i = 0; i < flat.poles.size(); i += 2)
    c.poles.insert(c.poles.end(), {flat.poles[i], flat.poles[i + 1], z});
  return c;
}

/// A model's arrays, face by face.
class ModelBuilder {
 public:
  struct Use {
    uint32_t edge;
    bool isReversed;
    TestSpline curve;  // or none: no knots
    bool isSeam = false;
  };

  /// @returns its number
  uint32_t addEdge(double from, double to, const TestSpline* curve = nullptr,
                   double tolerance = 1e-9, bool isDegenerate = false) {
    edgeShape_.push_back((isDegenerate ? 1u : 0u) | (curve ? 2u : 0u));
    edgeNumbers_.insert(edgeNumbers_.end(), {tolerance, from, to});
    if (curve) put(*curve, edgeShape_, edgeNumbers_);
    return edges_++;
  }
  void addFace(const TestSpline& s, const std::vector<std::vector<Use>>& loops,
               bool isReversed = false, uint32_t outer = 0) {
    faceShape_.insert(faceShape_.end(), {isReversed ? 1u : 0u, s.degree, s.count(),
                                         uint32_t(s.knots.size()), s.degreeV, s.countV(),
                                         uint32_t(s.knotsV.size()), s.weights.empty() ? 0u : 1u,
                                         loops.empty() ? 0 : outer + 1, uint32_t(loops.size())});
    for (const auto* list : {&s.knots, &s.knotsV, &s.poles, &s.weights})
      faceNumbers_.insert(faceNumbers_.end(), list->begin(), list->end());
    for (const auto& loop : loops) {
      faceShape_.push_back(uint32_t(loop.size()));
      for (const Use& use : loop) {
        faceShape_.insert(faceShape_.end(),
                          {use.edge, (use.isReversed ? 1u : 0u) | (use.isSeam ? 2u : 0u) |
                                         (use.curve.knots.empty() ? 0u : 4u)});
        const TestSpline& c = use.curve;
        if (c.knots.empty()) continue;
        faceShape_.insert(faceShape_.end(), {c.degree, c.count(), uint32_t(c.knots.size()),
                                             c.weights.empty() ? 0u : 1u});
        faceNumbers_.insert(faceNumbers_.end(), {c.knots[c.degree], c.knots[c.count()]});
        for (const auto* list : {&c.knots, &c.poles, &c.weights})
          faceNumbers_.insert(faceNumbers_.end(), list->begin(), list->end());
      }
    }
    ++faces_;
  }

  std::vector<uint32_t> shape() const {
    std::vector<uint32_t> all = {faces_, edges_};
    all.insert(all.end(), edgeShape_.begin(), edgeShape_.end());
    all.insert(all.end(), faceShape_.begin(), faceShape_.end());
    return all;
  }
  std::vector<double> numbers() const {
    std::vector<double> all = edgeNumbers_;
    all.insert(all.end(), faceNumbers_.begin(), faceNumbers_.end());
    return all;
  }

 private:
  static void put(const TestSpline& c, std::vector<uint32_t>& shape, std::vector<double>& numbers) {
    shape.insert(shape.end(),
                 {c.degree, c.count(), uint32_t(c.knots.size()), c.weights.empty() ? 0u : 1u});
    for (const auto* list : {&c.knots, &c.poles, &c.weights})
      numbers.insert(numbers.end(), list->begin(), list->end());
  }

  uint32_t faces_ = 0, edges_ = 0;
  std::vector<uint32_t> edgeShape_, faceShape_;
  std::vector<double> edgeNumbers_, faceNumbers_;
};

/// A flat square from (-size, -size) to (size, size) at a height; its parameters are x and y.
inline TestSpline square(double size, double z) {
  return {1,
          {-size, -size, size, size},
          {-size, -size, z, -size, size, z, size, -size, z, size, size, z},
          {},
          1,
          {-size, -size, size, size}};
}

/// The side of a cylinder around z: u from 0 to 4 around, v from 0 to `height`.
inline TestSpline cylinderSide(double radius, double height) {
  const TestSpline around = circle({0, 0}, radius);
  TestSpline s{2, around.knots, {}, {}, 1, {0, 0, height, height}};
  for (int k = 0; k < 9; ++k)
    for (const double z : {0.0, height}) {
      s.poles.insert(s.poles.end(), {around.poles[2 * k], around.poles[2 * k + 1], z});
      s.weights.push_back(around.weights[k]);
    }
  return s;
}

/// A solid cylinder: a side with a seam, and two discs.
inline ModelBuilder solidCylinder(double radius = 1, double height = 2) {
  ModelBuilder m;
  const TestSpline flat = circle({0, 0}, radius);
  const TestSpline low = lifted(flat, 0), high = lifted(flat, height);
  const TestSpline seam{1, {0, 0, height, height}, {radius, 0, 0, radius, 0, height}, {}, 0, {}};
  const uint32_t e0 = m.addEdge(0, 4, &low), e1 = m.addEdge(0, 4, &high),
                 e2 = m.addEdge(0, height, &seam);
  m.addFace(cylinderSide(radius, height),
            {{{e0, false, segment({0, 0}, {4, 0}, 0, 4)},
              {e2, false, segment({4, 0}, {4, height}, 0, height), true},
              {e1, true, segment({0, height}, {4, height}, 0, 4)},
              {e2, true, segment({0, 0}, {0, height}, 0, height), true}}});
  m.addFace(square(2 * radius, height), {{{e1, false, flat}}});
  m.addFace(square(2 * radius, 0), {{{e0, false, flat}}}, true);
  return m;
}

/// A sphere without loops: two poles and a seam. Its normals point outwards.
inline ModelBuilder sphere(double radius = 1) {
  const TestSpline around = circle({0, 0}, 1);
  TestSpline s{2, around.knots, {}, {}, 2, {0, 0, 0, 1, 1, 2, 2, 2}};
  const double h = std::sqrt(0.5),
               profile[5][3] = {{0, -1, 1}, {1, -1, h}, {1, 0, 1}, {1, 1, h}, {0, 1, 1}};
  for (int k = 0; k < 9; ++k)
    for (const auto& p : profile) {
      s.poles.insert(s.poles.end(), {radius * p[0] * around.poles[2 * k],
                                     radius * p[0] * around.poles[2 * k + 1], radius * p[1]});
      s.weights.push_back(around.weights[k] * p[2]);
    }
  ModelBuilder m;
  m.addFace(s, {});
  return m;
}

/// A wavy plate over [0, 1]² with round holes in some of the cells of a grid of 4 by 4.
inline ModelBuilder wavyPlate(std::mt19937& random, double height, uint32_t holes) {
  TestSpline s{3, {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1}, {}, {},
               3, {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1}};
  std::uniform_real_distribution<double> waves(-height, height), offsets(-0.03, 0.03),
      radii(0.02, 0.09);
  // Greville abscissae, so that x and y are u and v but for the waves.
  const double at[7] = {0, 1 / 12.0, 0.25, 0.5, 0.75, 11 / 12.0, 1};
  for (const double x : at)
    for (const double y : at) s.poles.insert(s.poles.end(), {x, y, waves(random)});
  ModelBuilder m;
  std::vector<std::vector<ModelBuilder::Use>> loops(1);
  const Point2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 4; ++k)
    loops[0].push_back({m.addEdge(0, 1), false, segment(corners[k], corners[(k + 1) % 4])});
  for (uint32_t k = 0; k < holes; ++k) {
    const uint32_t cell = (5 * k + 3) % 16;
    const Point2 middle{0.125 + 0.25 * (cell % 4) + offsets(random),
                        0.125 + 0.25 * (cell / 4) + offsets(random)};
    loops.push_back({{m.addEdge(0, 4), false, circle(middle, radii(random), random() % 2 == 0)}});
  }
  m.addFace(s, loops);
  return m;
}

}  // namespace sf

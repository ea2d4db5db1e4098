#include "support/generators.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>

namespace sftest {
namespace {

const double kPi = std::acos(-1.0);

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<uint32_t> faces;  // [3f] wound alike
};

Mesh icosphere(uint32_t levels) {
  double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  for (double s : {-1.0, 1.0})
    for (double t : {-g, g})
      for (Vec3 p : {Vec3{0, s, t}, Vec3{s, t, 0}, Vec3{t, 0, s}})
        mesh.positions.push_back(unit(p));
  // The faces are the triples of mutually nearest corners, wound outward.
  double edge = 2 / std::sqrt(1 + g * g) * 1.01;
  auto near = [&](uint32_t a, uint32_t b) {
    return distance(mesh.positions[a], mesh.positions[b]) < edge;
  };
  for (uint32_t a = 0; a < 12; ++a)
    for (uint32_t b = a + 1; b < 12; ++b)
      for (uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
        bool outward = dot(cross(q - p, r - p), p) > 0;
        for (uint32_t v : {a, outward ? b : c, outward ? c : b}) mesh.faces.push_back(v);
      }
  for (; levels > 0; --levels) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    auto middle = [&](uint32_t a, uint32_t b) {
      auto [it, isNew] =
          middles.insert({{std::min(a, b), std::max(a, b)}, uint32_t(mesh.positions.size())});
      if (isNew) mesh.positions.push_back(unit(mesh.positions[a] + mesh.positions[b]));
      return it->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < mesh.faces.size(); i += 3) {
      uint32_t a = mesh.faces[i], b = mesh.faces[i + 1], c = mesh.faces[i + 2];
      uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (uint32_t v : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) finer.push_back(v);
    }
    mesh.faces = finer;
  }
  return mesh;
}

/// A disc of faces that grows over its rim, and stays a disc.
class Disc {
 public:
  Disc(const Mesh& mesh, const std::set<uint32_t>& forbidden) : mesh_(mesh), taken_(forbidden) {
    for (uint32_t i = 0; i < mesh.faces.size(); ++i) {
      uint32_t j = i % 3 == 2 ? i - 2 : i + 1;
      faceOf_[{mesh.faces[i], mesh.faces[j]}] = i / 3;
    }
  }

  bool start(uint32_t face) {
    for (int i = 0; i < 3; ++i) {
      if (taken_.count(mesh_.faces[3 * face + i])) return false;
      rim_.push_back(mesh_.faces[3 * face + i]);
    }
    for (uint32_t v : rim_) taken_.insert(v);
    inside_.insert(face);
    return true;
  }

  /// Adds the face across rim edge i if the rim stays a simple loop.
  bool grow(uint32_t i) {
    size_t n = rim_.size();
    uint32_t a = rim_[i], b = rim_[(i + 1) % n];
    uint32_t face = faceOf_.at({b, a});
    uint32_t apex = 0;
    for (int j = 0; j < 3; ++j)
      if (uint32_t v = mesh_.faces[3 * face + j]; v != a && v != b) apex = v;
    if (inside_.count(face)) return false;
    if (!taken_.count(apex)) {
      rim_.insert(rim_.begin() + i + 1, apex);
      taken_.insert(apex);
    } else if (n > 3 && rim_[(i + 2) % n] == apex) {
      rim_.erase(rim_.begin() + (i + 1) % long(n));
    } else if (n > 3 && rim_[(i + n - 1) % n] == apex) {
      rim_.erase(rim_.begin() + i);
    } else {
      return false;
    }
    inside_.insert(face);
    return true;
  }

  const std::vector<uint32_t>& rim() const { return rim_; }
  const std::set<uint32_t>& taken() const { return taken_; }

 private:
  const Mesh& mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> faceOf_;
  std::set<uint32_t> taken_, inside_;
  std::vector<uint32_t> rim_;
};

}  // namespace

Random::Random(uint32_t seed) : state_(seed * 2654435769u + 0x6D2B79F5u) {
  if (state_ == 0) state_ = 1;
  for (int i = 0; i < 8; ++i) bits();
}

uint32_t Random::bits() {
  state_ ^= state_ << 13;
  state_ ^= state_ >> 17;
  state_ ^= state_ << 5;
  return state_;
}

Vec3 Random::direction() {
  for (;;) {
    Vec3 p = inCube(1);
    double r = length(p);
    if (r > 0.1 && r <= 1) return (1 / r) * p;
  }
}

sf::LoopSet loopSet(const Curves& curves) {
  std::vector<Vec3> positions;
  std::vector<uint32_t> starts{0};
  for (const Curve& curve : curves) {
    positions.insert(positions.end(), curve.begin(), curve.end());
    starts.push_back(uint32_t(positions.size()));
  }
  return sf::LoopSet(positions, starts);
}

Rotation rotationAbout(Vec3 a, double angle) {
  double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {{d * a.x * a.x + c, d * a.x * a.y - s * a.z, d * a.x * a.z + s * a.y},
          {d * a.x * a.y + s * a.z, d * a.y * a.y + c, d * a.y * a.z - s * a.x},
          {d * a.x * a.z - s * a.y, d * a.y * a.z + s * a.x, d * a.z * a.z + c}};
}

Rotation randomRotation(Random& random) {
  Vec3 axis = random.direction();
  return rotationAbout(axis, random.range(0, 2 * kPi));
}

Curve circle(uint32_t n, double radius, Vec3 centre, Vec3 axis) {
  Vec3 side = std::fabs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 u = unit(side - dot(side, axis) * axis), v = cross(axis, u);
  Curve curve;
  for (uint32_t i = 0; i < n; ++i) {
    double t = 2 * kPi * i / n;
    curve.push_back(centre + radius * (std::cos(t) * u + std::sin(t) * v));
  }
  return curve;
}

Curve monkeySaddle(uint32_t n) {
  Curve curve;
  for (uint32_t i = 0; i < n; ++i) {
    double t = 2 * kPi * i / n;
    curve.push_back({std::cos(t), std::sin(t), std::cos(3 * t) / 2});
  }
  return curve;
}

Curves regularSaddles(uint32_t k, uint32_t n, Random& random) {
  const Vec3 corners[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  Curves curves;
  for (uint32_t c = 0; c < k; ++c) {
    Vec3 axis = corners[c], u = corners[(c + 1) % 3], v = cross(axis, u);
    Vec3 tilt = random.direction();
    Rotation turn = rotationAbout(tilt, random.range(-0.2, 0.2));
    Vec3 centre = axis + random.inCube(0.05);
    Curve curve;
    for (uint32_t i = 0; i < n; ++i) {
      double t = 2 * kPi * (i + 0.5) / n;
      Vec3 p = 0.5 * (std::cos(t) * u + std::sin(t) * v) + 0.15 * std::cos(2 * t) * axis;
      curve.push_back(centre + turn(p));
    }
    curves.push_back(curve);
  }
  return curves;
}

Curves randomLoops(const std::vector<uint32_t>& sizes, double apart, Random& random) {
  Curves curves;
  for (uint32_t size : sizes) {
    Vec3 centre = apart * random.direction();
    Curve curve;
    for (uint32_t i = 0; i < size; ++i) curve.push_back(centre + random.inCube(0.5));
    curves.push_back(curve);
  }
  return curves;
}

Curve noisyCircle(uint32_t n, double noise, Random& random) {
  Curve curve = circle(n);
  for (Vec3& p : curve) p = p + random.inCube(noise);
  return curve;
}

Curves meshLoops(uint32_t levels, uint32_t count, uint32_t faces, Random& random) {
  return meshRims(levels, std::vector<uint32_t>(count, faces), random);
}

Curves meshRims(uint32_t levels, const std::vector<uint32_t>& faces, Random& random) {
  Mesh mesh = icosphere(levels);
  Curves curves;
  std::set<uint32_t> taken;
  uint32_t faceCount = uint32_t(mesh.faces.size() / 3);
  for (uint32_t attempt = 0; curves.size() < faces.size() && attempt < 50 * faces.size();
       ++attempt) {
    const uint32_t wanted = faces[curves.size()];
    Disc disc(mesh, taken);
    if (!disc.start(random.below(faceCount))) continue;
    uint32_t grown = 1;
    for (uint32_t tries = 0; grown < wanted && tries < 20 * wanted; ++tries)
      grown += disc.grow(random.below(uint32_t(disc.rim().size())));
    if (grown < wanted) continue;
    Curve curve;
    for (uint32_t v : disc.rim()) curve.push_back(mesh.positions[v]);
    curves.push_back(curve);
    taken = disc.taken();
  }
  return curves;
}

Curves readCurves(const std::string& path) {
  std::ifstream file(path);
  uint32_t loops = 0, vertices = 0;
  Curves curves;
  if (!(file >> loops >> vertices)) return {};
  for (uint32_t c = 0; c < loops; ++c) {
    uint32_t size = 0;
    file >> size;
    Curve curve(std::min(size, vertices));
    for (Vec3& p : curve) file >> p.x >> p.y >> p.z;
    curves.push_back(curve);
  }
  if (!file) return {};
  return curves;
}

std::string describe(const Curves& curves) {
  std::string text = "[";
  for (const Curve& curve : curves) {
    text += text.size() > 1 ? ", [" : "[";
    for (const Vec3& p : curve) {
      char point[100];
      std::snprintf(point, sizeof point, "%s[%.17g, %.17g, %.17g]", &p == &curve[0] ? "" : ", ",
                    p.x, p.y, p.z);
      text += point;
    }
    text += "]";
  }
  return text + "]";
}

}  // namespace sftest

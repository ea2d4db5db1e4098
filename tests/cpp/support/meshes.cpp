#include "support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "triangles/triangle_mesh.h"

namespace sftest {
namespace {

const double kPi = std::acos(-1.0);

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

/// Points by their coordinates, so that patches which meet have them in common.
class Welder {
 public:
  explicit Welder(TestMesh& mesh) : mesh_(mesh) {}
  uint32_t operator()(Vec3 p) {
    const auto [it, isNew] = known_.insert({{p.x, p.y, p.z}, mesh_.vertexCount()});
    if (isNew) mesh_.addVertex(p);
    return it->second;
  }

 private:
  TestMesh& mesh_;
  std::map<std::array<double, 3>, uint32_t> known_;
};

}  // namespace

uint32_t TestMesh::addVertex(Vec3 p) {
  positions.insert(positions.end(), {p.x, p.y, p.z});
  return vertexCount() - 1;
}

Vec3 TestMesh::middle(uint32_t f) const {
  return (1.0 / 3) * (at(faces[3 * f]) + at(faces[3 * f + 1]) + at(faces[3 * f + 2]));
}

TestMesh sphereMesh(uint32_t levels) {
  TestMesh mesh;
  const double g = (1 + std::sqrt(5.0)) / 2;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-g, g})
      for (const Vec3 p : {Vec3{0, s, t}, Vec3{s, t, 0}, Vec3{t, 0, s}}) mesh.addVertex(unit(p));
  const double edge = 2 / std::sqrt(1 + g * g) * 1.01;
  const auto isEdge = [&](uint32_t a, uint32_t b) {
    return distance(mesh.at(a), mesh.at(b)) < edge;
  };
  for (uint32_t a = 0; a < 12; ++a)
    for (uint32_t b = a + 1; b < 12; ++b)
      for (uint32_t c = b + 1; c < 12; ++c) {
        if (!isEdge(a, b) || !isEdge(b, c) || !isEdge(c, a)) continue;
        const bool isOutward =
            dot(cross(mesh.at(b) - mesh.at(a), mesh.at(c) - mesh.at(a)), mesh.at(a)) > 0;
        mesh.addFace(a, isOutward ? b : c, isOutward ? c : b);
      }
  for (uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, isNew] = middles.insert({std::minmax(a, b), mesh.vertexCount()});
      if (isNew) mesh.addVertex(unit(mesh.at(a) + mesh.at(b)));
      return it->second;
    };
    const std::vector<uint32_t> old = std::move(mesh.faces);
    mesh.faces.clear();
    for (size_t i = 0; i < old.size(); i += 3) {
      const uint32_t a = old[i], b = old[i + 1], c = old[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      mesh.addFace(a, ab, ca), mesh.addFace(b, bc, ab), mesh.addFace(c, ca, bc);
      mesh.addFace(ab, bc, ca);
    }
  }
  return mesh;
}

TestMesh torusMesh(uint32_t around, uint32_t along, double tube) {
  TestMesh mesh;
  for (uint32_t i = 0; i < along; ++i)
    for (uint32_t j = 0; j < around; ++j) {
      const double u = 2 * kPi * i / along, v = 2 * kPi * j / around;
      const double r = 1 + tube * std::cos(v);
      mesh.addVertex({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  const auto at = [&](uint32_t i, uint32_t j) { return i % along * around + j % around; };
  for (uint32_t i = 0; i < along; ++i)
    for (uint32_t j = 0; j < around; ++j) {
      mesh.addFace(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.addFace(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

TestMesh boxMesh(uint32_t n) {
  TestMesh mesh;
  Welder weld(mesh);
  const auto side = [&](Vec3 normal, Vec3 u, Vec3 v) {
    const auto at = [&](uint32_t i, uint32_t j) {
      return weld(normal + (2.0 * i - n) / n * u + (2.0 * j - n) / n * v);
    };
    for (uint32_t i = 0; i < n; ++i)
      for (uint32_t j = 0; j < n; ++j) {
        const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        mesh.addFace(a, b, c), mesh.addFace(a, c, d);
      }
  };
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const double s : {1.0, -1.0}) {
    side(s * x, s * y, z), side(s * y, s * z, x), side(s * z, s * x, y);
  }
  return mesh;
}

TestMesh tubeMesh(uint32_t around, uint32_t rows, double height) {
  TestMesh mesh;
  for (uint32_t i = 0; i <= rows; ++i)
    for (uint32_t j = 0; j < around; ++j) {
      const double u = 2 * kPi * j / around;
      mesh.addVertex({std::cos(u), std::sin(u), height * (double(i) / rows - 0.5)});
    }
  for (uint32_t i = 0; i < rows; ++i)
    for (uint32_t j = 0; j < around; ++j) {
      const uint32_t a = i * around + j, b = i * around + (j + 1) % around;
      mesh.addFace(a, b, b + around), mesh.addFace(a, b + around, a + around);
    }
  return mesh;
}

TestMesh saddleMesh(uint32_t n, double bend) {
  TestMesh mesh;
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j <= n; ++j) {
      const double x = 2.0 * j / n - 1, y = 2.0 * i / n - 1;
      mesh.addVertex({x, y, bend * x * y});
    }
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + 1, d = a + n + 1, c = d + 1;
      mesh.addFace(a, b, c), mesh.addFace(a, c, d);
    }
  return mesh;
}

TestMesh moebiusMesh(uint32_t m) {
  TestMesh mesh;
  for (uint32_t i = 0; i < m; ++i)
    for (const double w : {-0.3, 0.3}) {
      const double u = 2 * kPi * i / m, r = 1 + w * std::cos(u / 2);
      mesh.addVertex({r * std::cos(u), r * std::sin(u), w * std::sin(u / 2)});
    }
  for (uint32_t i = 0; i < m; ++i) {
    const uint32_t a = 2 * i, b = a + 1, c = i + 1 < m ? a + 2 : 1, d = i + 1 < m ? a + 3 : 0;
    mesh.addFace(a, c, d), mesh.addFace(a, d, b);
  }
  return mesh;
}

TestMesh kleinMesh(uint32_t m, uint32_t n) {
  TestMesh mesh;
  for (uint32_t i = 0; i < m; ++i)
    for (uint32_t j = 0; j < n; ++j) {  // the figure-eight immersion
      const double u = 2 * kPi * i / m, v = 2 * kPi * j / n;
      const double r = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      mesh.addVertex({(2 + r) * std::cos(u), (2 + r) * std::sin(u),
                      std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)});
    }
  const auto at = [&](uint32_t i, uint32_t j) {
    return i < m ? i * n + j % n : (n - j % n) % n;  // v turns into -v
  };
  for (uint32_t i = 0; i < m; ++i)
    for (uint32_t j = 0; j < n; ++j) {
      mesh.addFace(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.addFace(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

TestMesh without(const TestMesh& mesh, const PlaceTest& isGone) {
  TestMesh result{mesh.positions, {}};
  for (uint32_t f = 0; f < mesh.faceCount(); ++f)
    if (!isGone(mesh.middle(f)))
      result.addFace(mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]);
  return result;
}

PlaceTest isNear(Vec3 centre, double radius) {
  return [=](Vec3 p) { return distance(p, centre) < radius; };
}
PlaceTest isBetween(Vec3 centre, double inner, double radius) {
  return [=](Vec3 p) { return distance(p, centre) > inner && distance(p, centre) < radius; };
}

TestMesh compact(const TestMesh& mesh) {
  TestMesh result;
  std::vector<uint32_t> numbers(mesh.vertexCount(), sf::kNone);
  for (const uint32_t v : mesh.faces) {
    if (numbers[v] == sf::kNone) numbers[v] = result.addVertex(mesh.at(v));
    result.faces.push_back(numbers[v]);
  }
  return result;
}

TestMesh soup(const TestMesh& mesh) {
  TestMesh result;
  for (const uint32_t v : mesh.faces) result.faces.push_back(result.addVertex(mesh.at(v)));
  return result;
}

TestMesh together(const TestMesh& a, const TestMesh& b) {
  TestMesh result = a;
  result.positions.insert(result.positions.end(), b.positions.begin(), b.positions.end());
  for (const uint32_t v : b.faces) result.faces.push_back(v + a.vertexCount());
  return result;
}

TestMesh turnedOver(const TestMesh& mesh) {
  TestMesh result = mesh;
  for (size_t i = 0; i < mesh.faces.size(); i += 3)
    std::swap(result.faces[i + 1], result.faces[i + 2]);
  return result;
}

TestMesh noisy(const TestMesh& mesh, double noise, Random& random) {
  TestMesh result = mesh;
  for (double& x : result.positions) x += random.range(-noise, noise);
  return result;
}

TestMesh mapped(const TestMesh& mesh, const std::function<Vec3(Vec3)>& map) {
  TestMesh result{{}, mesh.faces};
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) result.addVertex(map(mesh.at(v)));
  return result;
}

TestMesh shuffled(const TestMesh& mesh, Random& random, std::vector<uint32_t>& from) {
  const auto shuffle = [&](std::vector<uint32_t>& list) {
    for (uint32_t i = uint32_t(list.size()); i > 1; --i)
      std::swap(list[i - 1], list[random.below(i)]);
  };
  from.resize(mesh.vertexCount());
  for (uint32_t v = 0; v < from.size(); ++v) from[v] = v;
  shuffle(from);
  TestMesh result;
  std::vector<uint32_t> to(from.size()), order(mesh.faceCount());
  for (uint32_t v = 0; v < from.size(); ++v) to[from[v]] = v, result.addVertex(mesh.at(from[v]));
  for (uint32_t f = 0; f < order.size(); ++f) order[f] = f;
  shuffle(order);
  for (const uint32_t f : order) {
    const uint32_t first = random.below(3);
    for (uint32_t i = 0; i < 3; ++i)
      result.faces.push_back(to[mesh.faces[3 * f + (first + i) % 3]]);
  }
  return result;
}

std::vector<std::pair<uint32_t, uint32_t>> openEdges(const TestMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> count;
  for (uint32_t h = 0; h < mesh.faces.size(); ++h)
    ++count[std::minmax(mesh.faces[h], mesh.faces[sf::nextInTriangle(h)])];
  std::vector<std::pair<uint32_t, uint32_t>> result;
  for (uint32_t h = 0; h < mesh.faces.size(); ++h) {
    const uint32_t a = mesh.faces[h], b = mesh.faces[sf::nextInTriangle(h)];
    if (count[std::minmax(a, b)] == 1) result.push_back({a, b});
  }
  return result;
}

}  // namespace sftest

#include "base/predicates.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "support/exact.h"

using sf::Vec3;
using Big = exact::Int<22>;  // five factors of 252 bits and some
using BigPoint = exact::Point<22>;

namespace {

constexpr int kShift = 252;  // makes an integer of every coordinate in the predicates' range
BigPoint big(const Vec3& p) { return exact::point<22>(p, kShift); }
BigPoint flat(const Vec3& p) { return {big(p).x, big(p).y, Big(0)}; }

int exactOrient2d(const Vec3& a, const Vec3& b, const Vec3& c) {
  return exact::cross(flat(b) - flat(a), flat(c) - flat(a)).z.sign();
}
int exactTurn2d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return exact::cross(flat(b) - flat(a), flat(d) - flat(c)).z.sign();
}
int exactOrient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return exact::volume6(big(a), big(b), big(c), big(d)).sign();
}
int exactInsphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  return exact::inSphere(big(a), big(b), big(c), big(d), big(e)).sign();
}
int exactIncircle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // The sphere through a, b, c and a point above a cuts the plane in the circle through a, b, c.
  Vec3 up = {a.x, a.y, 0.5};
  return exact::inSphere(flat(a), flat(b), flat(c), big(up), flat(d)).sign();
}

// Makers of five points each, degenerate or close to it in a way of their own.
struct Maker {
  const char* name;
  std::vector<Vec3> (*make)(std::mt19937_64&);
};
double uniform(std::mt19937_64& g) { return std::uniform_real_distribution<double>(-1, 1)(g); }
Vec3 anyPoint(std::mt19937_64& g) { return {uniform(g), uniform(g), uniform(g)}; }
double nudge(std::mt19937_64& g, double x) {
  for (int k = int(g() % 5); k > 0; --k) x = std::nextafter(x, g() % 2 ? 1.0 : -1.0);
  return x;
}
double small(std::mt19937_64& g, int range) {
  return double(int(g() % uint64_t(2 * range + 1)) - range);
}

const Maker kMakers[] = {
    {"random",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) v = anyPoint(g);
       return p;
     }},
    {"small lattice",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) v = 0.125 * Vec3{small(g, 3), small(g, 3), small(g, 3)};
       return p;
     }},
    {"lattice of tenths",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) v = 0.1 * Vec3{small(g, 3), small(g, 3), small(g, 3)};
       return p;
     }},
    {"lattice of 2^-40, far off",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       Vec3 centre = 0x1p-20 * Vec3{small(g, 1000000), small(g, 1000000), small(g, 1000000)};
       for (Vec3& v : p) v = centre + 0x1p-40 * Vec3{small(g, 40), small(g, 40), small(g, 40)};
       return p;
     }},
    {"almost on a sphere",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) {
         v = anyPoint(g);
         v = (0.7 / length(v)) * v;
         v = {nudge(g, v.x), nudge(g, v.y), nudge(g, v.z)};
       }
       return p;
     }},
    {"exactly on a sphere",
     [](std::mt19937_64& g) {
       // All signed orders of (1, 4, 8), (4, 4, 7) and (0, 0, 9).
       const double kTriples[3][3] = {{1, 4, 8}, {4, 4, 7}, {0, 0, 9}};
       Vec3 centre = {0.03 * small(g, 9), 0.5, 0.25};
       std::vector<Vec3> p(5);
       for (Vec3& v : p) {
         double c[3];
         std::copy_n(kTriples[g() % 3], 3, c);
         std::shuffle(c, c + 3, g);
         for (double& x : c) x *= g() % 2 ? 1.0 : -1.0;
         v = centre + 0x1p-45 * Vec3{c[0], c[1], c[2]};
       }
       return p;
     }},
    {"almost in a plane",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) {
         v = anyPoint(g);
         v.z = nudge(g, (v.x + v.y) / 3);
       }
       return p;
     }},
    {"almost on a line",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       Vec3 a = anyPoint(g), b = anyPoint(g);
       for (Vec3& v : p) {
         double t = (uniform(g) + 1) / 2;
         v = a + t * (b - a);
         v = {nudge(g, v.x), nudge(g, v.y), nudge(g, v.z)};
       }
       return p;
     }},
    {"all magnitudes",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       auto any = [&] {
         return std::ldexp(uniform(g) / 2 + (g() % 2 ? 0.5 : -0.5), -int(g() % 199));
       };
       for (Vec3& v : p) v = {any(), any(), any()};
       if (g() % 2) p[1] = p[0], p[1].x = nudge(g, p[1].x);
       return p;
     }},
    {"tiny",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) v = 0x1p-199 * Vec3{small(g, 4), small(g, 4), small(g, 4)};
       for (Vec3& v : p) v = {nudge(g, v.x + 0x1p-190), v.y, v.z};
       for (Vec3& v : p)
         if (v.x != 0 && std::fabs(v.x) < 0x1p-200) v.x = 0;
       return p;
     }},
    {"almost on a sphere, on a wide lattice",
     [](std::mt19937_64& g) {
       const double kTriples[3][3] = {{1, 4, 8}, {4, 4, 7}, {0, 0, 9}};
       double size = double(g() % 500000);  // with products that need rounding
       std::vector<Vec3> p(5);
       for (Vec3& v : p) {
         double c[3];
         std::copy_n(kTriples[g() % 3], 3, c);
         std::shuffle(c, c + 3, g);
         for (double& x : c) x = x * size * (g() % 2 ? 1.0 : -1.0) + (g() % 8 ? 0 : small(g, 1));
         v = 0x1p-25 * Vec3{c[0], c[1], c[2]};
       }
       return p;
     }},
    {"differences that underflow when multiplied",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       // About 2^-214 each, so that five of them leave a few bits above the least double.
       for (Vec3& v : p)
         v = 0x1p-199 * (Vec3{1, 1, 1} + std::ldexp(1, -int(13 + g() % 4)) * anyPoint(g));
       return p;
     }},
    {"repeated points",
     [](std::mt19937_64& g) {
       std::vector<Vec3> p(5);
       for (Vec3& v : p) v = anyPoint(g);
       for (Vec3& v : p)
         if (g() % 2) v = p[g() % 5];
       return p;
     }},
};

}  // namespace

TEST_CASE("predicates: every sign agrees with exact integer arithmetic") {
  for (const Maker& maker : kMakers) {
    INFO(std::string(maker.name));
    std::mt19937_64 g(20240717);
    int wrong = 0, zeros = 0;
    for (int round = 0; round < 500; ++round) {
      std::vector<Vec3> p = maker.make(g);
      const Vec3 &a = p[0], &b = p[1], &c = p[2], &d = p[3], &e = p[4];
      int sphere = exactInsphere(a, b, c, d, e);
      zeros += sphere == 0;
      wrong += sf::orient2d(a.x, a.y, b.x, b.y, c.x, c.y) != exactOrient2d(a, b, c);
      wrong += sf::turn2d(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) != exactTurn2d(a, b, c, d);
      wrong += sf::orient3d(a, b, c, d) != exactOrient3d(a, b, c, d);
      wrong += sf::insphere(a, b, c, d, e) != sphere;
      int circle = sf::incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y);
      wrong += circle != exactIncircle(a, b, c, d);
      BigPoint n = exact::cross(big(b) - big(a), big(c) - big(a));
      wrong += sf::collinear(a, b, c) != (exact::dot(n, n).sign() == 0);
    }
    MESSAGE(std::string(maker.name), ": ", zeros, " of 500 co-spherical");
    CHECK(wrong == 0);
  }
}

TEST_CASE("predicates: conventions of sign") {
  Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(sf::orient2d(0, 0, 1, 0, 0, 1) == 1);
  CHECK(sf::orient3d(o, x, y, z) == 1);
  CHECK(sf::insphere(o, x, y, z, {0.25, 0.25, 0.25}) == 1);
  CHECK(sf::insphere(o, x, y, z, {1, 1, 1.125}) == -1);
  CHECK(sf::insphere(o, x, y, z, {1, 1, 1}) == 0);
  CHECK(sf::insphere(x, o, y, z, {0.25, 0.25, 0.25}) == -1);
  CHECK(sf::incircle(0, 0, 1, 0, 0, 1, 0.5, 0.5) == 1);
  CHECK(sf::incircle(0, 0, 1, 0, 0, 1, 1, 1) == 0);
  CHECK(sf::incircle(0, 0, 0, 1, 1, 0, 0.5, 0.5) == -1);
}

TEST_CASE("predicates: circles through lattice points of more and more bits") {
  std::mt19937_64 g(5);
  // Radii with many lattice points on their circles, and such of the next ones.
  for (const int64_t radius : {65, 1105, 5525, 32045, 160225}) {
    std::vector<std::pair<int64_t, int64_t>> on;
    for (int64_t x = -radius; x <= radius; ++x) {
      const int64_t y = std::llround(std::sqrt(double(radius * radius - x * x)));
      if (x * x + y * y != radius * radius) continue;
      on.push_back({x, y});
      if (y != 0) on.push_back({x, -y});
    }
    REQUIRE(on.size() >= 36);
    int wrong = 0, zeros = 0;
    for (int round = 0; round < 4000; ++round) {
      Vec3 p[4];
      for (Vec3& v : p) {
        const auto [x, y] = on[g() % on.size()];
        v = {double(x), double(y), 0};
      }
      if (round % 2) p[g() % 4].x += g() % 2 ? 1 : -1;
      // Away from the origin, and by halves.
      for (Vec3& v : p) v = {(v.x + 3e5) / 0x1p20, (v.y - 1e5) / 0x1p20, 0};
      const int exact = exactIncircle(p[0], p[1], p[2], p[3]);
      zeros += exact == 0;
      wrong +=
          sf::incircle(p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y, p[3].x, p[3].y) != exact;
    }
    INFO("radius ", radius);
    CHECK(zeros >= 2000);
    CHECK(zeros < 3000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("predicates: signs change with the arguments' order as determinants do") {
  for (const Maker& maker : kMakers) {
    INFO(std::string(maker.name));
    std::mt19937_64 g(7);
    int wrong = 0;
    for (int round = 0; round < 300; ++round) {
      std::vector<Vec3> p = maker.make(g);
      int i = int(g() % 5), j = int(g() % 4);
      j += j >= i;
      int s = sf::insphere(p[0], p[1], p[2], p[3], p[4]);
      int o = sf::orient3d(p[0], p[1], p[2], p[3]);
      std::swap(p[size_t(i)], p[size_t(j)]);
      wrong += sf::insphere(p[0], p[1], p[2], p[3], p[4]) != -s;
      if (i < 4 && j < 4) wrong += sf::orient3d(p[0], p[1], p[2], p[3]) != -o;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("predicates: ties of insphere are broken as lifting would") {
  // On an integer lattice a lift that is small enough is as good as an infinitely small one.
  std::mt19937_64 g(11);
  int ties = 0, wrong = 0;
  for (int round = 0; round < 10000; ++round) {
    Vec3 p[5];
    for (Vec3& v : p) v = {double(g() % 3), double(g() % 3), double(g() % 3)};
    if (sf::orient3d(p[0], p[1], p[2], p[3]) < 0) std::swap(p[0], p[1]);
    bool distinct = true;
    for (int i = 0; i < 4; ++i) distinct &= !(p[i] == p[4]);
    if (!distinct || sf::orient3d(p[0], p[1], p[2], p[3]) == 0) continue;
    uint32_t rank[5] = {0, 1, 2, 3, 4};
    std::shuffle(rank, rank + 5, g);
    Big lift[5];
    BigPoint q[5];
    for (int i = 0; i < 5; ++i) {
      q[i] = exact::point<22>(p[i], 250);
      lift[i] = Big::fromDouble(1, 100 * int(rank[i]));
    }
    Big det = exact::inSphere(q[0], q[1], q[2], q[3], q[4], lift);
    const Vec3* const at[5] = {&p[0], &p[1], &p[2], &p[3], &p[4]};
    ties += sf::insphere(p[0], p[1], p[2], p[3], p[4]) == 0;
    wrong += sf::insphereByRank(at, rank) != det.sign();
  }
  CHECK(ties > 400);
  CHECK(wrong == 0);
}

TEST_CASE("predicates: ties of incircle are broken as lifting would") {
  std::mt19937_64 g(13);
  int ties = 0, wrong = 0;
  for (int round = 0; round < 10000; ++round) {
    double x[4], y[4];
    for (int i = 0; i < 4; ++i) x[i] = double(g() % 3), y[i] = double(g() % 3);
    if (sf::orient2d(x[0], y[0], x[1], y[1], x[2], y[2]) < 0)
      std::swap(x[0], x[1]), std::swap(y[0], y[1]);
    bool distinct = true;
    for (int i = 0; i < 3; ++i) distinct &= x[i] != x[3] || y[i] != y[3];
    if (!distinct || sf::orient2d(x[0], y[0], x[1], y[1], x[2], y[2]) == 0) continue;
    uint32_t rank[4] = {0, 1, 2, 3};
    std::shuffle(rank, rank + 4, g);
    double lift[4], qx[4], qy[4];
    for (int i = 0; i < 4; ++i) {
      qx[i] = x[i] - x[3], qy[i] = y[i] - y[3];
      lift[i] = (qx[i] * qx[i] + qy[i] * qy[i]) * 0x1p40 + std::ldexp(1, 8 * int(rank[i]));
    }
    auto turn = [&](int i, int j) { return qx[i] * qy[j] - qx[j] * qy[i]; };
    double det = (lift[0] - lift[3]) * turn(1, 2) + (lift[1] - lift[3]) * turn(2, 0) +
                 (lift[2] - lift[3]) * turn(0, 1);
    ties += sf::incircle(x[0], y[0], x[1], y[1], x[2], y[2], x[3], y[3]) == 0;
    wrong += sf::incircleByRank(x, y, rank) != (det > 0 ? 1 : det < 0 ? -1 : 0);
  }
  CHECK(ties > 400);
  CHECK(wrong == 0);
}

TEST_CASE("scaleToUnit: a power of two brings the largest magnitude to 1/2 or more, and below 1") {
  std::vector<Vec3> points = {{3, -1000, 0}, {-0.0, 1e-300, 7}, {1e-55, 0, 1}}, scaled;
  int e = sf::scaleToUnit(points, scaled);
  CHECK(e == 10);
  CHECK(scaled[0] == Vec3{std::ldexp(3, -10), std::ldexp(-1000, -10), 0});
  CHECK(scaled[1].y == 0);
  CHECK(!std::signbit(scaled[1].x));
  CHECK(scaled[2].x == std::ldexp(1e-55, -10));
  CHECK(std::ldexp(scaled[1].z, e) == 7);

  for (double size : {1.7976931348623157e308, 1e-300, 5e-324, 0.5, 1.0}) {
    points = {{size, 0, 0}, {-size / 2, size / 4, 0}};
    e = sf::scaleToUnit(points, scaled);
    CHECK(scaled[0].x >= 0.5);
    CHECK(scaled[0].x < 1);
    CHECK(std::ldexp(scaled[0].x, e) == size);
  }
  points = {{0, -0.0, 0}};
  CHECK(sf::scaleToUnit(points, scaled) == 0);
  CHECK(scaled[0] == Vec3{0, 0, 0});
}

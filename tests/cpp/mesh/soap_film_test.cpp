#include "mesh/soap_film.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/patches.h"

using namespace sftest;
using sf::Film;
using sf::FilmOptions;
using sf::LocalSurface;
using sf::Status;
using sf::Vec3;
using sf::Work;

namespace {

const double kPi = std::acos(-1.0);

/// The loops themselves, spanned, without surroundings.
LocalSurface span(const std::vector<std::vector<Vec3>>& loops) {
  Sheet sheet;
  std::vector<std::vector<uint32_t>> numbers;
  for (const std::vector<Vec3>& loop : loops) {
    numbers.emplace_back();
    for (const Vec3& p : loop) {
      numbers.back().push_back(uint32_t(sheet.positions.size() / 3));
      sheet.positions.insert(sheet.positions.end(), {p.x, p.y, p.z});
    }
  }
  return fillLoops(sheet, numbers, 0).surface;
}

std::vector<Vec3> ring(uint32_t n, double height) {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i < n; ++i)
    points.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), height});
  return points;
}

Film film(LocalSurface& surface, uint32_t maxNewVertices = 2500) {
  Film result;
  Work work;
  FilmOptions options;
  options.refining.maxNewVertices = maxNewVertices;
  CHECK(sf::relaxToFilm(surface, options, work, result) == Status::Ok);
  CHECK(work.used() == 0);
  for (const double x : surface.positions) CHECK(std::isfinite(x));
  return result;
}

double worst(const LocalSurface& surface, const std::function<double(Vec3)>& distance) {
  double most = 0;
  for (size_t v = surface.fixedVertices; v < surface.positions.size() / 3; ++v)
    most = std::fmax(most, distance({surface.positions[3 * v], surface.positions[3 * v + 1],
                                     surface.positions[3 * v + 2]}));
  return most;
}

}  // namespace

TEST_CASE("soap film: a catenoid between two rings") {
  // r = c cosh(z / c), with r = 1 at z = +-h.
  const double h = 0.4;
  double c = 0.9;
  for (int i = 0; i < 50; ++i)
    c -= (c * std::cosh(h / c) - 1) / (std::cosh(h / c) - h / c * std::sinh(h / c));
  LocalSurface surface = span({ring(256, -h), ring(256, h)});
  const Film result = film(surface);
  CHECK(result.isMinimal);
  CHECK(result.collapsed.empty());
  CHECK(surface.triangles.size() / 3 < 5600);
  CHECK(worst(surface, [=](Vec3 p) {
          return std::fabs(std::hypot(p.x, p.y) - c * std::cosh(p.z / c));
        }) < 1e-3);
  const double area = kPi * c * c * (std::sinh(2 * h / c) + 2 * h / c);
  CHECK(std::fabs(result.area / area - 1) < 2e-3);
}

TEST_CASE("soap film: a plane in a flat loop, Enneper's surface on its own") {
  LocalSurface flat = span({ring(60, 0.3)});
  const Film disk = film(flat);
  CHECK(disk.isMinimal);
  CHECK(worst(flat, [](Vec3 p) { return std::fabs(p.z - 0.3); }) < 1e-12);
  // Enneper's surface at radius 0.8 of its parameter.
  std::vector<Vec3> loop;
  const auto enneper = [](double u, double v) {
    return Vec3{u - u * u * u / 3 + u * v * v, -v + v * v * v / 3 - v * u * u, u * u - v * v};
  };
  for (int i = 0; i < 200; ++i)
    loop.push_back(enneper(0.8 * std::cos(2 * kPi * i / 200), 0.8 * std::sin(2 * kPi * i / 200)));
  LocalSurface saddle = span({loop});
  const Film result = film(saddle);
  CHECK(result.isMinimal);
  // The nearest point of the surface by Newton's method in its parameters.
  CHECK(worst(saddle, [&](Vec3 p) {
          double u = p.x, v = -p.y;
          for (int i = 0; i < 30; ++i) {
            const Vec3 d = enneper(u, v) - p, du{1 - u * u + v * v, -2 * u * v, 2 * u},
                       dv{2 * u * v, -1 + v * v - u * u, -2 * v};
            const double l = dot(du, du);
            u -= dot(d, du) / l, v -= dot(d, dv) / l;
          }
          return length(enneper(u, v) - p);
        }) < 1e-3);
}

TEST_CASE("soap film: a neck too long for a film is told") {
  LocalSurface surface = span({ring(60, -0.8), ring(60, 0.8)});
  const Film result = film(surface, 1500);
  CHECK_FALSE(result.collapsed.empty());
  for (const uint32_t v : result.collapsed) CHECK(v >= surface.fixedVertices);
}

// Costs against the best ones known: tests/fixtures/optima.csv.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

#include "support/cases.h"
#include "support/self_intersection.h"
#include "support/surface.h"

using namespace sftest;

namespace {

struct Row {
  std::string curves, space, objective;
  double area, perimeter, dihedral, best, native;
  bool proved;
};

std::vector<Row> readRows() {
  std::ifstream file(std::string(SF_FIXTURES) + "/optima.csv");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("curves,", 0) == 0) continue;
    std::vector<std::string> cell;
    std::stringstream stream(line);
    for (std::string text; std::getline(stream, text, ',');) cell.push_back(text);
    REQUIRE(cell.size() == 9);
    rows.push_back({cell[0], cell[1], cell[5], std::stod(cell[2]), std::stod(cell[3]),
                    std::stod(cell[4]), std::stod(cell[6]), std::stod(cell[8]), cell[7] == "yes"});
  }
  return rows;
}

Problem problemOf(const Row& row) {
  Problem problem;
  problem.curves = readCurves(std::string(SF_FIXTURES) + "/curves/" + row.curves + ".curve");
  problem.options.space = row.space == "all" ? sf::Space::All : sf::Space::Delaunay;
  problem.options.areaWeight = row.area;
  problem.options.perimeterWeight = row.perimeter;
  problem.options.dihedralWeight = row.dihedral;
  if (row.objective == "worst-dihedral") {
    problem.options.objective = sf::Objective::WorstDihedral;
    problem.options.dihedralWeight = 1;  // for ties
  }
  return problem;
}

}  // namespace

TEST_CASE("span: reaches every proved optimum and is never above a known cost") {
  std::vector<Row> rows = readRows();
  CHECK(rows.size() > 60);
  for (const Row& row : rows) {
    // Twenty seconds under sanitizers; tests/unit solves it in WebAssembly.
    if (row.curves == "saddle6_10") continue;
    Problem problem = problemOf(row);
    INFO(row.curves, ", ", row.space, ", area ", row.area, ", dihedral ", row.dihedral, ", ",
         row.objective, ", known ", row.best);
    REQUIRE_FALSE(problem.curves.empty());
    auto began = std::chrono::steady_clock::now();
    Answer answer = solve(problem);
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
    if (seconds.count() > 2)
      MESSAGE(row.curves << ", " << row.space << ": " << seconds.count() << " s");
    const sf::Span& span = answer.span;
    CHECK(answer.outcome.status == sf::Status::Ok);
    CHECK(span.found);
    if (!span.found) continue;
    CHECK(spanFault(loopSet(problem.curves), problem.view(), span) == "");
    CHECK(span.optimal);
    // The known costs were printed to nine or ten digits, or computed from single precision.
    if (row.proved)
      CHECK(std::fabs(span.cost - row.best) <= 1e-8 * row.best);
    else
      CHECK(span.cost <= row.best * (1 + 1e-9));
    CHECK(std::fabs(span.cost - row.native) <= 1e-12 * std::fmax(1, row.native));
    if (row.space == "delaunay" && span.triangles.size() < 3 * 250)
      CHECK_FALSE(findCrossing(span.positions, span.triangles).found);
  }
}

TEST_CASE("span: is better than the reference program where that is not optimal for three loops") {
  Row row{"rnd_5-5-5_0", "delaunay", "sum", 1, 0, 0, 4.051554636, 0, true};
  Answer answer = solve(problemOf(row));
  REQUIRE(answer.span.found);
  CHECK(answer.span.cost < 4.060855873682346 * (1 - 1e-3));
}

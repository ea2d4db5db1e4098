// Times sf::spanLoops on the cases of cases.csv: median and spread of repeated runs, the solver's
// peak memory, and a checksum that changes when an answer does.
//   soapfilm_bench [word]   only the cases whose line holds the word
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "loops/span.h"
#include "support/generators.h"

namespace {

constexpr int kLeastRuns = 5, kMostRuns = 50;
constexpr double kSecondsPerCase = 2;

struct Case {
  std::string title;
  sf::LoopSet loops;
  sf::SpanOptions options;
};

bool readCase(const std::string& line, Case& result) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (cells.size() != 6 || cells[0] == "curves") return false;
  result.loops = sftest::loopSet(sftest::readCurves(SF_FIXTURES "/curves/" + cells[0] + ".curve"));
  result.options.space = cells[1] == "all" ? sf::Space::All : sf::Space::Delaunay;
  result.options.areaWeight = std::stod(cells[2]);
  result.options.perimeterWeight = std::stod(cells[3]);
  result.options.dihedralWeight = std::stod(cells[4]);
  result.options.objective = cells[5] == "sum" ? sf::Objective::Sum : sf::Objective::WorstDihedral;
  result.title = line;
  return true;
}

/// FNV-1a of the triangles and of the cost to nine digits.
uint32_t checksum(const sf::Span& span) {
  uint32_t hash = 2166136261u;
  auto add = [&hash](uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ ((value >> shift) & 255)) * 16777619u;
  };
  for (uint32_t v : span.triangles) add(v);
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.9g", span.cost);
  for (const char* c = digits; *c; ++c) add(uint32_t(*c));
  return hash;
}

/// Runs a case until its times are steady enough; false if the solver fails.
bool measure(const Case& c) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  sf::Span span;
  size_t peak = 0;
  double spent = 0;
  while (int(times.size()) < kLeastRuns ||
         (spent < kSecondsPerCase && int(times.size()) < kMostRuns)) {
    sf::Work work(size_t(3) << 30, nullptr, nullptr);
    span = {};
    const Clock::time_point start = Clock::now();
    if (!sf::spanLoops(c.loops, c.options, work, span).ok()) return false;
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    spent += times.back();
    peak = work.peak();
  }
  std::sort(times.begin(), times.end());
  const double median = times[times.size() / 2];
  const double spread = (times[times.size() * 3 / 4] - times[times.size() / 4]) / median;
  std::printf("%-42s %10.2f ms  ±%3.0f %%  %8.1f MB  cost %-12.9g %08x\n", c.title.c_str(),
              1e3 * median, 100 * spread, double(peak) / 1e6, span.cost, checksum(span));
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int count, char** words) {
  std::ifstream file(SF_BENCH "/cases.csv");
  bool allRan = true, anyRan = false;
  for (std::string line; std::getline(file, line);) {
    Case c;
    if (line.empty() || line[0] == '#' || !readCase(line, c)) continue;
    if (count > 1 && line.find(words[1]) == std::string::npos) continue;
    anyRan = true;
    if (measure(c)) continue;
    std::printf("%s FAILED\n", line.c_str());
    allRan = false;
  }
  return allRan && anyRan ? 0 : 1;
}

// Times sf::spanLoops on one curve file and prints what it found as one line of JSON. A process a
// case, so that peak memory is the case's own; span.bench.mjs does the same through the package.
// Times are the processor's: one thread works and never waits, so that on a quiet machine they are
// what a clock shows, and on a busy one they still are.
//   soapfilm_bench file space objective area perimeter dihedral
// The weights are numbers; `nan` for the area weight is the default one.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "loops/span.h"
#include "support/generators.h"

namespace {

// The same in span.bench.mjs.
constexpr double kSecondsPerCase = 0.6, kDear = 2, kVeryDear = 5, kMostSeconds = 30;
constexpr size_t kLeastRuns = 3, kMostRuns = 500;

struct Measured {
  std::vector<double> seconds;  // of each run, the first one first
  sf::Span span;
  size_t peak = 0;         // bytes that the solver held at once
  size_t processPeak = 0;  // bytes by which the process grew
  sf::Status status = sf::Status::Ok;
};

/// Largest resident size so far, in bytes.
size_t residentPeak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return size_t(usage.ru_maxrss);
#else
  return size_t(usage.ru_maxrss) * 1024;
#endif
}

/// Seconds that this process has worked.
double secondsWorked() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Progress of a run that began at *start: on while it is not too long.
bool isWithinTime(void* start, double, double, double) {
  return secondsWorked() - *static_cast<double*>(start) < kMostSeconds;
}

/// Runs until the median is worth something; dear cases fewer times, very dear ones once.
bool isEnough(const std::vector<double>& seconds) {
  const double first = seconds.front();
  const size_t warm = seconds.size() - 1;
  if (first > kVeryDear) return true;
  if (first > kDear) return warm >= 1;
  double spent = 0;
  for (const double s : seconds) spent += s;
  return warm >= kMostRuns || (warm >= kLeastRuns && spent - first >= kSecondsPerCase);
}

Measured measure(const sf::LoopSet& loops, const sf::SpanOptions& options) {
  Measured result;
  const size_t before = residentPeak();
  do {
    double start = secondsWorked();
    sf::Work work(size_t(3) << 30, isWithinTime, &start);
    result.span = {};
    result.status = sf::spanLoops(loops, options, work, result.span).status;
    result.seconds.push_back(secondsWorked() - start);
    result.peak = work.peak();
  } while (result.status == sf::Status::Ok && !isEnough(result.seconds));
  result.processPeak = residentPeak() - before;
  return result;
}

/// FNV-1a of the triangles.
uint32_t checksum(const std::vector<uint32_t>& triangles) {
  uint32_t hash = 2166136261u;
  for (const uint32_t v : triangles)
    for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ ((v >> shift) & 255)) * 16777619u;
  return hash;
}

void print(const Measured& m) {
  const sf::Span& span = m.span;
  std::printf("{\"seconds\":[");
  for (size_t i = 0; i < m.seconds.size(); ++i)
    std::printf("%s%.9g", i > 0 ? "," : "", m.seconds[i]);
  std::printf("],\"peakBytes\":%zu,\"processBytes\":%zu,\"found\":%s,\"optimal\":%s", m.peak,
              m.processPeak, span.found ? "true" : "false", span.optimal ? "true" : "false");
  std::printf(",\"cost\":%.17g,\"lowerBound\":%.17g", span.cost, span.lowerBound);
  std::printf(",\"candidates\":%llu,\"domains\":%llu,\"minimalSets\":%llu",
              (unsigned long long)span.candidates, (unsigned long long)span.domains,
              (unsigned long long)span.minimalSets);
  std::printf(",\"space\":\"%s\",\"hash\":\"%08x\"}\n",
              std::vector<const char*>{"auto", "all", "delaunay", "near", "given"}[int(span.space)],
              checksum(span.triangles));
}

bool readOptions(char** words, sf::SpanOptions& options) {
  const std::string space = words[0];
  if (space == "auto")
    options.space = sf::Space::Auto;
  else if (space == "all")
    options.space = sf::Space::All;
  else if (space == "delaunay")
    options.space = sf::Space::Delaunay;
  else if (space == "near")
    options.space = sf::Space::Near;
  else
    return false;
  const bool worst = std::strcmp(words[1], "worst-dihedral") == 0;
  options.objective = worst ? sf::Objective::WorstDihedral : sf::Objective::Sum;
  options.areaWeight = std::strtod(words[2], nullptr);
  options.perimeterWeight = std::strtod(words[3], nullptr);
  options.dihedralWeight = std::strtod(words[4], nullptr);
  return true;
}

}  // namespace

int main(int count, char** words) {
  sf::SpanOptions options;
  if (count != 7 || !readOptions(words + 2, options)) {
    std::fprintf(stderr, "soapfilm_bench file space objective area perimeter dihedral\n");
    return 2;
  }
  const sftest::Curves curves = sftest::readCurves(words[1]);
  if (curves.empty()) {
    std::fprintf(stderr, "%s cannot be read\n", words[1]);
    return 2;
  }
  const Measured measured = measure(sftest::loopSet(curves), options);
  if (measured.status == sf::Status::Stopped) {
    std::printf("{\"problem\":\"> %g s\"}\n", kMostSeconds);
  } else if (measured.status != sf::Status::Ok) {
    std::printf("{\"problem\":\"status %d\"}\n", int(measured.status));
  } else {
    print(measured);
  }
  return 0;
}

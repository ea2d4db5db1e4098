#include "loops/spaces/neck_search.h"

#include <algorithm>

#include "base/sort.h"
#include "loops/problem/weight.h"

namespace sf {
namespace {

/// How many triangles of each loop are tried, and how many necks are kept.
constexpr size_t kOpenings = 500, kNecks = 20;

/// A triangle left out of a disc.
struct Opening {
  double cost;   // of the disc without it
  double least;  // that, and at each of its edges the cheapest triangle to the other loop
  uint32_t vertex[3];
};

/// Two openings and the ring of triangles between them.
struct Neck {
  double cost;
  uint32_t a[3], b[3];  // corners of the openings, in the order in which the ring passes them
  uint32_t steps;       // six binary digits: 0 a triangle with two corners of a, 1 with two of b
};
bool operator<(const Neck& x, const Neck& y) { return x.cost < y.cost; }

/// The orders of three steps along either opening. Three steps along one of them are never
/// consecutive, counted all around: the two edges of the ring beside them would be the same.
struct Rings {
  uint32_t count = 0, steps[20];
  Rings() {
    for (uint32_t s = 0; s < 64; ++s) {
      bool isGood = true;
      uint32_t ones = 0;
      for (uint32_t i = 0; i < 6; ++i) {
        const uint32_t turned = (s >> i | s << (6 - i)) & 63;
        isGood = isGood && (turned & 7) != 0 && (turned & 7) != 7;
        ones += s >> i & 1;
      }
      if (isGood && ones == 3) steps[count++] = s;
    }
  }
};

class NeckSearch {
 public:
  NeckSearch(const LoopSet& loops, const TripleWeights& weights, Work& work)
      : loops_(loops), weights_(weights), work_(work), discs_{{loops, weights}, {loops, weights}} {}

  bool run(std::vector<uint32_t>& triples);

 private:
  bool findOpenings(uint32_t loop);
  double leastAcross(uint32_t u, uint32_t v) const;
  void join(const Opening& a, const Opening& b, bool reversed);
  void keep(const Neck& neck);
  void append(const Neck& neck, std::vector<uint32_t>& triples) const;

  const LoopSet& loops_;
  const TripleWeights& weights_;
  Work& work_;
  PlainPolygon discs_[2];
  std::vector<Opening> openings_[2];
  std::vector<Neck> necks_;  // a heap, the dearest first
  const Rings rings_;
};

/// The least cost of triangles over edge uv with the third vertex on the other loop.
double NeckSearch::leastAcross(uint32_t u, uint32_t v) const {
  const uint32_t other = 1 - loops_.loopOf(u), first = loops_.first(other);
  double least = kInfinity;
  for (uint32_t w = first; w < first + loops_.size(other); ++w)
    least = std::min(least, weights_(u, v, w));
  return least;
}

/// The openings of a loop that promise most, the best first.
bool NeckSearch::findOpenings(uint32_t loop) {
  const uint32_t m = loops_.size(loop), first = loops_.first(loop);
  if (!work_.tick(m * m * (m + loops_.size(1 - loop)))) return false;
  std::vector<uint32_t> vertices(m);
  for (uint32_t i = 0; i < m; ++i) vertices[i] = first + i;
  PlainPolygon& disc = discs_[loop];
  disc.compute(std::move(vertices));
  std::vector<double> across(size_t(m) * m);
  for (uint32_t i = 0; i < m; ++i)
    for (uint32_t j = i + 1; j < m; ++j)
      across[size_t(i) * m + j] = leastAcross(first + i, first + j);
  std::vector<Opening>& all = openings_[loop];
  for (uint32_t i = 0; i < m; ++i)
    for (uint32_t j = i + 1; j < m; ++j)
      for (uint32_t k = j + 1; k < m; ++k) {
        const double cost = disc.cost(i, j) + disc.cost(j, k) + disc.cost(k, i);
        const double least = cost + across[size_t(i) * m + j] + across[size_t(j) * m + k] +
                             across[size_t(i) * m + k];
        if (least < kInfinity) all.push_back({cost, least, {first + i, first + j, first + k}});
      }
  const auto end = all.begin() + std::ptrdiff_t(std::min(kOpenings, all.size()));
  std::partial_sort(all.begin(), end, all.end(),
                    [](const Opening& a, const Opening& b) { return a.least < b.least; });
  all.erase(end, all.end());
  return true;
}

void NeckSearch::keep(const Neck& neck) {
  if (necks_.size() == kNecks) {
    if (!(neck < necks_.front())) return;
    std::pop_heap(necks_.begin(), necks_.end());
    necks_.pop_back();
  }
  necks_.push_back(neck);
  std::push_heap(necks_.begin(), necks_.end());
}

/// The best ring between two openings, the second passed in its order or in reverse.
void NeckSearch::join(const Opening& a, const Opening& b, bool reversed) {
  Neck best{kInfinity, {a.vertex[0], a.vertex[1], a.vertex[2]}, {}, 0};
  for (uint32_t turn = 0; turn < 3; ++turn) {
    uint32_t at[3];
    for (uint32_t i = 0; i < 3; ++i) at[i] = b.vertex[(reversed ? turn + 3 - i : turn + i) % 3];
    // Costs of the triangles that step on from corner i of a and corner j of b.
    double onA[3][3], onB[3][3];
    for (uint32_t i = 0; i < 3; ++i)
      for (uint32_t j = 0; j < 3; ++j) {
        onA[i][j] = weights_(a.vertex[i], a.vertex[(i + 1) % 3], at[j]);
        onB[i][j] = weights_(at[j], at[(j + 1) % 3], a.vertex[i]);
      }
    for (uint32_t r = 0; r < rings_.count; ++r) {
      double cost = a.cost + b.cost;
      uint32_t i = 0, j = 0;
      for (uint32_t s = 0; s < 6; ++s)
        if (rings_.steps[r] >> s & 1)
          cost += onB[i % 3][j], ++j;
        else
          cost += onA[i][j % 3], ++i;
      if (!(cost < best.cost)) continue;
      best.cost = cost, best.steps = rings_.steps[r];
      std::copy(at, at + 3, best.b);
    }
  }
  if (best.cost < kInfinity) keep(best);
}

void NeckSearch::append(const Neck& neck, std::vector<uint32_t>& triples) const {
  uint32_t i = 0, j = 0;
  for (uint32_t s = 0; s < 6; ++s)
    if (neck.steps >> s & 1) {
      triples.insert(triples.end(), {neck.b[j], neck.b[(j + 1) % 3], neck.a[i % 3]});
      ++j;
    } else {
      triples.insert(triples.end(), {neck.a[i], neck.a[(i + 1) % 3], neck.b[j % 3]});
      ++i;
    }
  // Adds what is left of the discs.
  for (uint32_t loop = 0; loop < 2; ++loop) {
    uint32_t at[3];
    for (int c = 0; c < 3; ++c) at[c] = (loop == 0 ? neck.a : neck.b)[c] - loops_.first(loop);
    sf::sort(at, at + 3);
    for (int c = 0; c < 3; ++c) discs_[loop].trace(at[c], at[(c + 1) % 3], triples);
  }
}

bool NeckSearch::run(std::vector<uint32_t>& triples) {
  if (!findOpenings(0) || !findOpenings(1)) return false;
  for (const Opening& a : openings_[0]) {
    if (!work_.tick(uint32_t(200 * openings_[1].size()))) return false;
    for (const Opening& b : openings_[1]) {
      if (necks_.size() == kNecks && a.least + b.least >= necks_.front().cost) break;
      join(a, b, false);
      join(a, b, true);
    }
  }
  for (const Neck& neck : necks_) append(neck, triples);
  return true;
}

}  // namespace

bool neckTriples(const LoopSet& loops, const TripleWeights& weights, Work& work,
                 std::vector<uint32_t>& triples) {
  return NeckSearch(loops, weights, work).run(triples);
}

double bytesForNecks(double n) {
  // The table of weights, the triples of at most one loop, and a polygon over both,
  // walked from a bridge.
  const double m = n + 2;
  return n * n * n * (sizeof(double) + sizeof(Opening) / 6.0) + m * m * 24;
}

}  // namespace sf

// Exact sums and products of doubles: floating-point expansions.
//
// An expansion is a sum of doubles that do not overlap, by increasing magnitude, none of them zero.
// Source: Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", sec. 2: Two-Sum, Two-Product, Fast-Expansion-Sum, Scale-Expansion, Compress.
// Differs: one bounded container for all sizes, kept short by Compress after every operation.
//
// Include this only in code that is compiled without fused or reordered operations.
#pragma once
#include <cmath>

#include "base/assert.h"

namespace sf {

/// An unevaluated sum hi + lo, |lo| at most half a unit in the last place of hi.
struct Pair {
  double hi, lo;
};

inline Pair fastTwoSum(double a, double b) {  // needs |a| >= |b|
  double s = a + b;
  return {s, b - (s - a)};
}
inline Pair twoSum(double a, double b) {
  double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
inline Pair twoDiff(double a, double b) {
  double s = a - b, t = a - s;
  return {s, (a - (s + t)) + (t - b)};
}
inline Pair splitInHalf(double a) {
  double c = 134217729.0 * a;  // 2^27 + 1
  double hi = c - (c - a);
  return {hi, a - hi};
}
inline Pair twoProduct(double a, double b) {
  double p = a * b;
  Pair x = splitInHalf(a), y = splitInHalf(b);
  return {p, x.lo * y.lo - (((p - x.hi * y.hi) - x.lo * y.hi) - x.hi * y.lo)};
}

class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(Pair p) {
    if (p.lo != 0) push(p.lo);
    if (p.hi != 0) push(p.hi);
  }
  Expansion(const Expansion& other) { *this = other; }
  Expansion& operator=(const Expansion& other) {
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) c_[i] = other.c_[i];  // the rest is not set
    return *this;
  }

  int sign() const { return size_ == 0 ? 0 : c_[size_ - 1] > 0 ? 1 : -1; }
  /// The sum as a double, off by less than a unit in its last place.
  double value() const {
    double sum = 0;
    for (int i = 0; i < size_; ++i) sum += c_[i];
    return sum;
  }

  friend Expansion operator+(const Expansion& a, const Expansion& b) {
    Expansion r;
    r.setSum(a, b);
    return r;
  }
  friend Expansion operator-(const Expansion& a) {
    Expansion r = a;
    for (int i = 0; i < r.size_; ++i) r.c_[i] = -r.c_[i];
    return r;
  }
  friend Expansion operator-(const Expansion& a, const Expansion& b) { return a + -b; }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    if (a.size_ < b.size_) return b * a;
    Expansion r[2], term;
    int last = 0;
    for (int j = 0; j < b.size_; ++j) {
      if (j == 0) {
        r[0].setScaled(a, b.c_[0]);
        r[0].shorten();
      } else {
        term.setScaled(a, b.c_[j]);
        r[1 - last].setSum(r[last], term);
        last = 1 - last;
      }
    }
    return r[last];
  }

 private:
  // Non-adjacent components lie 53 bits apart after Compress. The predicates' largest values span
  // less than 1300 bits, hence at most 26 components, 52 when scaled and 78 when added to 26 more.
  static constexpr int kCapacity = 112;
  static constexpr int kShortenAbove = 10;

  void push(double x) {
    SF_ASSERT(size_ < kCapacity);
    c_[size_++] = x;
  }
  void setSum(const Expansion& a, const Expansion& b) {
    size_ = 0;
    int i = 0, j = 0, count = a.size_ + b.size_;
    if (count == 0) return;
    auto next = [&] {
      bool takeA = j == b.size_ || (i < a.size_ && std::fabs(a.c_[i]) < std::fabs(b.c_[j]));
      return takeA ? a.c_[i++] : b.c_[j++];
    };
    double q = next();
    for (int k = 1; k < count; ++k) {
      Pair s = twoSum(q, next());
      if (s.lo != 0) push(s.lo);
      q = s.hi;
    }
    if (q != 0) push(q);
    shorten();
  }
  void setScaled(const Expansion& a, double b) {
    size_ = 0;
    double q = 0;
    for (int i = 0; i < a.size_; ++i) {
      Pair p = twoProduct(a.c_[i], b);
      Pair s = twoSum(q, p.lo);
      if (s.lo != 0) push(s.lo);
      s = fastTwoSum(p.hi, s.hi);
      if (s.lo != 0) push(s.lo);
      q = s.hi;
    }
    if (q != 0) push(q);
  }
  void shorten() {
    if (size_ <= kShortenAbove) return;
    double q = c_[size_ - 1];
    int bottom = size_;
    for (int i = size_ - 2; i >= 0; --i) {
      Pair s = fastTwoSum(q, c_[i]);
      if (s.lo != 0) {
        c_[--bottom] = s.hi;
        q = s.lo;
      } else {
        q = s.hi;
      }
    }
    int top = 0;
    for (int i = bottom; i < size_; ++i) {
      Pair s = fastTwoSum(c_[i], q);
      if (s.lo != 0) c_[top++] = s.lo;
      q = s.hi;
    }
    if (q != 0) c_[top++] = q;
    size_ = top;
  }

  int size_ = 0;
  double c_[kCapacity];
};

}  // namespace sf

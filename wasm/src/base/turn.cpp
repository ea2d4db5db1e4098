#include "base/turn.h"

#include <cstdint>
#include <initializer_list>

#include "base/predicates.h"

namespace sf {
namespace {

/// A sum of products of two doubles, exactly: an integer times 2^-2148 in signed digits to the base
/// 2^32, which hold some thousand products before a carry is due.
class ProductSum {
 public:
  void add(double a, double b, int sign) {
    if (a == 0 || b == 0) return;
    int ea, eb;
    const int64_t ma = mantissa(a, ea), mb = mantissa(b, eb);
    if ((a < 0) != (b < 0)) sign = -sign;
    // Halves of 27 and 26 bits; their products have at most 54 bits.
    const int64_t aLow = ma & kHalf, aHigh = ma >> 27, bLow = mb & kHalf, bHigh = mb >> 27;
    const int at = ea + eb + kLeast;
    addAt(at, aLow * bLow, sign);
    addAt(at + 27, aLow * bHigh, sign);
    addAt(at + 27, aHigh * bLow, sign);
    addAt(at + 54, aHigh * bHigh, sign);
  }
  int sign() {
    int64_t carry = 0;
    bool zero = true;
    for (int64_t& digit : digits_) {
      const int64_t sum = digit + carry;
      carry = sum >> 32;
      zero &= sum == carry * (int64_t(1) << 32);
    }
    return carry < 0 ? -1 : carry > 0 || !zero ? 1 : 0;
  }

 private:
  static constexpr int kLeast = 2148;
  static constexpr int64_t kHalf = (int64_t(1) << 27) - 1;

  /// |x| = mantissa 2^exponent.
  static int64_t mantissa(double x, int& exponent) {
    const double m = std::frexp(std::fabs(x), &exponent);
    exponent -= 53;
    if (exponent < -1074) {  // a number with fewer bits
      const int64_t wide = int64_t(std::ldexp(m, 53)) >> (-1074 - exponent);
      exponent = -1074;
      return wide;
    }
    return int64_t(std::ldexp(m, 53));
  }
  void addAt(int bit, int64_t value, int sign) {
    const int digit = bit / 32, shift = bit % 32;
    const uint64_t low = uint64_t(value) << shift;
    const uint64_t high = shift == 0 ? 0 : uint64_t(value) >> (64 - shift);
    digits_[digit] += sign * int64_t(low & 0xFFFFFFFFu);
    digits_[digit + 1] += sign * int64_t(low >> 32);
    digits_[digit + 2] += sign * int64_t(high);
  }

  int64_t digits_[136] = {};
};

bool inRangeOfPredicates(std::initializer_list<double> numbers) {
  double largest = 0, least = 1;
  for (const double x : numbers) {
    const double m = std::fabs(x);
    if (m > largest) largest = m;
    if (m < least && m > 0) least = m;
  }
  return largest < 0x1p300 && least > 0x1p-400;
}

}  // namespace

int turnBetween(Point2 a, Point2 b, Point2 c, Point2 d) {
  if (inRangeOfPredicates({a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y}))
    return turn2d(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y);
  ProductSum sum;
  sum.add(b.x, d.y, 1), sum.add(b.y, d.x, -1);
  sum.add(b.y, c.x, 1), sum.add(b.x, c.y, -1);
  sum.add(a.y, d.x, 1), sum.add(a.x, d.y, -1);
  sum.add(a.x, c.y, 1), sum.add(a.y, c.x, -1);
  return sum.sign();
}

double turnExactly(Point2 a, Point2 b, Point2 c) {
  if (inRangeOfPredicates({a.x, a.y, b.x, b.y, c.x, c.y}))
    return orient2d(a.x, a.y, b.x, b.y, c.x, c.y);
  ProductSum sum;
  sum.add(a.x, b.y, 1), sum.add(a.y, b.x, -1);
  sum.add(b.x, c.y, 1), sum.add(b.y, c.x, -1);
  sum.add(c.x, a.y, 1), sum.add(c.y, a.x, -1);
  return sum.sign();
}

}  // namespace sf

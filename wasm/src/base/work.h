// The budget of one call: memory in use against its limit, and progress that may end the work.
//
// The core does not throw, and reads no clock of its own. The caller passes a progress function, which
// reports, looks at the time and at cancellation, and decides whether to go on.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/status.h"

namespace sf {

/// Called about every millisecond of work. Returns true to go on, false to stop.
///   fraction    0 to 1, share of the work done; never falls during one call
///   bestCost    cost of the best surface so far, +infinity while there is none
///   lowerBound  proven lower bound on the optimum; 0 at first, less if there are negative weights
using ProgressFunction = bool (*)(void* user, double fraction, double bestCost, double lowerBound);

/// Seconds since some moment.
using Clock = double (*)();

class Work {
 public:
  Work() = default;
  Work(size_t maxBytes, ProgressFunction progress, void* user)
      : maxBytes_(maxBytes), progress_(progress), user_(user) {}

  /// Charges `bytes`; false, with status OutOfMemory, once more than the limit is in use.
  bool charge(uint64_t bytes) {
    used_ += bytes;
    if (used_ > peak_) peak_ = used_;
    if (used_ > maxBytes_) fail(Status::OutOfMemory);
    return status_ == Status::Ok;
  }
  void release(uint64_t bytes) { used_ -= bytes; }
  /// Whether `bytes` more would still fit: for sizes predicted before the work begins.
  bool fits(double bytes) const { return bytes <= double(maxBytes_) - double(used_); }
  /// Bytes up to the limit.
  uint64_t left() const { return used_ < maxBytes_ ? maxBytes_ - used_ : 0; }

  /// Counts `units` of about a nanosecond, and calls the progress function now and then. False once
  /// the work has to end for whatever reason: return at once, and free what you hold.
  bool tick(uint64_t units) {
    pending_ += units;
    if (pending_ >= kUnitsPerReport) report();
    return status_ == Status::Ok;
  }
  /// Begins a stage of work that has several, such as one of many holes: the parts that follow fill the fractions
  /// [a, b] of the whole.
  void beginStage(double a, double b) {
    stageStart_ = a, stageEnd_ = b;
    beginPart(0, 1, 0);
  }
  /// Begins a part of the work: the phases that follow fill the fractions [a, b] of the whole.
  /// Forgets the costs known so far. Costs of this part are reported times 2^costExponent.
  ///   lowerBound   proven from the start, in the unit of this part
  ///   keepsBound   whether that is all: bounds of this part do not hold for the caller's problem
  void beginPart(double a, double b, int costExponent, double lowerBound = 0,
                 bool keepsBound = false) {
    partStart_ = stageStart_ + (stageEnd_ - stageStart_) * a;
    partEnd_ = stageStart_ + (stageEnd_ - stageStart_) * b;
    costExponent_ = costExponent;
    best_ = std::numeric_limits<double>::infinity(), lower_ = lowerBound;
    keepsBound_ = keepsBound;
    phase(0, 1);
  }
  /// The best surface of the parts that are over, and the bound that holds for it. Both are reported until
  /// the current part has a surface that costs no more.
  void setEarlier(double bestCost, double lowerBound) {
    earlierBest_ = bestCost, earlierLower_ = lowerBound;
  }
  /// Begins a phase of the current part: `setFraction(0..1)` fills the fractions [a, b] of it.
  void phase(double a, double b) {
    phaseStart_ = partStart_ + (partEnd_ - partStart_) * a;
    phaseEnd_ = partStart_ + (partEnd_ - partStart_) * b;
    setFraction(0);
  }
  void setFraction(double inPhase) {
    double f = phaseStart_ + (phaseEnd_ - phaseStart_) * inPhase;
    if (f > fraction_) fraction_ = f < 1 ? f : 1;
  }
  /// Sets the costs known now in this part. The lower bound never falls.
  void setBounds(double bestCost, double lowerBound) {
    best_ = bestCost;
    if (lowerBound > lower_ && !keepsBound_) lower_ = lowerBound;
  }

  /// Ends the work, as if stopped, once `clock` tells `seconds` more than now. endStage() then lets the rest go on.
  void limitStage(double seconds, Clock clock) { clock_ = clock, deadline_ = clock() + seconds; }
  /// Whether the stage's time has ended the work.
  bool isStageOver() const { return isStageOver_; }
  /// Lifts the limit of the stage; returns whether its time had ended the work, which can then go on.
  bool endStage() {
    const bool wasOver = isStageOver_;
    if (wasOver) status_ = Status::Ok;
    isStageOver_ = false, clock_ = nullptr;
    return wasOver;
  }

  /// Ends the work, as if stopped, after about `units` more. For work that is of use unfinished:
  /// endAllowance() then lets the rest go on.
  void beginAllowance(uint64_t units) { allowed_ = spent_ + pending_ + units; }
  /// Lifts the allowance; returns whether it had ended the work, which can then go on.
  bool endAllowance() {
    const bool isUsedUp = isPaused_;
    if (isUsedUp) status_ = Status::Ok;
    isPaused_ = false, allowed_ = ~uint64_t(0);
    return isUsedUp;
  }

  bool going() const { return status_ == Status::Ok; }
  Status status() const { return status_; }
  void fail(Status s) {
    if (status_ == Status::Ok) status_ = s;
  }
  /// The lower bound of the current part, times 2^costExponent.
  double lowerBound() const { return std::ldexp(lower_, costExponent_); }
  /// Units counted so far.
  uint64_t spent() const { return spent_ + pending_; }
  uint64_t used() const { return used_; }
  uint64_t peak() const { return peak_; }

  /// Calls the progress function now.
  void report() {
    spent_ += pending_;
    pending_ = 0;
    if (spent_ >= allowed_ && status_ == Status::Ok) {
      status_ = Status::Stopped;
      isPaused_ = true;
    }
    if (clock_ && status_ == Status::Ok && clock_() >= deadline_) {
      status_ = Status::Stopped;
      isStageOver_ = true;
    }
    const double best = std::ldexp(best_, costExponent_);
    const bool isBetter = best <= earlierBest_;
    if (progress_ && !progress_(user_, fraction_, isBetter ? best : earlierBest_,
                                isBetter ? lowerBound() : earlierLower_)) {
      fail(Status::Stopped);
      isPaused_ = isStageOver_ = false;
    }
  }

 private:
  static constexpr uint32_t kUnitsPerReport = 1u << 20;
  size_t maxBytes_ = size_t(-1);
  ProgressFunction progress_ = nullptr;
  void* user_ = nullptr;
  uint64_t used_ = 0, peak_ = 0;  // 64 bits: sums are compared with the limit afterwards
  uint64_t pending_ = 0, spent_ = 0, allowed_ = ~uint64_t(0);  // units
  bool isPaused_ = false;                                      // only the allowance ended the work
  double stageStart_ = 0, stageEnd_ = 1;
  Clock clock_ = nullptr;  // of the stage's limit, if it has one
  double deadline_ = 0;
  bool isStageOver_ = false;  // only the stage's time ended the work
  double fraction_ = 0, partStart_ = 0, partEnd_ = 1, phaseStart_ = 0, phaseEnd_ = 1;
  int costExponent_ = 0;
  double best_ = std::numeric_limits<double>::infinity(), lower_ = 0;
  bool keepsBound_ = false;
  double earlierBest_ = std::numeric_limits<double>::infinity(), earlierLower_ = 0;
  Status status_ = Status::Ok;
};

}  // namespace sf

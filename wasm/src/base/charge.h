// Memory charged to the budget for as long as a scope lasts.
#pragma once
#include "base/work.h"

namespace sf {

class Charge {
 public:
  explicit Charge(Work& work) : work_(work) {}
  ~Charge() { work_.release(bytes_); }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;

  /// Charges `bytes` more; false once the limit is exceeded.
  bool add(uint64_t bytes) {
    bytes_ += bytes;
    return work_.charge(bytes);
  }

 private:
  Work& work_;
  uint64_t bytes_ = 0;
};

}  // namespace sf

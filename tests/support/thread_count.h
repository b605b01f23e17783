#pragma once

#include <ssphh/core/parallel.h>

namespace ssphh::test {

/// So many threads at most while it lives, then as many as the machine has.
class Threads {
 public:
  explicit Threads(int count) { set_thread_count(count); }
  ~Threads() { set_thread_count(0); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

}  // namespace ssphh::test

#pragma once

#include <array>
#include <cstdint>

#include <ssphh/gl/handle.h>

namespace ssphh::gl {

/// Milliseconds that a span of commands took: on a GPU by timer queries, read some frames later so that
/// nobody waits; on software renderers, whose queries lie, by the clock after glFinish.
class Timer {
 public:
  explicit Timer(bool software);

  void begin();
  void end();
  /// Milliseconds of the last span whose time is known; 0 before the first.
  double gpu_ms() const { return gpu_ms_; }
  /// Time that the calls themselves took; on a software renderer as gpu_ms.
  double cpu_ms() const { return cpu_ms_; }

 private:
  static constexpr int in_flight = 4;
  bool software_;
  double start_ = 0, gpu_ms_ = 0, cpu_ms_ = 0;
  int next_ = 0, pending_ = 0;
  std::array<Handle<delete_query>, in_flight> queries_;
};

/// Counts samples that pass the depth test between begin and end.
class SampleCounter {
 public:
  explicit SampleCounter(bool software);

  void begin();
  void end();
  /// The count of the last span of which it is known: on a GPU some frames ago. 0 before the first.
  std::uint64_t count() const { return count_; }

 private:
  bool software_;
  bool counting_ = false, waiting_ = false;
  std::uint64_t count_ = 0;
  Handle<delete_query> query_;
};

/// What a Timer or a SampleCounter looks at, from here to the end of the scope, also where that ends early: a
/// query that nobody ends would refuse all that come after it.
template <class Query>
class During {
 public:
  explicit During(Query& query) : query_(query) { query_.begin(); }
  ~During() { query_.end(); }
  During(const During&) = delete;
  During& operator=(const During&) = delete;

 private:
  Query& query_;
};

}  // namespace ssphh::gl

#pragma once
/// How many units (probes, tiles) go into the next job, so that one takes about a second or two.

#include <cstddef>

namespace ssphh::farm {

/// Results are per unit, so sizes never change a bit of them.
class JobCutter {
 public:
  explicit JobCutter(double seconds, std::size_t most = 1024) : seconds_(seconds), most_(most) {}

  /// How many of `left` units the next job of `workers` gets: fewer toward the end, so that all workers end
  /// together.
  std::size_t next(std::size_t left, std::size_t workers) const;
  /// A job of `units` took `seconds` on one worker.
  void learn(std::size_t units, double seconds);
  /// Mean of late; 0 until a job was learnt from.
  double seconds_per_unit() const { return per_unit_; }

 private:
  double seconds_, per_unit_ = 0;
  std::size_t most_;
};

}  // namespace ssphh::farm

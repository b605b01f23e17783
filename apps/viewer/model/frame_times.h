#pragma once
/// What the last frames took, stage by stage: for graphs and for files.

#include <array>
#include <map>
#include <string>
#include <vector>

namespace ssphh::viewer {

/// The last `length` values; older ones are forgotten.
class History1d {
 public:
  static constexpr int length = 240;
  void add(float value);
  int count() const { return count_; }
  /// i = 0: the oldest that is kept.
  float at(int i) const;
  float last() const { return count_ ? at(count_ - 1) : 0; }
  float median() const { return quantile(0.5); }
  /// Smallest value that at least the share q of all is not above; 0 without values.
  float quantile(double q) const;

 private:
  std::array<float, length> values_{};
  int count_ = 0, next_ = 0;
};

/// Stages in the order in which they were first seen; times in milliseconds.
class FrameTimes {
 public:
  void add(const std::string& stage, double ms);
  struct Stage {
    std::string name;
    History1d ms;
  };
  const std::vector<Stage>& stages() const { return stages_; }
  void clear() { stages_.clear(); }

  /// {"stages": [{"name", "frames", "median_ms", "p99_ms", "last_ms"}]} with `about` merged in.
  std::string to_json(const std::map<std::string, std::string>& about) const;
  /// A row per frame kept, a column per stage.
  std::string to_csv() const;

 private:
  std::vector<Stage> stages_;
};

}  // namespace ssphh::viewer

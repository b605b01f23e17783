#include "frame_times.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/json.h>

namespace ssphh::viewer {

void History1d::add(float value) {
  values_[next_] = value;
  next_ = (next_ + 1) % length;
  count_ = std::min(count_ + 1, length);
}

float History1d::at(int i) const {
  return values_[(next_ - count_ + i + length) % length];
}

float History1d::quantile(double q) const {
  if (count_ == 0) return 0;
  std::array<float, length> sorted = values_;  // Unused places stand at the end until all are in use.
  std::sort(sorted.begin(), sorted.begin() + count_);
  const int rank = static_cast<int>(std::ceil(q * count_));
  return sorted[std::clamp(rank, 1, count_) - 1];
}

void FrameTimes::add(const std::string& stage, double ms) {
  auto found = std::ranges::find_if(stages_, [&](const Stage& s) { return s.name == stage; });
  if (found == stages_.end()) found = stages_.insert(stages_.end(), {stage, {}});
  found->ms.add(static_cast<float>(ms));
}

std::string FrameTimes::to_json(const std::map<std::string, std::string>& about) const {
  json::Value out;
  for (const auto& [name, value] : about) out[name] = value;
  out["stages"] = json::Value::array();
  for (const Stage& stage : stages_) {
    out["stages"].push_back({{"name", stage.name},
                             {"frames", stage.ms.count()},
                             {"median_ms", stage.ms.median()},
                             {"p99_ms", stage.ms.quantile(0.99)},
                             {"last_ms", stage.ms.last()}});
  }
  return json::print(out, 2) + "\n";
}

std::string FrameTimes::to_csv() const {
  std::string out = "frame";
  int rows = 0;
  for (const Stage& stage : stages_) {
    out += "," + stage.name + " [ms]";
    rows = std::max(rows, stage.ms.count());
  }
  out += "\n";
  for (int row = 0; row < rows; ++row) {
    out += fmt::format("{}", row);
    for (const Stage& stage : stages_) {
      // Stages that began later are aligned with the last frame.
      const int i = row - (rows - stage.ms.count());
      out += i < 0 ? "," : fmt::format(",{:.4f}", stage.ms.at(i));
    }
    out += "\n";
  }
  return out;
}

}  // namespace ssphh::viewer

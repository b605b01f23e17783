#pragma once
/// Whether work does as many units as it said it would.

#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/control.h>

namespace ssphh::test {

class ProgressRecorder final : public Progress {
 public:
  struct Stage {
    std::string name, unit;
    std::uint64_t total = 0, done = 0;
    bool ended = false;
  };

  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override {
    const std::lock_guard lock(mutex_);
    stages_.push_back({stage, unit, total, 0, false});
  }
  void advance(std::uint64_t count) override {
    const std::lock_guard lock(mutex_);
    stages_.back().done += count;
  }
  void end() override {
    const std::lock_guard lock(mutex_);
    stages_.back().ended = true;
  }

  const std::vector<Stage>& stages() const { return stages_; }
  /// "GEN: 24 texels", of the stages in turn; each must have ended at its total.
  std::vector<std::string> finished() const {
    std::vector<std::string> text;
    for (const Stage& stage : stages_) {
      EXPECT_EQ(stage.done, stage.total) << stage.name;
      EXPECT_TRUE(stage.ended) << stage.name;
      text.push_back(fmt::format("{}: {} {}", stage.name, stage.total, stage.unit));
    }
    return text;
  }

 private:
  std::mutex mutex_;
  std::vector<Stage> stages_;
};

}  // namespace ssphh::test

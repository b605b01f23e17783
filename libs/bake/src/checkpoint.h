#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/core/bytes.h>
#include <ssphh/core/hash.h>

namespace ssphh::bake {

/// One finished probe stage.
struct CheckpointRecord {
  BakeStage stage = BakeStage::gen;
  std::uint32_t probe = 0;
  double seconds = 0;
  std::uint64_t rays = 0;
  std::vector<std::byte> payload;
};

/// An append-only file of finished probe stages. A record that a killed process left half-written is dropped.
class Checkpoint {
 public:
  /// An empty path keeps nothing. A file with another key is replaced.
  Checkpoint(std::filesystem::path path, const Hash128& key);

  /// What earlier runs finished.
  const std::vector<CheckpointRecord>& records() const { return records_; }
  /// Throws Error when it cannot be written.
  void append(const CheckpointRecord& record);

 private:
  void require_good() const;

  std::filesystem::path path_;
  std::vector<CheckpointRecord> records_;
  std::ofstream file_;
};

}  // namespace ssphh::bake

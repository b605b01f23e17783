/// File: magic, key, then records: payload size (u64), stage (u8), probe (u32), seconds (f64), rays (u64),
/// payload, checksum of all that (2×u64).

#include "checkpoint.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <system_error>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::bake {
namespace {

constexpr std::array<char, 8> magic = {'S', 'P', 'H', 'L', 'C', 'K', 'P', '1'};

ByteWriter encode_header(const Hash128& key) {
  ByteWriter out;
  out.array(std::span<const char>(magic));
  out.value(key.high), out.value(key.low);
  return out;
}

ByteWriter encode(const CheckpointRecord& record) {
  ByteWriter out;
  out.value(static_cast<std::uint64_t>(record.payload.size()));
  out.value(static_cast<std::uint8_t>(record.stage));
  out.value(record.probe);
  out.value(record.seconds);
  out.value(record.rays);
  out.array(std::span<const std::byte>(record.payload));
  const Hash128 sum = Hasher().bytes(out.bytes()).finish();
  out.value(sum.high), out.value(sum.low);
  return out;
}

constexpr std::size_t record_header = 8 + 1 + 4 + 8 + 8;
constexpr std::size_t record_checksum = 16;

/// The record at the front of `data`, which is moved past it; none when it is incomplete or damaged.
std::optional<CheckpointRecord> decode(std::span<const std::byte>& data) {
  if (data.size() < record_header + record_checksum) return std::nullopt;
  ByteReader in(data, "checkpoint");
  const auto size = in.value<std::uint64_t>("size");
  if (size > data.size() - record_header - record_checksum) return std::nullopt;
  const std::size_t checked = record_header + static_cast<std::size_t>(size);
  CheckpointRecord record;
  const auto stage = in.value<std::uint8_t>("stage");
  record.stage = stage == 0 ? BakeStage::gen : BakeStage::viz;
  record.probe = in.value<std::uint32_t>("probe");
  record.seconds = in.value<double>("seconds");
  record.rays = in.value<std::uint64_t>("rays");
  const auto payload = data.subspan(record_header, static_cast<std::size_t>(size));
  record.payload.assign(payload.begin(), payload.end());
  ByteReader sum(data.subspan(checked, record_checksum), "checkpoint");
  const auto high = sum.value<std::uint64_t>("checksum");
  const Hash128 stored{high, sum.value<std::uint64_t>("checksum")};
  if (Hasher().bytes(data.first(checked)).finish() != stored || stage > 1) return std::nullopt;
  data = data.subspan(checked + record_checksum);
  return record;
}

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path path, const Hash128& key) : path_(std::move(path)) {
  if (path_.empty()) return;
  const ByteWriter header = encode_header(key);
  std::size_t valid = 0;
  if (std::filesystem::exists(path_)) {
    // Keep the whole records of the same bake.
    const std::vector<std::byte> data = read_file(path_, probes::limits::binary_bytes);
    const auto& head = header.bytes();
    if (data.size() >= head.size() && std::equal(head.begin(), head.end(), data.begin())) {
      auto rest = std::span<const std::byte>(data).subspan(head.size());
      while (auto record = decode(rest)) records_.push_back(std::move(*record));
      valid = data.size() - rest.size();
    } else {
      log_info("{} is of another bake: starting again", path_.string());
    }
  }
  if (valid > 0) {
    std::error_code error;
    std::filesystem::resize_file(path_, valid, error);
    if (error) throw Error(path_.string(), "cannot be written: " + error.message());
    file_.open(path_, std::ios::binary | std::ios::app);
  } else {
    file_.open(path_, std::ios::binary | std::ios::trunc);
    file_.write(reinterpret_cast<const char*>(header.bytes().data()),
                static_cast<std::streamsize>(header.bytes().size()));
    file_.flush();
  }
  require_good();
}

void Checkpoint::append(const CheckpointRecord& record) {
  if (path_.empty()) return;
  const ByteWriter out = encode(record);
  file_.write(reinterpret_cast<const char*>(out.bytes().data()),
              static_cast<std::streamsize>(out.bytes().size()));
  file_.flush();
  require_good();
}

void Checkpoint::require_good() const {
  if (file_.good()) return;
  const std::string reason = std::generic_category().message(errno);
  throw Error(path_.string(), "the checkpoint cannot be written: " + reason,
              "is the folder writable and the disk not full?");
}

}  // namespace ssphh::bake

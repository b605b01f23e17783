#include "kept_poses.h"

#include <algorithm>

#include <ssphh/core/random.h>

namespace ssphh::transport {
namespace {

template <class T>
std::span<T> part_of(std::vector<T>& all, std::size_t pose, std::size_t size) {
  return std::span(all).subspan(pose * size, size);
}

}  // namespace

std::size_t KeptPoses::Sizes::bytes() const {
  return parts * sizeof(mat4) + samples + hits * sizeof(Resolved) + mirrored * sizeof(SeenPatch) +
         links * sizeof(KeptLink) + records * sizeof(std::int32_t);
}

void KeptPoses::allow(std::size_t bytes) {
  const std::size_t records = records_;
  *this = KeptPoses();
  allowed_ = bytes;
  records_ = records;
}

void KeptPoses::set_records(std::size_t count) {
  records_ = count;
  allow(allowed_);
}

bool KeptPoses::find(std::span<const mat4> parts) {
  leave();
  for (std::size_t i = 0; i < used_ && !has_current(); ++i) {
    if (std::ranges::equal(part_of(parts_, i, sizes_.parts), parts)) current_ = i;
  }
  return has_current();
}

bool KeptPoses::take(Sizes sizes) {
  leave();
  if (allowed_ == 0) return false;
  sizes.records = records_;
  if (sizes != sizes_) {
    sizes_ = sizes;
    used_ = 0;
    room_ = allowed_ / std::max<std::size_t>(sizes.bytes(), 1);
    for_each([&](auto& all, std::size_t of_one) { all.reserve(room_ * of_one); });
  }
  if (room_ == 0) return false;
  if (used_ < room_) {
    current_ = used_++;
    for_each([&](auto& all, std::size_t of_one) { all.resize(used_ * of_one); });
  } else {
    // One in eight takes the place of any other: of an animation longer than there is room for, most stay and
    // are met again, and one that is over goes in time.
    if (++passed_over_ % 8 != 0) return false;
    current_ = mix64(passed_over_) % room_;
  }
  has_records_[current_] = false;
  return true;
}

KeptPoses::Pose KeptPoses::current() {
  return {.parts = part_of(parts_, current_, sizes_.parts),
          .sample_used = part_of(sample_used_, current_, sizes_.samples),
          .hits = part_of(hits_, current_, sizes_.hits),
          .mirrored = part_of(mirrored_, current_, sizes_.mirrored),
          .links = part_of(links_, current_, sizes_.links),
          .records = part_of(record_patches_, current_, sizes_.records)};
}

}  // namespace ssphh::transport

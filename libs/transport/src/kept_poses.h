#pragma once
/// What rays met in exact poses, so that an animation that repeats casts them once.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/vectors.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

/// What a probe's ray or a link meets.
struct Resolved {
  std::int32_t patch = no_patch;
  std::uint32_t albedo = 0;
  std::uint16_t emission = 0;
  float distance = 0;
};

/// What a moving link or a part's meets.
struct KeptLink {
  std::int32_t patch = no_patch;
  std::uint8_t counted = 0, lost = 0;
};

/// Memory for as many poses as fit, all of it taken with the first.
class KeptPoses {
 public:
  /// Of one pose: how many of each.
  struct Sizes {
    std::size_t parts = 0, samples = 0, hits = 0, mirrored = 0, links = 0, records = 0;

    std::size_t bytes() const;
    friend bool operator==(const Sizes&, const Sizes&) = default;
  };
  struct Pose {
    std::span<mat4> parts;  ///< to world: the pose itself
    std::span<std::uint8_t> sample_used;
    std::span<Resolved> hits;
    std::span<SeenPatch> mirrored;
    std::span<KeptLink> links;
    std::span<std::int32_t> records;  ///< what the moving rays of a session's records meet
  };

  /// Forgets all; 0 bytes: keeps none from now on.
  void allow(std::size_t bytes);
  /// Of the records of the poses to come; forgets all.
  void set_records(std::size_t count);
  /// The pose of these parts is current; false: it is not kept, and none is.
  bool find(std::span<const mat4> parts);
  /// A new pose is current, to be written whole; false: it gets no room, and none is.
  bool take(Sizes sizes);
  /// No pose is current.
  void leave() { current_ = none; }
  bool has_current() const { return current_ != none; }
  Pose current();
  /// Whether the current pose has its records.
  bool has_records() const { return has_records_[current_]; }
  void note_records() { has_records_[current_] = true; }
  std::size_t bytes() const { return used_ * sizes_.bytes(); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Calls visit(array of all poses, elements of one pose).
  template <class Visit>
  void for_each(const Visit& visit) {
    visit(parts_, sizes_.parts);
    visit(sample_used_, sizes_.samples);
    visit(hits_, sizes_.hits);
    visit(mirrored_, sizes_.mirrored);
    visit(links_, sizes_.links);
    visit(record_patches_, sizes_.records);
    visit(has_records_, std::size_t{1});
  }

  std::size_t allowed_ = 0, records_ = 0;
  Sizes sizes_;
  std::size_t room_ = 0, used_ = 0, passed_over_ = 0, current_ = none;
  std::vector<mat4> parts_;
  std::vector<std::uint8_t> sample_used_, has_records_;
  std::vector<Resolved> hits_;
  std::vector<SeenPatch> mirrored_;
  std::vector<KeptLink> links_;
  std::vector<std::int32_t> record_patches_;
};

}  // namespace ssphh::transport

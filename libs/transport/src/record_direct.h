#pragma once
/// Light of emitters at records that is found there and not by way of surfels: direct light of light groups
/// that are baked, and of any group what panes mirror.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/surface_records.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

class RecordDirect {
 public:
  RecordDirect() = default;
  enum class Way { straight, mirrored };
  explicit RecordDirect(std::vector<int> groups, Way way = Way::straight)
      : groups_(std::move(groups)), way_(way), found_(groups_.size()) {}

  /// Finds the light of those points that come after the ones it knows, from `samples` of each emitter.
  void extend(const rays::DirectLight& light, std::span<const rays::SurfacePoint> points, int samples,
              const Control& control);

  /// Forgets a group's light, for it to be found anew.
  void forget(int group) {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      if (groups_[i] == group) found_[i].clear();
  }

  /// Adds Σ_g scales[g] times the light of each point; `scales` are of all light groups.
  void add_to(std::vector<probes::RecordLight>& light, std::span<const vec3> scales) const;

  const std::vector<int>& groups() const { return groups_; }
  /// Of each point by groups()[i], unscaled.
  const std::vector<probes::RecordLight>& found(std::size_t i) const { return found_[i]; }

 private:
  std::vector<int> groups_;
  Way way_ = Way::straight;
  std::vector<std::vector<probes::RecordLight>> found_;  ///< [of groups_][point]
};

}  // namespace ssphh::transport

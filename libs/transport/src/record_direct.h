#pragma once
/// Direct light at records, of light groups that are baked.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/surface_records.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

class RecordDirect {
 public:
  RecordDirect() = default;
  explicit RecordDirect(std::vector<int> groups) : groups_(std::move(groups)), found_(groups_.size()) {}

  /// Finds the light of those points that come after the ones it knows, from `samples` of each emitter.
  void extend(const rays::DirectLight& light, std::span<const rays::SurfacePoint> points, int samples,
              const Control& control);

  /// Adds Σ_g scales[g] times the light of each point; `scales` are of all light groups.
  void add_to(std::vector<probes::RecordLight>& light, std::span<const vec3> scales) const;

  const std::vector<int>& groups() const { return groups_; }
  /// Of each point by groups()[i], unscaled.
  const std::vector<probes::RecordLight>& found(std::size_t i) const { return found_[i]; }

 private:
  std::vector<int> groups_;
  std::vector<std::vector<probes::RecordLight>> found_;  ///< [of groups_][point]
};

}  // namespace ssphh::transport

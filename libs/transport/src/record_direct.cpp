#include "record_direct.h"

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

namespace ssphh::transport {

void RecordDirect::extend(const rays::DirectLight& light, std::span<const rays::SurfacePoint> points,
                          int samples, const Control& control) {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    std::vector<probes::RecordLight>& found = found_[i];
    const std::size_t known = found.size();
    if (known >= points.size()) continue;
    found.resize(points.size());
    parallel_for(
        points.size() - known, 16,
        [&](std::size_t k) {
          const std::size_t p = known + k;
          found[p] = way_ == Way::straight ? light.irradiance_by_normal(groups_[i], points[p], samples)
                                           : light.mirrored_by_normal(groups_[i], points[p], samples);
          for (glm::length_t c = 0; c < 4; ++c)
            require(is_finite(found[p][c]), "transport source", "its direct light is not finite");
        },
        control);
  }
}

void RecordDirect::add_to(std::vector<probes::RecordLight>& light, std::span<const vec3> scales) const {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const vec3& scale = scales[groups_[i]];
    for (std::size_t p = 0; p < light.size(); ++p) {
      for (glm::length_t c = 0; c < 4; ++c) light[p][c] += scale * found_[i][p][c];
    }
  }
}

}  // namespace ssphh::transport

#include "surface_samples.h"

#include <cmath>

#include <ssphh/core/for_this_cpu.h>

#include "surface_entry.h"
#include "surface_shares.h"

namespace ssphh::probes {
namespace {

// By how much less than SurfaceInterpolation takes a point's normal may agree with the surface's:
// shading normals are not those.
constexpr float least_cosine = 0.2f;

/// A point is left out of a list where nearer ones that are seen outweigh it so many times.
constexpr float most_outweighed = 4096;

}  // namespace

void SurfaceSamples::clear() {
  for (std::vector<float>& numbers : numbers_) numbers.clear();
  for (std::size_t side = 0; side < 2; ++side) {
    narrow_[side].clear(), asked_[side].clear(), headroom_[side].clear();
    finest_[side].clear(), finest_seen_[side].clear();
  }
  parts_.clear(), verdicts_.clear(), weights_.clear();
}

void SurfaceSamples::add(const vec3& position, const vec3& normal, const vec3& local) {
  const float all[]{position.x, position.y, position.z, normal.x, normal.y, normal.z, 0, 0};
  for (std::size_t k = 0; k < numbers_.size(); ++k) numbers_[k].push_back(all[k]);
  for (std::size_t side = 0; side < 2; ++side) {
    narrow_[side].push_back(0), asked_[side].push_back(0), headroom_[side].push_back(-1);
    finest_[side].push_back(far), finest_seen_[side].push_back(far);
  }
  const auto part = [&](int cut) { return static_cast<std::uint8_t>(surface_part(local, cut)); };
  parts_.push_back({part(0), part(1), part(2), part(3)});
  verdicts_.push_back(out_of_reach), weights_.push_back(0);
}

void SurfaceSamples::judge(const rays::SurfacePoint& point, float spacing) {
  const vec3 p = point.position, n = point.normal;
  const float *x = numbers_[0].data(), *y = numbers_[1].data(), *z = numbers_[2].data();
  const float *nx = numbers_[3].data(), *ny = numbers_[4].data(), *nz = numbers_[5].data();
  const float* __restrict front = numbers_[6].data(), * __restrict back = numbers_[7].data();
  std::int32_t* const verdicts = verdicts_.data();
  for_this_cpu([&]() SSPHH_IN_LOOP {
    for (std::size_t i = 0, count = size(); i < count; ++i) {
      const float dx = p.x - x[i], dy = p.y - y[i], dz = p.z - z[i];
      const float distance2 = dx * dx + dy * dy + dz * dz;
      const float cosine = nx[i] * n.x + ny[i] * n.y + nz[i] * n.z;
      const float off_plane = std::abs(dx * nx[i] + dy * ny[i] + dz * nz[i]);
      const float of_front = front[i], of_back = back[i];  // both: a loop with branches stays scalar
      const float share = share_by_distance(distance2, spacing), counted = cosine < 0 ? of_back : of_front;
      std::int32_t verdict = most_outweighed * share <= counted ? outweighed : asked;
      verdict = share > 0 ? verdict : out_of_reach;
      verdict = std::abs(cosine) >= least_cosine ? verdict : out_of_reach;
      // A shading normal may lean toward the point
      verdict = off_plane <= 0.75f * spacing + 0.3f * std::sqrt(distance2) ? verdict : out_of_reach;
      verdicts[i] = verdict;
    }
  });
}

void SurfaceSamples::weigh(const rays::SurfacePoint& point, float spacing, int cover) {
  const vec3 p = point.position, n = point.normal;
  const float *x = numbers_[0].data(), *y = numbers_[1].data(), *z = numbers_[2].data();
  const float *nx = numbers_[3].data(), *ny = numbers_[4].data(), *nz = numbers_[5].data();
  float* const weights = weights_.data();
  for_this_cpu([&]() SSPHH_IN_LOOP {
    for (std::size_t i = 0, count = size(); i < count; ++i) {
      const float dx = p.x - x[i], dy = p.y - y[i], dz = p.z - z[i];
      const float distance2 = dx * dx + dy * dy + dz * dz;
      const float cosine = nx[i] * n.x + ny[i] * n.y + nz[i] * n.z;
      const float off_plane = dx * nx[i] + dy * ny[i] + dz * nz[i];
      weights[i] = share_by_distance(distance2, spacing) *
                   share_by_surface(std::sqrt(distance2), off_plane, std::abs(cosine), spacing) *
                   cover_factor(cover, distance2, spacing);
    }
  });
}

}  // namespace ssphh::probes

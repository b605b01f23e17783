#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/transport/surfel_sizes.h>

namespace ssphh::transport {

struct SurfelSizes::Probes {
  explicit Probes(std::span<const vec3> at) : places(at.begin(), at.end()), nearest(at) {
    std::array<geometry::Near, 2> two;
    for (const vec3& place : places) {
      const int found = nearest.find(place, two);
      apart.push_back(found == 2 ? std::sqrt(two[1].distance2) : 0);
    }
  }
  std::vector<vec3> places;
  geometry::NearestPoints nearest;
  std::vector<float> apart;  ///< from the nearest other one; 0: there is none
};

SurfelSizes::SurfelSizes(float finest, std::span<const vec3> probes, float share)
    : finest_(finest), share_(share), probes_(std::make_shared<Probes>(probes)) {}

namespace {

int doublings(float size, float finest) {
  if (!(size > finest)) return 0;
  return std::min(static_cast<int>(std::log2(size / finest)), SurfelSizes::most_level);
}

}  // namespace

int SurfelSizes::level(const vec3& position) const {
  if (!probes_) return 0;
  geometry::Near near{};
  probes_->nearest.find(position, {&near, 1});
  const float apart = probes_->apart[near.index];
  return doublings(share_ * std::max(std::sqrt(near.distance2), apart), finest_);
}

int SurfelSizes::level(const scene::Bounds& box) const {
  if (!probes_ || box.empty()) return 0;
  float local = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < probes_->places.size(); ++i) {
    const vec3& probe = probes_->places[i];
    const float distance = glm::distance(probe, glm::clamp(probe, box.min, box.max));
    local = std::min(local, std::max(distance, probes_->apart[i]));
  }
  return doublings(share_ * local, finest_);
}

namespace {

/// Rays that graze stand for no more surface than at this cosine: the few that do would rule the sum.
constexpr double least_cosine = 0.1;

/// What a ray stands for: a place and its surface [m²], 0 where another probe is nearer.
struct Patch {
  vec3 position{0};
  double area = 0;
};

std::vector<Patch> patches_of(const ProbeGBuffer& gbuffer) {
  const std::size_t directions = gbuffer.directions.size();
  const geometry::NearestPoints nearest(gbuffer.positions);
  std::vector<Patch> patches(gbuffer.hits.size());
  parallel_for(patches.size(), 1024, [&](std::size_t i) {
    const PackedHit& hit = gbuffer.hits[i];
    if (std::isinf(hit.distance)) return;
    const vec3& direction = gbuffer.directions[i % directions];
    const vec3 position = gbuffer.positions[i / directions] + hit.distance * direction;
    geometry::Near near{};
    nearest.find(position, {&near, 1});
    if (gbuffer.positions[near.index] != gbuffer.positions[i / directions]) return;
    const double distance = double{hit.distance};
    const double cosine = std::max(std::abs(double{glm::dot(unpack_normal(hit), direction)}), least_cosine);
    patches[i] = {position, 4 * pi_d * distance * distance / (static_cast<double>(directions) * cosine)};
  });
  return patches;
}

double surfels_of(const std::vector<Patch>& patches, const SurfelSizes& sizes) {
  std::vector<double> count(patches.size(), 0);
  parallel_for(patches.size(), 1024, [&](std::size_t i) {
    if (!(patches[i].area > 0)) return;
    const double size = double{sizes.size(sizes.level(patches[i].position))};
    count[i] = patches[i].area / (size * size);
  });
  double sum = 0;
  for (const double c : count) sum += c;
  return sum;
}

}  // namespace

double estimated_surfels(const ProbeGBuffer& gbuffer, const SurfelSizes& sizes) {
  return surfels_of(patches_of(gbuffer), sizes);
}

SurfelSizes sizes_within(const ProbeGBuffer& gbuffer, float finest, std::size_t most) {
  const std::vector<Patch> patches = patches_of(gbuffer);
  SurfelSizes sizes(finest);
  if (surfels_of(patches, sizes) <= static_cast<double>(most)) return sizes;
  constexpr float first_share = 1.0f / 12, last_share = 16;
  for (float share = first_share; share <= last_share; share *= 1.25f) {
    sizes = SurfelSizes(finest, gbuffer.positions, share);
    if (surfels_of(patches, sizes) <= static_cast<double>(most) / 6) break;
  }
  return sizes;
}

}  // namespace ssphh::transport

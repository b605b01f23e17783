#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/transport/surfel_sizes.h>

namespace ssphh::transport {

struct SurfelSizes::Places {
  Places(std::span<const vec3> at, std::span<const vec3> lamps)
      : probes(at.begin(), at.end()), nearest_probe(at), nearest_lamp(lamps) {
    std::array<geometry::Near, 2> two;
    for (const vec3& place : probes) {
      const int found = nearest_probe.find(place, two);
      apart.push_back(found == 2 ? std::sqrt(two[1].distance2) : 0);
    }
  }
  std::vector<vec3> probes;
  geometry::NearestPoints nearest_probe, nearest_lamp;
  std::vector<float> apart;  ///< from the nearest other probe; 0: there is none
};

namespace {

/// Of the usual size, near lamps.
constexpr int halvings = 2, halvings_of_many = 1;
constexpr float share_of_lamp = 0.5f;  // of its distance

int doublings(float size, float finest, int most) {
  if (!(size > finest)) return 0;
  const float count = std::log2(size / finest);
  return count < static_cast<float>(most) ? static_cast<int>(count) : most;
}

}  // namespace

SurfelSizes::SurfelSizes(float size, std::span<const vec3> lamps)
    : usual_level_(lamps.empty() ? 0 : halvings), usual_(size), lamp_share_(share_of_lamp) {
  if (!lamps.empty()) places_ = std::make_shared<Places>(std::span<const vec3>(), lamps);
}

SurfelSizes::SurfelSizes(float size, std::span<const vec3> probes, float share, std::span<const vec3> lamps)
    : usual_level_(lamps.empty() ? 0 : halvings_of_many),
      usual_(size),
      share_(share),
      lamp_share_(std::min(share, share_of_lamp)),
      places_(std::make_shared<Places>(probes, lamps)) {}

int SurfelSizes::level_of(float local) const {
  return usual_level_ + doublings(share_ * local, usual_, most_level - usual_level_);
}

int SurfelSizes::level_by_probes(const vec3& position) const {
  if (!places_) return 0;
  float local = 0;
  geometry::Near near{};
  if (places_->nearest_probe.find(position, {&near, 1}) > 0)
    local = std::max(std::sqrt(near.distance2), places_->apart[near.index]);
  return level_of(local);
}

int SurfelSizes::level(const vec3& position) const {
  const int level = level_by_probes(position);
  geometry::Near near{};
  if (!places_ || places_->nearest_lamp.find(position, {&near, 1}, size(level) / lamp_share_) == 0)
    return level;
  return std::min(level, doublings(lamp_share_ * std::sqrt(near.distance2), finest(), most_level));
}

int SurfelSizes::level(const scene::Bounds& box) const {
  if (!places_ || box.empty()) return 0;
  if (places_->probes.empty()) return level_of(0);
  float local = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < places_->probes.size(); ++i) {
    const vec3& probe = places_->probes[i];
    const float distance = glm::distance(probe, glm::clamp(probe, box.min, box.max));
    local = std::min(local, std::max(distance, places_->apart[i]));
  }
  return level_of(local);
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

SurfelSizes sizes_within(const ProbeGBuffer& gbuffer, float size, std::size_t most,
                         std::span<const vec3> small_lamps, std::span<const vec3> lamps, bool grow) {
  const std::vector<Patch> patches = patches_of(gbuffer);
  SurfelSizes sizes(size, small_lamps);
  if (!grow && surfels_of(patches, sizes) <= static_cast<double>(most)) return sizes;
  constexpr float first_share = 1.0f / 12, last_share = 16;
  for (float share = first_share; share <= last_share; share *= 1.25f) {
    sizes = SurfelSizes(size, gbuffer.positions, share, lamps);
    if (surfels_of(patches, sizes) <= static_cast<double>(most) / 4) break;
  }
  return sizes;
}

}  // namespace ssphh::transport

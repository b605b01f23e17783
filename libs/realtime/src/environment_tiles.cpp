#include "environment_tiles.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/parallel.h>
#include <ssphh/image/sphere_map.h>

#include "emitter_samples.h"
#include "gpu_types.h"

namespace ssphh::realtime {
namespace {

constexpr int tile_size = 96, lobe_samples = 64;

/// An image and its halves: a sample of a lobe reads the one whose pixels are as large as what it stands for,
/// so that few samples have no noise (Křivánek & Colbert, Real-time Shading with Filtered Importance
/// Sampling, EGSR 2008).
class ImagePyramid {
 public:
  explicit ImagePyramid(const scene::Environment& environment) {
    image::Image whole = environment.equirect.empty() ? image::Image(2, 1, 3) : environment.equirect;
    for (int y = 0; y < whole.height; ++y) {
      for (int x = 0; x < whole.width; ++x)
        whole.set_rgb(x, y, environment.color * (environment.equirect.empty() ? vec3(1) : whole.rgb(x, y)));
    }
    levels_.push_back(std::move(whole));
    while (levels_.back().width > 4 && levels_.back().height > 2) levels_.push_back(half(levels_.back()));
    const image::Image& first = levels_.front();
    texel_ = 4 * pi / static_cast<float>(first.width * first.height);
  }

  /// Between which of the images to read what stands for a solid angle.
  struct Level {
    std::size_t low, high;
    float share;  ///< of the upper
  };
  Level level_of(float solid_angle) const {
    const float level = std::clamp(0.5f * std::log2(std::max(solid_angle / texel_, 1.0f)), 0.0f,
                                   static_cast<float>(levels_.size() - 1));
    const auto low = static_cast<std::size_t>(level);
    return {low, std::min(low + 1, levels_.size() - 1), level - static_cast<float>(low)};
  }
  vec3 radiance(const vec3& d, const Level& level) const {
    const vec2 uv = image::equirect_uv(d);
    return glm::mix(image::sample_equirect_at(levels_[level.low], uv),
                    image::sample_equirect_at(levels_[level.high], uv), level.share);
  }

 private:
  static image::Image half(const image::Image& from) {
    image::Image out(from.width / 2, from.height / 2, 3);
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        // Rows near a pole stand for less
        vec3 sum(0);
        float weights = 0;
        for (int i = 0; i < 4; ++i) {
          const int row = 2 * y + i / 2;
          const auto weight = static_cast<float>(image::equirect_solid_angle(row, from.width, from.height));
          sum += weight * from.rgb(2 * x + i % 2, row);
          weights += weight;
        }
        out.set_rgb(x, y, sum / weights);
      }
    }
    return out;
  }

  std::vector<image::Image> levels_;
  float texel_;
};

/// A direction in a lobe about +z, and how finely it is looked at.
struct LobeSample {
  vec3 direction;
  ImagePyramid::Level level;
};

/// Of the lobe for a viewer along +z: half vectors by their density.
std::vector<LobeSample> samples_of_lobe(const ImagePyramid& pyramid, float roughness) {
  const float alpha = std::max(roughness * roughness, 1e-3f), a2 = alpha * alpha;
  std::vector<LobeSample> samples;
  for (int i = 0; i < lobe_samples; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / lobe_samples;
    const auto phi = static_cast<float>(2 * pi_d * radical_inverse(static_cast<unsigned>(i), 2));
    const float cos2 = (1 - u) / (1 + (a2 - 1) * u), cosine = std::sqrt(cos2), sine = std::sqrt(1 - cos2);
    // Mirrored at the half vector: twice its angle
    const vec3 l(2 * cosine * sine * std::cos(phi), 2 * cosine * sine * std::sin(phi), 2 * cos2 - 1);
    if (!(l.z > 0)) continue;
    const float t = cos2 * (a2 - 1) + 1, density = a2 / (pi * t * t) / 4;  // of l
    samples.push_back({l, pyramid.level_of(1 / (static_cast<float>(lobe_samples) * density))});
  }
  return samples;
}

vec3 seen_through_lobe(const ImagePyramid& pyramid, const vec3& axis, std::span<const LobeSample> samples) {
  const Frame frame = Frame::around(axis);
  vec3 sum(0);
  float weights = 0;
  for (const LobeSample& sample : samples) {
    const float weight = sample.direction.z;
    sum += weight * pyramid.radiance(frame.to_world(sample.direction), sample.level);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

TileAtlas environment_tiles(const scene::Environment& environment) {
  const ImagePyramid pyramid(environment);
  TileAtlas atlas(tile_size, static_cast<int>(environment_roughness.size()));
  constexpr int side = tile_size + 2;
  const ImagePyramid::Level mirror = pyramid.level_of(4 * pi / (tile_size * tile_size));
  std::vector<vec4> texels(static_cast<std::size_t>(side) * side);
  for (std::size_t level = 0; level < environment_roughness.size(); ++level) {
    const std::vector<LobeSample> lobe = samples_of_lobe(pyramid, environment_roughness[level]);
    parallel_for(side, 8, [&](std::size_t row) {
      for (std::size_t column = 0; column < side; ++column) {
        const vec2 place(2 * static_cast<float>(column) - 1, 2 * static_cast<float>(row) - 1);
        const vec3 d = octahedral_direction(place / static_cast<float>(tile_size) - 1.0f);
        const vec3 radiance = level == 0 ? pyramid.radiance(d, mirror) : seen_through_lobe(pyramid, d, lobe);
        texels[row * side + column] = vec4(glm::min(radiance, vec3(largest_half)), 0);
      }
    });
    atlas.upload(static_cast<int>(level), texels);
  }
  return atlas;
}

}  // namespace ssphh::realtime

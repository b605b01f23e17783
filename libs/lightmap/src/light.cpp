#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/lightmap/light.h>

#include "fit.h"

namespace ssphh::lightmap {
namespace {

/// A texel whose centre is not its place is the light there and as much more as the light changes over a
/// texel's edge before that place, within these factors: bilinear light is linear up to the border.
constexpr float least_factor = 0.5f, most_factor = 2;

using Ring = std::vector<std::pair<std::size_t, vec3>>;

/// A chart's rectangle, gutter included, as light spreads over it.
class Patch {
 public:
  Patch(const PlacedChart& place, int width, image::Image& atlas)
      : low_(place.first - gutter),
        size_(place.count + 2 * gutter),
        width_(width),
        atlas_(atlas),
        known_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), 0) {}

  void know(std::uint32_t index) { known_[inside(index)] = 1; }
  bool knows(std::uint32_t index) const { return known_[inside(index)] != 0; }

  /// Of those that `takes(x, y)` and that are not known, those beside known ones become their mean; a texel
  /// in a thin wall between light and darkness that of the dark side.
  template <class Takes>
  void spread(const Takes& takes) {
    Ring ring;
    for (int y = 0; y < size_.y; ++y) {
      for (int x = 0; x < size_.x; ++x) {
        if (known_[at(x, y)] || !takes(x, y)) continue;
        const auto visit = [&](const auto& use) {
          for (int v = std::max(0, y - 1); v <= std::min(size_.y - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(size_.x - 1, x + 1); ++u)
              if (known_[at(u, v)]) use(atlas_.rgb(low_.x + u, low_.y + v), u == x || v == y ? 1 : 0.5f);
        };
        float darkest = std::numeric_limits<float>::infinity();
        visit([&](const vec3& light, float) { darkest = std::min(darkest, luminance(light)); });
        vec3 sum(0);
        float weight = 0;
        visit([&](const vec3& light, float w) {
          if (luminance(light) <= most_factor * darkest) sum += w * light, weight += w;
        });
        if (weight > 0) ring.emplace_back(at(x, y), sum / weight);
      }
    }
    for (const auto& [i, value] : ring) {
      const auto columns = static_cast<std::size_t>(size_.x);
      known_[i] = 1;
      atlas_.set_rgb(low_.x + static_cast<int>(i % columns), low_.y + static_cast<int>(i / columns), value);
    }
  }
  /// The same for texels of the chart that are not known, beside known ones.
  void spread_once(std::span<const Texel> texels) {
    std::vector<std::uint8_t> of_chart(known_.size(), 0);
    for (const Texel& texel : texels) of_chart[inside(texel.index)] = 1;
    spread([&](int x, int y) { return of_chart[at(x, y)] != 0; });
  }
  /// Bilinear at a place in the atlas; false where a texel of weight is not known.
  bool look(const vec2& place, vec3& out) const {
    const vec2 low = glm::floor(place - 0.5f), part = place - 0.5f - low;
    float all = 0;
    out = vec3(0);
    for (int k = 0; k < 4; ++k) {
      const float weight = (k & 1 ? part.x : 1 - part.x) * (k & 2 ? part.y : 1 - part.y);
      if (weight < 1e-4f) continue;
      const glm::ivec2 texel = glm::ivec2(low) + glm::ivec2(k & 1, k >> 1), here = texel - low_;
      if (glm::any(glm::lessThan(here, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(here, size_)) ||
          !known_[at(here.x, here.y)])
        return false;
      all += weight, out += weight * atlas_.rgb(texel.x, texel.y);
    }
    out /= all;
    return true;
  }
  /// Of texels that are known.
  void extrapolate(std::span<const Texel> texels) {
    std::vector<std::pair<std::uint32_t, vec3>> changed;
    const auto w = static_cast<std::uint32_t>(width_);
    for (const Texel& texel : texels) {
      const float length = glm::length(texel.way);
      if (!(length > 0) || !knows(texel.index)) continue;
      const glm::ivec2 place(static_cast<int>(texel.index % w), static_cast<int>(texel.index / w));
      vec3 before;
      if (!look(vec2(place) + 0.5f - texel.way * (1 + 1 / length), before)) continue;
      const vec3 here = atlas_.rgb(place.x, place.y);
      changed.emplace_back(
          texel.index, glm::clamp(here + length * (here - before), least_factor * here, most_factor * here));
    }
    for (const auto& [index, value] : changed)
      atlas_.set_rgb(static_cast<int>(index % w), static_cast<int>(index / w), value);
  }

 private:
  std::size_t inside(std::uint32_t index) const {
    const auto w = static_cast<std::uint32_t>(width_);
    return at(static_cast<int>(index % w) - low_.x, static_cast<int>(index / w) - low_.y);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
  }

  glm::ivec2 low_, size_;
  int width_;
  image::Image& atlas_;
  std::vector<std::uint8_t> known_;
};

/// Light of hidden texels that no chart lights: that of the nearest place in the world that is lit. A crack
/// between two bodies that touch shows what lies within it.
std::vector<std::pair<std::uint32_t, vec3>> light_nearby(const Texels& texels, const Places& places,
                                                         std::span<const std::uint8_t> is_lit,
                                                         std::span<const Patch> patches,
                                                         const image::Image& atlas, const Control& control) {
  std::vector<std::size_t> unlit;
  for (std::size_t chart = 0; chart < patches.size(); ++chart)
    for (std::size_t i = texels.first[chart]; i < texels.first[chart + 1]; ++i)
      if (!patches[chart].knows(texels.texels[i].index)) unlit.push_back(i);
  std::vector<std::pair<std::uint32_t, vec3>> out(unlit.size());
  if (unlit.empty()) return out;
  std::vector<std::size_t> lit;
  std::vector<vec3> at;
  for (std::size_t i = 0; i < texels.texels.size(); ++i)
    if (is_lit[i]) lit.push_back(i), at.push_back(places.points[i].position);
  const geometry::NearestPoints nearest(at);
  parallel_for(
      unlit.size(), 256,
      [&](std::size_t k) {
        const auto w = static_cast<std::uint32_t>(atlas.width);
        std::array<geometry::Near, 1> found;
        nearest.find(places.points[unlit[k]].position, found);
        const std::uint32_t index = texels.texels[lit[static_cast<std::size_t>(found[0].index)]].index;
        out[k] = {texels.texels[unlit[k]].index,
                  atlas.rgb(static_cast<int>(index % w), static_cast<int>(index / w))};
      },
      control);
  return out;
}

void set(image::Image& atlas, std::uint32_t index, const vec3& value) {
  const auto w = static_cast<std::uint32_t>(atlas.width);
  atlas.set_rgb(static_cast<int>(index % w), static_cast<int>(index / w), value);
}

/// Mean over the places within a texel that are reached, or at its own where none is.
vec3 mean_light(const Texels& texels, const Places& places, std::size_t i, const IrradianceAt& light) {
  vec3 sum(0);
  int count = 0;
  for (int k = 0; k < places_within; ++k)
    if (places.reached[i] >> k & 1) sum += light(place_within(texels, texels.texels[i], k)), ++count;
  return count > 0 ? sum / static_cast<float>(count) : light(places.points[i]);
}

}  // namespace

image::Image light_texels(const Texels& texels, const Places& places, const IrradianceAt& irradiance,
                          const IrradianceAt& sharp, const Control& control) {
  require(places.points.size() == texels.texels.size() && places.hidden.size() == texels.texels.size() &&
              places.reached.size() == texels.texels.size(),
          "lightmap", "the places are of other texels");
  require(irradiance != nullptr, "lightmap", "nothing tells the irradiance of a place");
  require_places(texels.places, texels.width, texels.height, "lightmap texels");
  const auto size = static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height);
  for (const Texel& texel : texels.texels)
    require(texel.index < size && texel.face < texels.faces.size(), "lightmap texels",
            "a texel is outside of the atlas or of no face");
  require(texels.first.size() == texels.places.size() + 1 && std::ranges::is_sorted(texels.first) &&
              texels.first.back() <= texels.texels.size(),
          "lightmap texels", "charts do not begin in their order");
  // Where nothing is open it is not known what is seen.
  std::vector<std::uint8_t> lit = places.hidden;
  if (std::ranges::find(lit, 0) != lit.end())
    for (std::uint8_t& is : lit) is = is == 0;
  image::Image atlas(texels.width, texels.height);
  ProgressStage stage(control, "light of texels", texels.texels.size(), "texels");
  parallel_for(
      texels.texels.size(), 64,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (!lit[i]) continue;
          const vec3 smooth = irradiance(places.points[i]);
          set(atlas, texels.texels[i].index, sharp ? smooth + mean_light(texels, places, i, sharp) : smooth);
        }
        stage.advance(end - begin);
      },
      control);
  std::vector<Patch> patches;
  patches.reserve(texels.places.size());
  for (const PlacedChart& place : texels.places) patches.emplace_back(place, texels.width, atlas);
  const auto of_chart = [&](std::size_t chart) {
    return std::span(texels.texels)
        .subspan(texels.first[chart], texels.first[chart + 1] - texels.first[chart]);
  };
  parallel_for(
      patches.size(), 1,
      [&](std::size_t chart) {
        Patch& patch = patches[chart];
        for (std::size_t i = texels.first[chart]; i < texels.first[chart + 1]; ++i)
          if (lit[i]) patch.know(texels.texels[i].index);
        patch.extrapolate(of_chart(chart));
        // What filters read beside light.
        patch.spread_once(of_chart(chart));
      },
      control);
  const std::vector<std::pair<std::uint32_t, vec3>> unseen =
      light_nearby(texels, places, lit, patches, atlas, control);
  for (const auto& [index, value] : unseen) set(atlas, index, value);
  parallel_for(
      patches.size(), 1,
      [&](std::size_t chart) {
        for (const Texel& texel : of_chart(chart)) patches[chart].know(texel.index);
        for (int ring = 0; ring < gutter; ++ring) patches[chart].spread([](int, int) { return true; });
      },
      control);
  return atlas;
}

vec3 sample(const image::Image& atlas, const vec2& uv) {
  image::require_whole(atlas, "lightmap");
  require(atlas.channels == 3, "lightmap", "an image of three channels is needed");
  const vec2 place = uv * vec2(atlas.width, atlas.height) - 0.5f, low = glm::floor(place), t = place - low;
  const auto fetch = [&](float x, float y) {
    return atlas.rgb(glm::clamp(static_cast<int>(x), 0, atlas.width - 1),
                     glm::clamp(static_cast<int>(y), 0, atlas.height - 1));
  };
  return glm::mix(glm::mix(fetch(low.x, low.y), fetch(low.x + 1, low.y), t.x),
                  glm::mix(fetch(low.x, low.y + 1), fetch(low.x + 1, low.y + 1), t.x), t.y);
}

}  // namespace ssphh::lightmap

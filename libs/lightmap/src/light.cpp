#include <algorithm>
#include <array>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/lightmap/light.h>

#include "fit.h"
#include "flat.h"

namespace ssphh::lightmap {
namespace {

constexpr std::size_t sight_rays = 24;
/// More backs than that, and a place lies within a body: one before a crack between bodies sees fewer.
constexpr float most_backs = 0.3f;
/// More surfaces nearer than a texel than that, and a place lies under another body: where three walls meet
/// there are three quarters.
constexpr float most_near = 0.8f;
/// Rays start so far above their surface, of the world's size.
constexpr float lift = 1e-5f;

/// Other places of a texel than its own, in texels.
constexpr std::array<vec2, 8> nearby = {vec2(0.35f, 0),      vec2(-0.35f, 0),     vec2(0, 0.35f),
                                        vec2(0, -0.35f),     vec2(0.35f, 0.35f),  vec2(-0.35f, 0.35f),
                                        vec2(0.35f, -0.35f), vec2(-0.35f, -0.35f)};

float texel_edge(const Face& face) {
  const float flat = std::abs(cross(face.at[1] - face.at[0], face.at[2] - face.at[0]));
  const float surface =
      glm::length(glm::cross(face.position[1] - face.position[0], face.position[2] - face.position[0]));
  return flat > 0 ? std::sqrt(surface / flat) : 0;
}

/// Whether anybody could see a place from before its surface.
bool is_open(const rays::PosedWorld& world, const vec3& place, const vec3& front, float edge, float gap) {
  const Frame frame = Frame::around(front);
  std::array<rays::RayQuery, sight_rays> rays;
  std::array<rays::RayHit, sight_rays> hits;
  for (std::size_t i = 0; i < sight_rays; ++i) {
    const vec3 direction = spherical_fibonacci(static_cast<int>(i), 2 * sight_rays);
    rays[i] = {place + gap * front, frame.to_world(vec3(direction.x, direction.y, std::abs(direction.z)))};
  }
  world.intersect(rays, hits);
  const auto share = [&](const auto& is) {
    return static_cast<float>(std::ranges::count_if(hits, is)) / static_cast<float>(sight_rays);
  };
  return share([](const rays::RayHit& hit) { return !hit.escaped() && hit.back; }) <= most_backs &&
         share([&](const rays::RayHit& hit) { return hit.distance < edge; }) <= most_near;
}

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

  /// Of those that `takes(x, y)` and that are not known, those beside known ones become their mean. Whether
  /// there were any.
  template <class Takes>
  bool spread(const Takes& takes) {
    Ring ring;
    for (int y = 0; y < size_.y; ++y) {
      for (int x = 0; x < size_.x; ++x) {
        vec3 sum(0);
        float weight = 0;
        if (known_[at(x, y)] || !takes(x, y)) continue;
        for (int v = std::max(0, y - 1); v <= std::min(size_.y - 1, y + 1); ++v) {
          for (int u = std::max(0, x - 1); u <= std::min(size_.x - 1, x + 1); ++u) {
            if (!known_[at(u, v)]) continue;
            const float w = u == x || v == y ? 1 : 0.5f;
            sum += w * atlas_.rgb(low_.x + u, low_.y + v), weight += w;
          }
        }
        if (weight > 0) ring.emplace_back(at(x, y), sum / weight);
      }
    }
    for (const auto& [i, value] : ring) {
      const auto columns = static_cast<std::size_t>(size_.x);
      known_[i] = 1;
      atlas_.set_rgb(low_.x + static_cast<int>(i % columns), low_.y + static_cast<int>(i / columns), value);
    }
    return !ring.empty();
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
  std::size_t inside(std::uint32_t index) const {
    const auto w = static_cast<std::uint32_t>(width_);
    return at(static_cast<int>(index % w) - low_.x, static_cast<int>(index / w) - low_.y);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
  }

 private:
  glm::ivec2 low_, size_;
  int width_;
  image::Image& atlas_;
  std::vector<std::uint8_t> known_;
};

void set(image::Image& atlas, std::uint32_t index, const vec3& value) {
  const auto w = static_cast<std::uint32_t>(atlas.width);
  atlas.set_rgb(static_cast<int>(index % w), static_cast<int>(index / w), value);
}

}  // namespace

Places find_places(const Texels& texels, const rays::PosedWorld& world, const Control& control) {
  const std::size_t count = texels.texels.size();
  for (const Texel& texel : texels.texels)
    require(texel.face < texels.faces.size(), "lightmap texels", "a texel is of no face");
  Places out{std::vector<rays::SurfacePoint>(count), std::vector<std::uint8_t>(count, 0), 0};
  const scene::Bounds& bounds = world.bounds();
  const float gap = lift * (bounds.empty() ? 0 : bounds.radius() + max_component(glm::abs(bounds.center())));
  ProgressStage stage(control, "places of texels", count, "texels");
  parallel_for(
      count, 256,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Texel& texel = texels.texels[i];
          const Face& face = texels.faces[texel.face];
          const float edge = texel_edge(face);
          const auto open = [&](const rays::SurfacePoint& place) {
            return is_open(world, place.position, face.front, edge, gap);
          };
          out.points[i] = place_of(texels, texel);
          if (open(out.points[i])) continue;
          const auto other = std::ranges::find_if(
              nearby, [&](const vec2& step) { return open(place_of(texels, texel, step)); });
          if (other != nearby.end()) {
            out.points[i] = place_of(texels, texel, *other);
          } else {
            out.hidden[i] = 1;
          }
        }
        stage.advance(end - begin);
      },
      control);
  for (const std::uint8_t hidden : out.hidden) out.hidden_count += hidden;
  return out;
}

image::Image light_texels(const Texels& texels, const Places& places, const IrradianceAt& irradiance,
                          const Control& control) {
  require(places.points.size() == texels.texels.size() && places.hidden.size() == texels.texels.size(),
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
  image::Image atlas(texels.width, texels.height);
  ProgressStage stage(control, "light of texels", texels.texels.size(), "texels");
  parallel_for(
      texels.texels.size(), 64,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (!places.hidden[i]) set(atlas, texels.texels[i].index, irradiance(places.points[i]));
        stage.advance(end - begin);
      },
      control);
  parallel_for(
      texels.places.size(), 1,
      [&](std::size_t chart) {
        Patch patch(texels.places[chart], texels.width, atlas);
        std::vector<std::uint8_t> dark(static_cast<std::size_t>(texels.places[chart].count.x + 2 * gutter) *
                                       static_cast<std::size_t>(texels.places[chart].count.y + 2 * gutter));
        const std::size_t begin = texels.first[chart], end = texels.first[chart + 1];
        bool any = false;
        for (std::size_t i = begin; i < end; ++i) any = any || !places.hidden[i];
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t index = texels.texels[i].index;
          // Nobody sees such a chart; if it was taken for one by mistake, its light is not.
          if (!any) set(atlas, index, irradiance(places.points[i]));
          if (!any || !places.hidden[i]) patch.know(index);
          dark[patch.inside(index)] = 1;
        }
        patch.extrapolate(std::span(texels.texels).subspan(begin, end - begin));
        while (patch.spread([&](int x, int y) { return dark[patch.at(x, y)] != 0; })) {
        }
        for (int ring = 0; ring < gutter; ++ring) patch.spread([](int, int) { return true; });
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

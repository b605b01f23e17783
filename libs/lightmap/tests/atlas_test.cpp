// What the atlas gives back, filtered as engines do, against the field that lit it.

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "rooms.h"
#include "thread_count.h"
#include "triangle_source.h"

namespace ssphh::lightmap {
namespace {

const vec3 constant(1, 2, 3);

/// A field with a slope in each direction, different for each colour.
constexpr float slope = 0.7f;
vec3 linear(const vec3& at) {
  return vec3(10) + slope * vec3(at.x + 0.5f * at.y, at.y - at.z, 0.3f * at.x + at.z);
}

scene::Scene furniture() {
  scene::Mesh bar = scene::make_box({-0.2f, -1, -0.3f}, {0.2f, 1, 0.3f});
  return scene_of({scene::make_box({-2, 0, -2}, {2, 3, 2}), scene::make_sphere(0.7f, 24, 12), std::move(bar),
                   scene::make_torus(1, 0.2f, 24, 12)});
}

TEST(Atlas, AConstantFieldIsConstantOnEveryChart) {
  const Unwrapped u(furniture());
  const image::Image atlas = u.atlas([](const rays::SurfacePoint&) { return constant; });
  for (const Face& face : u.texels.faces)
    for (const vec3& share : shares()) {
      const vec3 found = u.looked_up(atlas, face, share);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], constant[c], 1e-5f);
    }
}

/// The greatest error of the atlas, in steps of the field from texel to texel.
float linear_error(const Unwrapped& u, const image::Image& atlas) {
  float worst = 0;
  for (const Face& face : u.texels.faces) {
    for (const vec3& share : shares()) {
      const vec3 error = glm::abs(u.looked_up(atlas, face, share) - linear(point(face.position, share)));
      worst = std::max(worst, max_component(error) * u.layout.density / slope);
    }
  }
  return worst;
}

TEST(Atlas, ALinearFieldIsLinearToATwentiethOfATexelOnRectangles) {
  // Places lie a tenth of a texel inside of the border and are led back to it along the slope; what is left
  // is that the slope is taken where other texels were not led back yet. Inside, the filter is exact.
  const Unwrapped u(scene_of({scene::make_box({-2, 0, -2}, {2, 3, 2})}));
  const image::Image atlas = u.atlas([](const rays::SurfacePoint& at) { return linear(at.position); });
  const float worst = linear_error(u, atlas);
  RecordProperty("worst", fmt::format("{:.4f}", worst));
  EXPECT_LT(worst, 0.05f);
  for (const Face& face : u.texels.faces) {
    const vec3 middle = u.looked_up(atlas, face, vec3(0.2f, 0.3f, 0.5f));
    const vec3 truth = linear(point(face.position, vec3(0.2f, 0.3f, 0.5f)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle[c], truth[c], 1e-4f);
  }
}

TEST(Atlas, ALinearFieldIsLinearToHalfATexelOnAnyShape) {
  // A slanted border's outer texels follow from the nearest point's light. On curved things the field is not
  // linear on the chart, and a texel is up to 1/cos of the charts' cone long.
  const Unwrapped u(furniture());
  const float worst =
      linear_error(u, u.atlas([](const rays::SurfacePoint& at) { return linear(at.position); }));
  RecordProperty("worst", fmt::format("{:.4f}", worst));
  EXPECT_LT(worst, 0.5f);
}

TEST(Atlas, NoFilterReadsATexelOfAnotherChart) {
  const Unwrapped u(furniture(), {.size = 128});
  std::vector<int> owner(static_cast<std::size_t>(u.layout.width) * static_cast<std::size_t>(u.layout.height),
                         -1);
  for (std::size_t c = 0; c + 1 < u.texels.first.size(); ++c)
    for (std::size_t i = u.texels.first[c]; i < u.texels.first[c + 1]; ++i) {
      EXPECT_EQ(owner[u.texels.texels[i].index], -1);
      owner[u.texels.texels[i].index] = static_cast<int>(c);
    }
  std::size_t face = 0, read = 0;
  for (std::size_t c = 0; c < u.charts.charts.size(); ++c) {
    for (std::size_t t = 0; t < u.charts.charts[c].triangles.size(); ++t, ++face) {
      for (const vec3& share : shares()) {
        const std::array<vec2, 3>& at = u.texels.faces[face].at;
        const vec2 place = share.x * at[0] + share.y * at[1] + share.z * at[2] - 0.5f;
        const vec2 low = glm::floor(place), part = place - low;
        for (int k = 0; k < 4; ++k) {
          const float weight = (k & 1 ? part.x : 1 - part.x) * (k & 2 ? part.y : 1 - part.y);
          if (!(weight > 1e-4f)) continue;  // what rounding adds
          const std::size_t x = static_cast<std::size_t>(low.x) + static_cast<std::size_t>(k & 1),
                            y = static_cast<std::size_t>(low.y) + static_cast<std::size_t>(k >> 1);
          ASSERT_EQ(owner[y * static_cast<std::size_t>(u.layout.width) + x], static_cast<int>(c));
          ++read;
        }
      }
    }
  }
  EXPECT_GT(read, 10000u);
}

TEST(Atlas, AGutterOfTwoTexelsHasTheLightOfItsChart) {
  const Unwrapped u(scene_of({scene::make_quad({0, 0, 0}, {2, 0, 0}, {0, 0, -1})}));
  const image::Image atlas = u.atlas([](const rays::SurfacePoint&) { return constant; });
  const PlacedChart& place = u.layout.places[0];
  for (int y = place.first.y - gutter; y < place.first.y + place.count.y + gutter; ++y)
    for (int x = place.first.x - gutter; x < place.first.x + place.count.x + gutter; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(atlas.rgb(x, y)[c], constant[c], 1e-5f) << x << ' ' << y;
}

TEST(Atlas, ChartsOfASmoothSurfaceAgreeAcrossTheirSeams) {
  // Each edge of the sphere between two charts, looked up from both sides at the same places.
  const Unwrapped u(scene_of({scene::make_sphere(1, 48, 24)}), {.size = 512});
  const image::Image atlas = u.atlas(
      [](const rays::SurfacePoint& at) { return vec3(2 + at.normal.y, 2 + at.position.x, 2 - at.normal.z); });
  struct Side {
    const Face* face;
    std::size_t edge;
  };
  std::map<std::array<float, 6>, Side> open;
  const auto key = [](const vec3& a, const vec3& b) { return std::array{a.x, a.y, a.z, b.x, b.y, b.z}; };
  for (const Face& face : u.texels.faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (face.open >> k & 1) open[key(face.position[k], face.position[(k + 1) % 3])] = {&face, k};
  float worst = 0, sum = 0;
  int count = 0;
  for (const auto& [ends, side] : open) {
    const auto other = open.find({ends[3], ends[4], ends[5], ends[0], ends[1], ends[2]});
    ASSERT_NE(other, open.end());
    for (const float t : {0.0f, 0.25f, 0.5f, 0.75f}) {
      vec3 here(0), there(0);
      here[static_cast<int>(side.edge)] = 1 - t, here[static_cast<int>((side.edge + 1) % 3)] = t;
      const std::size_t e = other->second.edge;
      there[static_cast<int>(e)] = t, there[static_cast<int>((e + 1) % 3)] = 1 - t;
      const float step = max_component(
          glm::abs(u.looked_up(atlas, *side.face, here) - u.looked_up(atlas, *other->second.face, there)));
      worst = std::max(worst, step), sum += step, ++count;
    }
  }
  ASSERT_GT(count, 500);
  RecordProperty("worst", fmt::format("{:.3f} texels", worst * u.layout.density));
  RecordProperty("mean", fmt::format("{:.3f} texels", sum / static_cast<float>(count) * u.layout.density));
  // The field's slope is 1 a metre: in texels' worth of it. A texel holds what stands half a diagonal from it
  // at most.
  EXPECT_LT(worst, 0.71f / u.layout.density);
  EXPECT_LT(sum / static_cast<float>(count), 0.05f / u.layout.density);
}

TEST(Atlas, AMirroredInstanceIsLitFromItsFront) {
  const scene::Scene scene = scene_of({scene::make_box({1, 1, 1}, {2, 3, 4})},
                                      mat4({-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}));
  const Unwrapped u(scene);
  ASSERT_EQ(u.charts.charts.size(), 6u);
  const vec3 centre(-1.5f, 2, 2.5f);
  for (const Face& face : u.texels.faces) {
    EXPECT_GT(glm::dot(face.front, face.position[0] - centre), 0);
    for (const vec3& n : face.normal) EXPECT_GT(glm::dot(n, face.front), 0.99f);
  }
  const test::TriangleSource source(scene);
  const Places places = find_places(u.texels, rays::PosedWorld(source, 0));
  EXPECT_EQ(places.hidden_count, 0u);
}

TEST(Atlas, OneOpenTexelLightsItsWholeChart) {
  const Unwrapped u(scene_of({scene::make_quad({0, 0, 0}, {2, 0, 0}, {0, 0, -1})}), {.size = 32});
  const std::size_t count = u.texels.texels.size();
  for (const std::size_t open : {std::size_t{0}, count / 2, count - 1}) {
    Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
    std::ranges::fill(places.hidden, std::uint8_t{1});
    places.hidden[open] = 0;
    const vec3 lit = places.points[open].position;
    const image::Image atlas = light_texels(
        u.texels, places, [&](const rays::SurfacePoint& at) { return vec3(at.position == lit ? 3 : 1000); });
    for (const Texel& texel : u.texels.texels) EXPECT_NEAR(value_of(atlas, texel.index).x, 3, 1e-5f) << open;
  }
}

TEST(Atlas, EachTexelKeepsTheLightOfItsOwnPlace) {
  const Unwrapped u(scene_of({scene::make_quad({0, 0, 0}, {2, 0, 0}, {0, 0, -1})}), {.size = 32});
  const Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
  for (std::size_t i = 0; i < u.texels.texels.size(); ++i) {
    const vec3 lit = places.points[i].position;
    const image::Image atlas = light_texels(
        u.texels, places, [&](const rays::SurfacePoint& at) { return vec3(at.position == lit ? 2 : 1); });
    // A centre outside of the chart is led on along the slope of 1 a texel; where the place before has a
    // part of this light the slope is less.
    const float value = value_of(atlas, u.texels.texels[i].index).x;
    const float way = glm::length(u.texels.texels[i].way);
    EXPECT_GE(value, way > 0 ? 2 : 2 - 1e-5f) << i;
    EXPECT_NEAR(value, 2 + way, 0.1f * way + 1e-5f) << i;
  }
}

TEST(Atlas, PlacesOnASpikeNarrowerThanATexelLieWithinIt) {
  // A square of 10 texels, and on its side a spike of a fiftieth of a texel's breadth: no place has a tenth
  // of a texel to its border, so all lie in the middle, with three tenths of either open edge.
  scene::Mesh mesh;
  mesh.positions = {{0, 0, 0},   {10, 0, 0}, {10, 5, 0},    {10, 5.02f, 0},
                    {10, 10, 0}, {0, 10, 0}, {13, 5.01f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}, {2, 6, 3}};
  const Unwrapped u(scene_of({mesh}), {.density = 1.0f});
  std::size_t on_spike = 0;
  float farthest = 0;
  for (const Texel& texel : u.texels.texels) {
    const Face& face = u.texels.faces[texel.face];
    std::size_t tip = 3;
    for (std::size_t k = 0; k < 3; ++k)
      if (face.position[k].x == 13) tip = k;
    if (tip == 3) continue;
    ++on_spike;
    for (std::size_t k = 0; k < 3; ++k) {
      const float share = texel.share[static_cast<int>(k)];
      if (k == tip) farthest = std::max(farthest, share);
      EXPECT_GE(share, k == tip ? 0 : 0.3f - 1e-5f);
    }
  }
  EXPECT_GT(on_spike, 2u);
  EXPECT_NEAR(farthest, 0.4f, 1e-5f);
}

TEST(Atlas, HasTheSameBitsForAnyNumberOfThreads) {
  const auto bits = [](int threads) {
    const test::Threads limit(threads);
    const scene::Scene scene =
        scene_of({scene::make_box({-2, 0, -2}, {2, 3, 2}), scene::make_sphere(0.7f, 8, 4)});
    const Unwrapped u(scene, {.size = 64});
    const test::TriangleSource source(scene);
    return u.atlas([](const rays::SurfacePoint& at) { return linear(at.position) + at.normal; }, source)
        .pixels;
  };
  EXPECT_EQ(bits(1), bits(3));
}

TEST(Atlas, OfWhatMovesIsThatOfItsPose) {
  scene::Scene scene = scene_of({scene::make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  scene.nodes[0].matrix.reset();
  scene::Animation animation;
  animation.channels.push_back({.node = 0,
                                .path = scene::AnimationPath::translation,
                                .times = {0, 2},
                                .values = {vec4(0), vec4(0, 0, 6, 0)}});
  scene.animations.push_back(animation);
  scene::mark_movable(scene);
  EXPECT_TRUE(make_charts(scene, 0).charts.empty());
  const Charts charts = make_charts(scene, 0, {.moving = true});
  EXPECT_TRUE(charts.notes.empty());
  const Layout layout = lay_out(charts.charts, {.size = 32});
  for (const float time : {0.0f, 1.0f}) {
    const Texels texels = make_texels(scene, time, charts.charts, layout);
    ASSERT_FALSE(texels.texels.empty());
    for (const Texel& texel : texels.texels) {
      const rays::SurfacePoint at = place_of(texels, texel);
      EXPECT_TRUE(at.moves);
      EXPECT_NEAR(at.position.z, 3 * time, 1e-5f);
    }
  }
}

TEST(Atlas, StopsWhenAsked) {
  const Unwrapped u(scene_of({scene::make_box(vec3(0), vec3(1))}), {.size = 64});
  CancelToken stop;
  stop.request();
  const Control control{nullptr, &stop};
  EXPECT_THROW(make_texels(u.scene, 0, u.charts.charts, u.layout, control), Cancelled);
  EXPECT_THROW(find_places(u.texels, rays::PosedWorld(open_space, 0), control), Cancelled);
  const Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
  EXPECT_THROW(light_texels(
                   u.texels, places, [](const rays::SurfacePoint&) { return vec3(1); }, nullptr, control),
               Cancelled);
}

}  // namespace
}  // namespace ssphh::lightmap

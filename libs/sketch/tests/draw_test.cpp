#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/parallel.h>
#include <ssphh/sketch/draw.h>

#include "error_message.h"

namespace ssphh::sketch {
namespace {

constexpr int size = 64;
constexpr float half_tangent = 0.5f;  // of the view from the origin along −z

/// Pinhole at the origin that looks along −z.
Eye pinhole() {
  return {[](float x, float y) -> Ray {
    const vec3 d{half_tangent * (2 * x / size - 1), half_tangent * (1 - 2 * y / size), -1};
    return {vec3(0), glm::normalize(d)};
  }};
}

/// Parallel rays along −z, a metre across.
Eye parallel() {
  return {[](float x, float y) -> Ray { return {{x / size - 0.5f, 0.5f - y / size, 5}, {0, 0, -1}}; }};
}

vec2 pixel_of(const vec3& p) {
  return {(p.x / (-p.z * half_tangent) + 1) * size / 2, (1 - p.y / (-p.z * half_tangent)) * size / 2};
}

image::Image drawn(const Sketch& sketch, const Eye& eye, const DrawParams& params = {}) {
  image::Image picture(size, size);
  draw(picture, sketch, eye, params);
  return picture;
}

/// Sum of the red of all pixels.
float sum(const image::Image& picture) {
  float total = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) total += picture.rgb(x, y).x;
  return total;
}

float distance_to_segment(const vec2& p, const vec2& a, const vec2& b) {
  const vec2 d = b - a;
  return glm::length(p - a - glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0f, 1.0f) * d);
}

TEST(Draw, ALineCoversThePixelsOfItsProjection) {
  const vec3 a{-0.8f, -0.5f, -2}, b{1.5f, 0.9f, -4};
  const image::Image picture = drawn({.lines = {{a, b, vec3(1), 3}}}, pinhole());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const vec2 at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
      const float off = distance_to_segment(at, pixel_of(a), pixel_of(b));
      const float red = picture.rgb(x, y).x;
      // Half a pixel's diagonal about the edge, 1.5 pixels off; angles and pixels differ by a tenth out
      // there.
      if (off < 0.6f) {
        EXPECT_EQ(red, 1) << x << ' ' << y;
      }
      if (off > 2.4f) {
        EXPECT_EQ(red, 0) << x << ' ' << y;
      }
    }
  }
  const float length = glm::length(pixel_of(b) - pixel_of(a));
  EXPECT_NEAR(sum(picture), 3 * length, 0.1f * 3 * length);
}

TEST(Draw, ALineThatPassesTheEyeIsDrawnAsFarAsItLiesBefore) {
  const image::Image picture = drawn({.lines = {{{0.3f, 0.2f, -1}, {0.3f, 0.2f, 5}, vec3(1), 3}}}, pinhole());
  const vec2 at = pixel_of({0.3f, 0.2f, -0.8f});
  EXPECT_EQ(picture.rgb(static_cast<int>(at.x), static_cast<int>(at.y)).x, 1);
  EXPECT_EQ(picture.rgb(size - 1 - static_cast<int>(at.x), size - 1 - static_cast<int>(at.y)).x, 0);
}

TEST(Draw, ALineOfParallelRaysHasItsWidth) {
  const image::Image picture =
      drawn({.lines = {{{-0.5f, 0.0f, 0}, {0.5f, 0.0f, 0}, vec3(1), 4}}}, parallel());
  for (int y = 0; y < size; ++y)
    EXPECT_EQ(picture.rgb(size / 2, y).x, y >= size / 2 - 2 && y < size / 2 + 2 ? 1 : 0) << y;
}

/// Of lines down the picture: a fifth of a pixel wide anywhere within one, and so wide that their middle lies
/// tiles before their rim.
TEST(Draw, ALineHasItsWidthWhereverItLies) {
  struct Case {
    float at, width;  // pixels
  };
  for (const auto& [at, width] :
       {Case{28.1f, 0.2f}, {28.9f, 0.2f}, {31.6f, 1}, {34.4f, 21}, {-170, 400}, {234, 400}}) {
    const float x = at / size - 0.5f;
    const image::Image picture =
        drawn({.lines = {{{x, -0.5f, 0}, {x, 0.5f, 0}, vec3(1), width}}}, parallel(), {.samples = 10});
    float row = 0;
    for (int i = 0; i < size; ++i) row += picture.rgb(i, 20).x;
    const float from = std::max(0.0f, at - width / 2), to = std::min(float{size}, at + width / 2);
    EXPECT_NEAR(row, to - from, 0.11f) << "at " << at << ": samples are a tenth of a pixel apart";
  }
}

/// Pixels are of other angles in other places: rays that turn three times as far per pixel at the right as at
/// the left of the picture, whatever their height.
TEST(Draw, ALineHasItsWidthWherePixelsAreOfOtherAngles) {
  const auto angle_at = [](float x) { return 0.001f * x + 0.00005f * x * x; };
  const Eye eye{[&](float x, float y) -> Ray {
    const float turn = angle_at(x), up = 0.001f * (0.5f * size - y);
    return {vec3(0), glm::normalize(vec3(std::sin(turn), up, -std::cos(turn)))};
  }};
  for (const float at : {8.5f, 50.5f}) {
    const float turn = angle_at(at);
    const vec3 middle(std::sin(turn), 0, -std::cos(turn));
    const image::Image picture = drawn(
        {.lines = {{middle - vec3(0, 1, 0), middle + vec3(0, 1, 0), vec3(1), 6}}}, eye, {.samples = 10});
    for (const int y : {4, 60}) {
      float row = 0;
      for (int x = 0; x < size; ++x) row += picture.rgb(x, y).x;
      EXPECT_NEAR(row, 6, 0.5f) << "at " << at << ", row " << y;
    }
  }
}

TEST(Draw, ABallIsARoundDisc) {
  const float radius = 0.25f;
  const image::Image picture = drawn({.balls = {{vec3(0), radius, vec3(1)}}}, parallel());
  const image::Image covered = drawn({.discs = {{vec3(0), {0, 0, 1}, radius, vec3(1)}}}, parallel());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float off = glm::length(vec2(x + 0.5f, y + 0.5f) - vec2(size / 2)) / size;
      for (const image::Image* shown : {&picture, &covered}) {
        if (off < radius - 1.0f / size) {
          EXPECT_GE(shown->rgb(x, y).x, 0.24f);
        }
        if (off > radius + 1.0f / size) {
          EXPECT_EQ(shown->rgb(x, y).x, 0);
        }
      }
    }
  }
}

TEST(Draw, WhatSurfacesHideIsDimmed) {
  Eye eye = parallel();
  eye.surfaces = [](std::span<const Ray> rays, std::span<float> distances) {
    for (std::size_t i = 0; i < rays.size(); ++i) distances[i] = rays[i].origin.x < 0 ? 4 : 6;  // z = 1, −1
  };
  const image::Image picture =
      drawn({.lines = {{{-0.5f, 0, 0}, {0.5f, 0, 0}, vec3(1), 4}}}, eye, {.hidden = 0.25f});
  EXPECT_FLOAT_EQ(picture.rgb(4, size / 2).x, 0.25f);
  EXPECT_FLOAT_EQ(picture.rgb(size - 4, size / 2).x, 1);
}

TEST(Draw, ADiscOnASurfaceIsNotHiddenByIt) {
  Eye eye = pinhole();
  const vec3 normal = glm::normalize(vec3(0, 1, 0.05f)), at{0, -0.3f, -3};
  eye.surfaces = [=](std::span<const Ray> rays, std::span<float> distances) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      distances[i] = glm::dot(at, normal) / glm::dot(rays[i].direction, normal);
  };
  const Sketch sketch{.discs = {{at, normal, 0.8f, vec3(1)}}};
  EXPECT_EQ(drawn(sketch, eye).pixels, drawn(sketch, pinhole()).pixels);
}

TEST(Draw, TheNearestMarkIsSeen) {
  const Sketch sketch{.boxes = {{{-0.1f, -0.1f, 1},
                                 {0.1f, 0.1f, 2},
                                 {vec3(0), vec3(0), vec3(0), vec3(0), vec3(0, 1, 0), vec3(0)}}},
                      .balls = {{vec3(0), 0.25f, {1, 0, 0}}}};
  const image::Image picture = drawn(sketch, parallel());
  EXPECT_EQ(picture.rgb(size / 2, size / 2), vec3(0, 1, 0));
  EXPECT_GT(picture.rgb(size / 2 + 10, size / 2).x, 0.5f);
}

TEST(Draw, LightKeepsItsRadianceAndColoursThePicturesWhite) {
  sh::RadianceSh light(1);
  light[0] = vec3(3 * std::sqrt(4 * pi));
  const Sketch sketch{.discs = {{{-0.25f, 0, 0}, {0, 0, 1}, 0.2f, vec3(0.5f)}},
                      .balls = {{{0.25f, 0, 0}, 0.2f, vec3(1), light}}};
  const image::Image picture = drawn(sketch, parallel(), {.white = 8});
  EXPECT_NEAR(picture.rgb(size / 4, size / 2).x, 4, 1e-5f);
  EXPECT_NEAR(picture.rgb(3 * size / 4, size / 2).x, 3, 1e-5f);
}

TEST(Draw, ALobeReachesItsValueAndIsColouredBySign) {
  // Y_10 = 0.488603 z, seen along −y of a frame turned so that z is up in the picture.
  Eye eye{[](float x, float y) -> Ray { return {{x / size - 0.5f, 5, 0.5f - y / size}, {0, -1, 0}}; }};
  Lobe lobe{.values = {0, 0, 1, 0}, .positive = {0, 0, 1}, .negative = {1, 0, 0}};
  lobe.scale = 0.4f / 0.488603f;
  EXPECT_NEAR(largest_values({{lobe}})[0], 0.488603f, 1e-5f);
  image::Image picture = drawn({.lobes = {lobe}}, eye);
  // Balls of radius 0.2 about z = ±0.2: r = 0.4 cos θ.
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const vec2 at = (vec2(x + 0.5f, y + 0.5f) - vec2(size / 2)) / static_cast<float>(size);
      const bool top = y < size / 2;
      const float off = glm::length(at - vec2(0, top ? -0.2f : 0.2f));
      const vec3 color = picture.rgb(x, y);
      if (off > 0.2f + 1.0f / size) {
        EXPECT_EQ(color, vec3(0)) << x << ' ' << y;
      }
      if (off < 0.2f - 1.5f / size) {
        EXPECT_GT(top ? color.z : color.x, 0.2f) << x << ' ' << y;
      }
      EXPECT_EQ(top ? color.x : color.z, 0) << x << ' ' << y;
      EXPECT_NEAR(color.x + color.z, picture.rgb(size - 1 - x, y).x + picture.rgb(size - 1 - x, y).z, 0.08f);
    }
  }
}

TEST(Draw, TheSameBitsForAnyNumberOfThreads) {
  Sketch sketch;
  for (int i = 0; i < 40; ++i) {
    const auto a = static_cast<float>(i);
    sketch.lines.push_back(
        {{std::sin(a), std::cos(a), -3}, {std::cos(2 * a), std::sin(3 * a), -2}, {1, 0.5f, a / 40}});
  }
  set_thread_count(1);
  const image::Image alone = drawn(sketch, pinhole());
  set_thread_count(0);
  EXPECT_EQ(alone.pixels, drawn(sketch, pinhole()).pixels);
  EXPECT_GT(sum(alone), 100);
}

TEST(Draw, WhatCannotBeDrawnIsRefused) {
  image::Image picture(4, 4), grey(4, 4, 1);
  EXPECT_EQ(test::message_of([&] { draw(grey, {}, pinhole()); }), "sketch: the picture must be RGB");
  EXPECT_EQ(test::message_of([&] { draw(picture, {}, {}); }), "sketch: the eye has no rays");
  EXPECT_EQ(test::message_of([&] { draw(picture, {}, pinhole(), {.samples = 17}); }),
            "sketch: samples must be 1..16");
  EXPECT_EQ(test::message_of([&] {
              draw(picture, {.lobes = {{.values = {1, 2}}}}, pinhole());
            }),
            "lobe: its values are not those of a degree 0..10");
}

}  // namespace
}  // namespace ssphh::sketch

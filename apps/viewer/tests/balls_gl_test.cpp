// The balls' pixels against the analytic ones: where a ray meets a ball, its light in that direction and its
// rim.

#include "balls_gl.h"

#include <algorithm>
#include <cmath>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/sh/reconstruct.h>

#include "gl_context.h"

namespace ssphh::viewer {
namespace {

constexpr int size = 96;
const float angle = 2 * std::atan(0.125f);

class BallsGlTest : public test::WithGl {
 protected:
  void SetUp() override {
    test::WithGl::SetUp();
    if (IsSkipped()) return;
    balls_.emplace();
    color_ = gl::Texture(gl::Format::rgba8, size, size);
    depth_ = gl::Texture(gl::Format::depth32f, size, size);
    const gl::Texture* const colors[] = {&color_};
    target_ = gl::Framebuffer(colors, &depth_);
    // What stands in front of everything in the left third, at two samples a pixel.
    scene_ = gl::Texture(gl::Format::r32f, 2 * size, 2 * size);
    look_.view = look_at({0, 0, 12}, {0, 0, 0}, angle);
    look_.radius = 0.5f;
    cover(0);
  }
  /// A surface before the leftmost `columns` columns.
  void cover(int columns) {
    std::vector<float> values(std::size_t{4} * size * size, 0);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (static_cast<int>(i % (2 * size)) < 2 * columns) values[i] = 1;
    scene_.upload(std::as_bytes(std::span(values)));
  }
  void add(const vec3& position, const vec3& constant, const vec3& along_x = vec3(0)) {
    probes::Probe& probe = set_.probes.emplace_back();
    probe.position = position;
    sh::RadianceSh light(1);
    light[0] = constant / 0.28209479f;
    light[3] = along_x / 0.48860251f;
    probe.self = light;
    set_.degree = 1;
  }
  std::vector<std::uint8_t> draw() {
    gl::bind_framebuffer(target_.id(), {0, 0, size, size});
    gl::clear_color(0, 0.2f, 0.4f, 0.6f, 1);
    balls_->update(set_, Ball::self);
    // Reversed depth: 1 at the near plane, 0.1 m away, 0 far away. The picture's edges are an eighth of
    // its distance away.
    mat4 projection(0);
    projection[0][0] = projection[1][1] = 8, projection[2][3] = -1, projection[3][2] = 0.1f;
    const mat4 to_view = glm::inverse(pose_of(look_.view).world);
    balls_->draw(set_, look_, {scene_, projection * to_view}, target_.id(), size, size);
    gl().throw_on_error("balls");
    return gl::read_pixels(target_.id(), {0, 0, size, size});
  }

  struct Expected {
    vec3 color{0.2f, 0.4f, 0.6f};
    bool sure = true;  ///< the ball's edge is farther away than a pixel
  };
  /// Ball `i` of this radius, as the pixel shows it.
  Expected pixel(std::size_t i, float radius, int x, int y, bool selected, float alpha) const {
    const vec2 point((static_cast<float>(x) + 0.5f) / size, 1 - (static_cast<float>(y) + 0.5f) / size);
    const rays::RayQuery ray = pixel_ray(look_.view, point, 1);
    const vec3 to = set_.probes[i].position - ray.origin;
    const float along = glm::dot(to, ray.direction), off = glm::dot(to, to) - along * along;
    Expected out;
    out.sure = std::abs(std::sqrt(off) - radius) > 1.5f * along * 0.25f / size;
    if (off >= radius * radius) return out;
    const vec3 hit = ray.origin + (along - std::sqrt(radius * radius - off)) * ray.direction;
    const vec3 n = glm::normalize(hit - set_.probes[i].position);
    const vec3 light = glm::max(sh::eval(set_.probes[i].self, n), vec3(0)) * std::exp2(look_.tone.exposure);
    vec3 shown;
    for (int c = 0; c < 3; ++c) {
      float v = light[c];
      if (look_.tone.curve == image::ToneCurve::filmic)
        v = v * (2.51f * v + 0.03f) / (v * (2.43f * v + 0.59f) + 0.14f);
      v = std::clamp(v, 0.0f, 1.0f);
      shown[c] = look_.tone.gamma > 0 ? std::pow(v, 1 / look_.tone.gamma)
                 : v < 0.0031308f     ? 12.92f * v
                                      : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    }
    const float facing = std::abs(glm::dot(n, ray.direction));
    const float t = std::clamp((facing - 0.15f) / ((selected ? 0.6f : 0.4f) - 0.15f), 0.0f, 1.0f);
    const vec3 rim = selected ? vec3(1, 0.75f, 0.3f) : vec3(0.08f);
    out.color = glm::mix(out.color, glm::mix(rim, shown, t * t * (3 - 2 * t)), alpha);
    return out;
  }
  /// The picture has one ball; left of `covered` it is faint.
  void expect_ball(float radius, bool selected = false, int covered = 0) {
    const std::vector<std::uint8_t> got = draw();
    int compared = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float alpha = x >= covered ? 1 : selected ? 0.5f : 0.12f;
        const Expected wanted = pixel(0, radius, x, y, selected, alpha);
        if (!wanted.sure) continue;
        ++compared;
        for (int c = 0; c < 3; ++c)
          // A step of the 8 bits, and what the mesh's corners cut off: 1 − cos(3°) of the light and of the
          // rim's place.
          ASSERT_NEAR(got[4 * (y * size + x) + c], 255 * wanted.color[c], 7) << x << ' ' << y;
      }
    }
    EXPECT_GT(compared, size * size * 3 / 4);
  }

  probes::ProbeSet set_;
  BallsGl::Look look_;
  std::optional<BallsGl> balls_;
  gl::Texture color_, depth_, scene_;
  gl::Framebuffer target_;
};

TEST_F(BallsGlTest, EachPixelIsTheBallsLightIntoItsDirection) {
  add({0.1f, -0.05f, 0}, {0.4f, 0.3f, 0.2f}, {0.3f, -0.2f, 0.1f});
  expect_ball(0.5f);
  look_.radius = 0.3f;
  expect_ball(0.3f);
  look_.radius = 0.5f;
  look_.tone.exposure = 1;
  expect_ball(0.5f);
  look_.tone.curve = image::ToneCurve::filmic;
  look_.tone.gamma = 2;
  expect_ball(0.5f);
  look_.tone = {};
  // Chosen, it is a quarter larger and has a bright rim; what a surface hides is faint.
  look_.selected = 0;
  expect_ball(0.625f, true);
  cover(size / 2 + 5);
  expect_ball(0.625f, true, size / 2 + 5);
  look_.selected = -1;
  expect_ball(0.5f, false, size / 2 + 5);
  cover(0);
  // Another place of the eye
  look_.view = look_at({3.4f, 2, 10}, {0.2f, 0, 0}, angle);
  expect_ball(0.5f);
  // Light of one brightness all around: lobes reach 1.75 of the radius; without light in a direction a
  // quarter.
  look_.view = look_at({0, 0, 12}, {0, 0, 0}, angle);
  set_.probes.clear();
  add({0, 0, 0}, vec3(0.5f));
  look_.lobes = true;
  look_.radius = 0.3f;
  expect_ball(0.525f);
  set_.probes.clear();
  add({0, 0, 0}, vec3(0.25f), vec3(0.25f));
  const std::vector<std::uint8_t> lobe = draw();
  const auto covered = [&](float x) {  // in the plane of the middle
    const int column = static_cast<int>(size * (0.5f + x / 3));
    return std::abs(lobe[4 * (size / 2 * size + column) + 2] - 153) > 10;
  };
  EXPECT_TRUE(covered(0.3f * 1.6f) && covered(-0.3f * 0.2f));
  EXPECT_FALSE(covered(0.3f * 2.0f) || covered(-0.3f * 0.4f));
}

TEST_F(BallsGlTest, OneBesideTheEyeHidesNoPicture) {
  add({0, 0, 0}, {0.4f, 0.3f, 0.2f}, {0.3f, -0.2f, 0.1f});
  look_.view = look_at({0, 0, 3}, {0, 0, 0}, angle);
  const std::vector<std::uint8_t> near_one = draw();
  look_.radius = 10;
  EXPECT_EQ(draw(), near_one);
  look_.radius = 0.2f;
  EXPECT_NE(draw(), near_one);
  EXPECT_FLOAT_EQ(seen_ball_size(0.5f, look_.view, {0, 0, 0}), 0.3f);
  EXPECT_FLOAT_EQ(seen_ball_size(0.5f, look_.view, {0, 0, -7}), 0.5f) << "farther away it has its size";
  look_.view.orthographic = true;
  EXPECT_EQ(seen_ball_size(0.5f, look_.view, {0, 0, 0}), 0.5f) << "there is no near and far";
}

TEST_F(BallsGlTest, TheNearerBallHidesTheOther) {
  for (const bool swapped : {false, true}) {
    set_.probes.clear();
    add({0, 0, swapped ? -0.5f : 0.5f}, swapped ? vec3(0, 0.5f, 0) : vec3(0.5f, 0, 0));
    add({0, 0, swapped ? 0.5f : -0.5f}, swapped ? vec3(0.5f, 0, 0) : vec3(0, 0.5f, 0));
    look_.radius = 0.3f;
    const std::vector<std::uint8_t> got = draw();
    const std::size_t middle = 4 * (size / 2 * size + size / 2);
    EXPECT_NEAR(got[middle], 188, 1);
    EXPECT_EQ(got[middle + 1], 0);
    cover(size);
    const std::vector<std::uint8_t> faint = draw();
    EXPECT_NEAR(faint[middle], 0.12f * 188 + 0.88f * 51, 25) << "or the farther, before it, once more";
    cover(0);
  }
  // A set without probes, or whose light was never brought, draws nothing.
  set_.probes.clear();
  EXPECT_EQ(draw()[0], 51);
}

}  // namespace
}  // namespace ssphh::viewer

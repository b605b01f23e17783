#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/rays/posed_world.h>

#include "points_in_reach.h"

namespace ssphh::methods::ambient {
namespace {

/// The same irradiance everywhere.
class Constant final : public rays::IndirectLight {
 public:
  vec3 value{0};
  vec3 irradiance(const rays::SurfacePoint&) const override { return value; }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return value / pi; }
};

/// The ambient term of radiosity (Cohen, Chen, Wallace & Greenberg, A Progressive Refinement Approach to Fast
/// Radiosity Image Generation, 1988, eq. 9-11), by sampling. Over points uniform by area, with E the mean
/// direct irradiance and E₁ the mean irradiance after one bounce, further bounces are taken to shrink light
/// by the same factor r = E₁/E: the ambient irradiance is E·r/(1 − r).
class Ambient final : public Method {
 public:
  Ambient(const MethodScene& scene, int points, float factor)
      : scene_(scene), points_(points), factor_(factor) {}

  void update(const scene::LightingState& state, const Control& control) override {
    const std::vector<rays::SurfacePoint> points = points_in_reach(scene_, state.time, points_, control);

    // One cosine ray from each point: the radiosity of what it meets is the irradiance that it brings.
    const rays::PosedWorld surfaces(scene_.source, state.time);
    const float lift = 1e-4f * surfaces.bounds().radius();
    std::vector<rays::RayQuery> rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Pcg32 random(1, i);
      rays.push_back({points[i].position + lift * points[i].normal,
                      Frame::around(points[i].normal).to_world(sample_cosine_hemisphere(random.uniform2()))});
    }
    std::vector<rays::RayHit> hits(rays.size());
    surfaces.intersect(rays, hits);
    std::vector<rays::SurfacePoint> met;
    std::vector<vec3> albedo;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].escaped() || hits[i].back) continue;
      met.push_back({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal});
      albedo.push_back(hits[i].through * hits[i].albedo);
    }

    vec3 direct(0), bounced(0);
    const auto lights =
        scene_.source.direct_light(state.lights, part_poses(scene_.source, state.time), state.environment());
    for (const vec3& e : scaled_direct(*lights, state.group_scales, points)) direct += e;
    const std::vector<vec3> at_met = scaled_direct(*lights, state.group_scales, met);
    for (std::size_t i = 0; i < met.size(); ++i) bounced += albedo[i] * at_met[i];
    const auto count = static_cast<float>(points.size());
    direct /= count, bounced /= count;
    for (int c = 0; c < 3; ++c) {
      constexpr float most = 0.98f;  // of light kept by a bounce
      const float kept = direct[c] > 0 ? std::min(bounced[c] / direct[c], most) : 0;
      light_.value[c] = factor_ * bounced[c] / (1 - kept);
    }
  }

  const rays::IndirectLight& light() const override { return light_; }
  MethodMemory memory() const override { return {sizeof light_.value, 0}; }
  MethodNumbers numbers() const override {
    return {{"red", light_.value.r}, {"green", light_.value.g}, {"blue", light_.value.b}};
  }

 private:
  MethodScene scene_;
  int points_;
  float factor_;
  Constant light_;
};

}  // namespace

MethodEntry entry() {
  return {"ambient",
          "one constant for the whole scene, the ambient term of radiosity",
          {{"points", 4096, 16, 1 << 22, "surface points that are sampled", true},
           {"factor", 1, 0, 1e3, "multiplies the constant"}},
          [](const MethodScene& scene, const MethodParameters& p, const Control&) -> std::unique_ptr<Method> {
            return std::make_unique<Ambient>(scene, p.integer("points"),
                                             static_cast<float>(p.number("factor")));
          }};
}

}  // namespace ssphh::methods::ambient

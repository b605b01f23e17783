// A method of one's own: what the lamps send out, spread evenly over the sides of the scene's bounds.

#include <ssphh/methods/method_list.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::methods::even {
namespace {

class Constant final : public rays::IndirectLight {
 public:
  float value = 0;
  vec3 irradiance(const rays::SurfacePoint&) const override { return vec3(value); }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return vec3(value / pi); }
};

class Even final : public Method {
 public:
  Even(const MethodScene& scene, float share) : scene_(scene), share_(share) {}

  void update(const scene::LightingState& state, const Control&) override {
    const auto lights =
        scene_.source.direct_light(state.lights, part_poses(scene_.source, state.time), state.environment());
    float flux = 0;
    for (std::size_t g = 0; g < state.group_scales.size(); ++g)
      flux += luminance(state.group_scales[g]) * lights->flux(static_cast<int>(g));
    const scene::Bounds bounds = rays::PosedWorld(scene_.source, state.time).bounds();
    const vec3 size = bounds.max - bounds.min;
    light_.value = share_ * flux / (2 * (size.x * size.y + size.y * size.z + size.z * size.x));
  }

  const rays::IndirectLight& light() const override { return light_; }
  MethodMemory memory() const override { return {sizeof light_.value, 0}; }

 private:
  MethodScene scene_;
  float share_;
  Constant light_;
};

}  // namespace

MethodEntry entry() {
  return {"even",
          "the lamps' light spread evenly: an example",
          {{"share", 0.5, 0, 1e3, "of the light that is found again"}},
          [](const MethodScene& scene, const MethodParameters& p, const Control&) -> std::unique_ptr<Method> {
            return std::make_unique<Even>(scene, static_cast<float>(p.number("share")));
          }};
}

}  // namespace ssphh::methods::even

#include <ssphh/methods/method_list.h>

namespace ssphh::methods::direct {
namespace {

class Dark final : public rays::IndirectLight {
 public:
  vec3 irradiance(const rays::SurfacePoint&) const override { return vec3(0); }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return vec3(0); }
};

class Direct final : public Method {
 public:
  void update(const scene::LightingState&, const Control&) override {}
  const rays::IndirectLight& light() const override { return light_; }
  MethodMemory memory() const override { return {}; }

 private:
  Dark light_;
};

}  // namespace

MethodEntry entry() {
  return {"direct",
          "no indirect light at all: what every other method has to win",
          {},
          [](const MethodScene&, const MethodParameters&, const Control&) -> std::unique_ptr<Method> {
            return std::make_unique<Direct>();
          }};
}

}  // namespace ssphh::methods::direct

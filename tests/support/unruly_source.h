#pragma once
/// Sources of light that break their promises on demand: plug-ins as a host may write them.

#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::test {

/// A room with a lamp and a door that turns.
inline const scene::Scene& door_scene() {
  static const scene::Scene scene = scene::make_builtin("two-rooms");
  return scene;
}

/// Passes everything on to a sound source, but for what the test spoils.
class UnrulySource : public rays::TransportSource {
 public:
  explicit UnrulySource(const scene::Scene& scene) : sound_(scene) {}

  int fails_after = -1;    ///< so many calls of direct_light, part_pose or occluded succeed; −1: all
  int strayed_group = -2;  ///< said to be every light's and the environment's; −2: the sound source's
  bool gives_direct_light = true;
  bool dazzles = false;  ///< direct light is no number

  /// Of those calls, so far.
  int calls() const { return calls_; }
  void count_anew() { calls_ = 0; }

  int part_count() const override { return sound_.part_count(); }
  const std::string& part_name(int part) const override { return sound_.part_name(part); }
  scene::Bounds part_bounds(int part) const override { return sound_.part_bounds(part); }
  float duration() const override { return sound_.duration(); }
  mat4 part_pose(int part, float time) const override {
    tire();
    return sound_.part_pose(part, time);
  }
  std::vector<rays::PartPoint> sample_part(int part, double density) const override {
    return sound_.sample_part(part, density);
  }
  void intersect(int part, std::span<const rays::RayQuery> rays,
                 std::span<rays::RayHit> hits) const override {
    sound_.intersect(part, rays, hits);
  }
  void occluded(int part, std::span<const rays::RayQuery> rays,
                std::span<std::uint8_t> blocked) const override {
    tire();
    sound_.occluded(part, rays, blocked);
  }
  const std::vector<std::string>& light_groups() const override { return sound_.light_groups(); }
  std::vector<scene::LightState> lights(float time) const override { return sound_.lights(time); }
  const std::vector<std::string>& light_names() const override { return sound_.light_names(); }
  int light_group_of(int light) const override {
    return strayed_group == -2 ? sound_.light_group_of(light) : strayed_group;
  }
  bool group_emits_from(int group, int part) const override { return sound_.group_emits_from(group, part); }
  int environment_group() const override { return sound_.environment_group(); }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState> lights,
                                                  std::span<const mat4> poses,
                                                  const scene::EnvironmentState& environment) const override {
    tire();
    if (!gives_direct_light) return nullptr;
    auto light = sound_.direct_light(lights, poses, environment);
    if (dazzles) return std::make_unique<Dazzling>(std::move(light));
    return light;
  }
  std::uint64_t rays_traced() const override { return sound_.rays_traced(); }

 private:
  struct Dazzling : rays::DirectLight {
    explicit Dazzling(std::unique_ptr<rays::DirectLight> light) : sound(std::move(light)) {}
    void irradiance(int group, std::span<const rays::SurfacePoint> points,
                    std::span<vec3> out) const override {
      sound->irradiance(group, points, out);
      if (!out.empty()) out.back().y = std::numeric_limits<float>::quiet_NaN();
    }
    bool may_shadow(int group, const rays::SurfacePoint& p, const scene::Bounds& box) const override {
      return sound->may_shadow(group, p, box);
    }
    vec3 emitted(int group, const rays::RayQuery& ray, float distance) const override {
      return sound->emitted(group, ray, distance);
    }
    std::unique_ptr<rays::DirectLight> sound;
  };

  void tire() const {
    if (calls_++ >= fails_after && fails_after >= 0) throw std::runtime_error("the host's device is lost");
  }

  trace::TransportScene sound_;
  mutable std::atomic<int> calls_ = 0;
};

}  // namespace ssphh::test

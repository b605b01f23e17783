#include <optional>

#include <ssphh/methods/method_list.h>

#include "drawing.h"
#include "field.h"
#include "points_in_reach.h"

namespace ssphh::methods::vpl {
namespace {

/// Instant radiosity: libs/methods/vpl/README.md.
class Vpls final : public Method {
 public:
  Vpls(const MethodScene& scene, const MethodParameters& p)
      : scene_(scene),
        photons_{p.integer("photons"), p.integer("depth"), static_cast<std::uint64_t>(p.integer("seed"))},
        kind_(p.choice<VplKind>("kind")),
        clamp_(static_cast<float>(p.number("clamp"))),
        radius_(static_cast<float>(p.number("radius"))),
        cluster_error_(static_cast<float>(p.number("cluster_error"))),
        check_points_(p.integer("check_points")) {}

  void update(const scene::LightingState& state, const Control& control) override {
    if (field_ && state == state_) return;
    state_ = state;
    field_.reset();
    surfaces_.emplace(scene_.source, state.time);
    const auto lights =
        scene_.source.direct_light(state.lights, part_poses(scene_.source, state.time), state.environment());
    std::vector<Vpl> vpls = trace_photons(*lights, state.group_scales, *surfaces_, photons_, control);
    VplParams params;
    params.kind = kind_;
    params.least_distance = clamp_ * surfaces_->bounds().radius();
    if (kind_ == VplKind::sphere) set_radii(vpls, radius_);
    field_.emplace(std::move(vpls), *surfaces_, params, cluster_error_);

    if (check_points_ > 0) {
      const std::vector<rays::SurfacePoint> points =
          points_in_reach(scene_, state.time, check_points_, control);
      lost_energy_ = field_->lost_energy(points);
      mean_cut_ = field_->mean_cut(points);
    }
  }

  const rays::IndirectLight& light() const override { return *field_; }
  LightData light_data() const override { return VirtualLights{field_->lights(), field_->params()}; }

  sketch::Sketch drawing(Drawing what) const override {
    constexpr float share_of_scene = 7e-3f;
    if (what != Drawing::photons) return {};
    return photons_drawing(field_->lights(), share_of_scene * surfaces_->bounds().radius());
  }

  MethodMemory memory() const override { return {field_->bytes(), 0}; }

  MethodNumbers numbers() const override {
    MethodNumbers numbers = {{"photons", photons_.photons},
                             {"vpls", static_cast<double>(field_->lights().size())}};
    if (check_points_ > 0) {
      numbers.emplace_back("lost_energy", lost_energy_);
      numbers.emplace_back("lights_per_point", mean_cut_);
    }
    return numbers;
  }

 private:
  MethodScene scene_;
  PhotonParams photons_;
  VplKind kind_;
  float clamp_, radius_, cluster_error_;
  int check_points_;
  scene::LightingState state_;
  std::optional<rays::PosedWorld> surfaces_;
  std::optional<VplField> field_;
  double lost_energy_ = 0, mean_cut_ = 0;
};

}  // namespace

MethodEntry entry() {
  return {"vpl",
          "instant radiosity: photons leave virtual point lights, every lit point asks all of them",
          {{"photons", 512, 1, 1 << 20, "that leave the lights; most make more than one virtual light", true},
           {"depth", 25, 2, 1000, "scattering events of a path", true},
           choice_parameter("kind", VplKind::point, "of the virtual lights"),
           {"clamp", 0.05, 0, 10,
            "points count for no more than straight ahead at this share of the scene's radius; 0: unbounded"},
           {"radius", 1, 0.01, 100, "of spheres, in distances to the eighth neighbour"},
           {"cluster_error", 0, 0, 1, "share of the light that a cluster may err by (lightcuts); 0: none"},
           {"check_points", 256, 0, 1 << 16, "surface points at which lost_energy is measured; 0: it is not",
            true},
           {"seed", 0, 0, 1e9, "of the photons", true}},
          [](const MethodScene& scene, const MethodParameters& p, const Control&) -> std::unique_ptr<Method> {
            return std::make_unique<Vpls>(scene, p);
          },
          true,
          {Drawing::photons}};
}

}  // namespace ssphh::methods::vpl

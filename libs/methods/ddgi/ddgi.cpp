#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/methods/method_list.h>

#include "blend.h"
#include "reach.h"
#include "relocate.h"

namespace ssphh::methods::ddgi {
namespace {

constexpr int most_probes = 1 << 18;
constexpr double most_rays = 1 << 27;  // of a frame: two gigabytes

/// Dynamic diffuse global illumination (Majercik, Guertin, Nowrouzezahrai & McGuire, JCGT 2019; Majercik,
/// Marrs, Spjut & McGuire, JCGT 2021): libs/methods/ddgi/README.md.
class Ddgi final : public Method {
 public:
  Ddgi(const MethodScene& scene, const MethodParameters& p, const Control& control)
      : source_(scene.source),
        rays_(p.integer("rays")),
        warmup_(p.integer("warmup")),
        relocates_(p.flag("relocate")),
        seed_(static_cast<std::uint64_t>(p.integer("seed"))),
        field_(grid_in_reach(scene, static_cast<float>(p.number("spacing")), p.integer("probes"), most_probes,
                             control)),
        fresh_(field_.active.size(), 1) {
    if (static_cast<double>(field_.grid.size()) * rays_ > most_rays) {
      throw Error("method ddgi",
                  fmt::format("{} probes with {} rays each are too many", field_.grid.size(), rays_),
                  "ask for fewer of either");
    }
    field_.bias = static_cast<float>(p.number("bias"));
    field_.visibility = p.flag("visibility");
    blend_.hysteresis = static_cast<float>(p.number("hysteresis"));
    blend_.change = static_cast<float>(p.number("change"));
    blend_.gamma = static_cast<float>(p.number("gamma"));
  }

  void update(const scene::LightingState& state, const Control& control) override {
    const bool first = !surfaces_;
    const std::vector<mat4> poses = part_poses(source_, state.time);
    relocation_rays_ = 0;
    if (first || poses != poses_) {
      surfaces_.emplace(source_, state.time);
      poses_ = poses;
      const std::size_t rays = relocate(field_, *surfaces_, first ? 16 : 2, relocates_, fresh_);
      if (!first) relocation_rays_ = rays;
    }
    const auto lights = source_.direct_light(state.lights, poses, state.environment());
    const int frames = first ? warmup_ : 1;
    ProgressStage progress({frames > 1 ? control.progress : nullptr, nullptr}, "warm-up",
                           static_cast<std::uint64_t>(frames), "frames");
    for (int i = 0; i < frames; ++i) {
      DdgiBlend blend = blend_;
      if (frames > 1) {
        // First let light bounce, then average: what stays from the start would be too dark for long.
        const int half = frames / 2;
        const float mean = 1 - 1 / static_cast<float>(std::max(i - half, 0) + 2);
        blend.hysteresis = std::min(blend.hysteresis, mean);
        blend.change = 0;
      }
      frame(*lights, state.group_scales, blend, control);
      progress.advance(1);
    }
  }

  const rays::IndirectLight& light() const override { return light_; }

  MethodMemory memory() const override {
    return {field_.bytes(), active() * static_cast<std::size_t>(rays_) * sizeof(ProbeRay) + fresh_.size()};
  }

  MethodNumbers numbers() const override {
    return {{"probes", static_cast<double>(field_.grid.size())},
            {"active", static_cast<double>(active())},
            {"spacing", static_cast<double>(field_.grid.least_spacing())},
            {"rays_per_frame", static_cast<double>(rays_of_frame_)},
            {"frames", static_cast<double>(frames_)}};
  }

 private:
  std::size_t active() const { return static_cast<std::size_t>(std::ranges::count(field_.active, 1)); }

  void frame(const rays::DirectLight& lights, std::span<const vec3> group_scales, const DdgiBlend& blend,
             const Control& control) {
    const std::vector<vec3> directions = ray_directions(rays_, seed_, frames_++);
    const std::vector<ProbeRay> rays =
        trace_probes(field_, *surfaces_, lights, group_scales, directions, control);
    blend_rays(field_, rays, directions, blend, fresh_);
    rays_of_frame_ = rays.size() + relocation_rays_;
  }

  const rays::TransportSource& source_;
  int rays_, warmup_;
  bool relocates_;
  std::uint64_t seed_;
  DdgiBlend blend_;
  DdgiField field_;
  std::vector<std::uint8_t> fresh_;  ///< probes whose maps hold nothing of use
  DdgiLight light_{field_};
  std::optional<rays::PosedWorld> surfaces_;
  std::vector<mat4> poses_;
  std::uint64_t frames_ = 0;
  std::size_t relocation_rays_ = 0, rays_of_frame_ = 0;
};

}  // namespace

MethodEntry entry() {
  return {"ddgi",
          "a grid of probes that trace rays every frame: irradiance and distance, blended over frames",
          {{"spacing", 0, 0, 1e4, "between probes [m]; 0: as `probes` gives"},
           {"probes", 512, 1, most_probes, "so many at least, if no spacing is given", true},
           {"rays", 128, 8, 4096, "of a probe and frame", true},
           {"hysteresis", 0.97, 0, 0.999, "share of a probe's light that stays from the last frame"},
           {"warmup", 64, 1, 65536, "frames that the first update does", true},
           {"change", 0.5, 0, 10, "relative change of light that makes a probe forget; 0: it never does"},
           {"bias", 0.3, 0, 4, "shift off the surface that is looked up, in 3/4 of the spacing"},
           {"gamma", 1, 1, 8, "light is averaged over frames as its 1/gamma-th power"},
           {"visibility", 1, 0, 1, "probes weighed by the distances they see", true},
           {"relocate", 1, 0, 1, "probes moved out of walls", true},
           {"seed", 0, 0, 1e9, "of the rays' directions", true}},
          [](const MethodScene& scene, const MethodParameters& p, const Control& control)
              -> std::unique_ptr<Method> { return std::make_unique<Ddgi>(scene, p, control); }};
}

}  // namespace ssphh::methods::ddgi

#include <algorithm>
#include <optional>

#include <ssphh/bake/bake.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>

#include "probe_places.h"

namespace ssphh::methods::ssphh_paper {
namespace {

/// INIT: the scene's own SPHLs, or as few as the paper has.
probes::ProbeSet dark_set(const MethodScene& scene, const MethodParameters& p, const Control& control) {
  const int degree = p.integer("degree");
  place::PlaceParams params = place::place_params(scene.scene);
  if (probe_places(p) == ProbePlaces::scene && !params.manual.empty())
    return place::init_from_scene(scene.scene, degree);
  params.manual.clear();
  params.count = p.integer("probes");
  return place::init_from_placement(scene.scene, place::place_probes(scene.source, params, control), degree);
}

bake::BakeParams bake_params(const MethodParameters& p) {
  bake::BakeParams params;
  params.gen = p.choice<probes::GenMode>("gen");
  params.path = {p.integer("depth"), p.integer("passes"), p.integer("spp"), 0};
  params.face_size = p.integer("face");
  params.viz_path = {p.integer("viz_depth"), p.integer("viz_passes"), p.integer("viz_spp"), 0};
  params.viz_params.source = p.choice<probes::VizSource>("viz_source");
  params.viz_params.paths = p.choice<rays::PathSet>("viz_paths");
  params.viz_params.matrix = p.choice<probes::HierOperator>("operator") == probes::HierOperator::matrix;
  return params;
}

/// INIT, VIZ, GEN, HIER, and the nearest visible SPHL as a light.
class SsphhPaper final : public Method {
 public:
  SsphhPaper(const MethodScene& scene, const MethodParameters& p, const Control& control)
      : source_(scene.source),
        set_(dark_set(scene, p, control)),
        bake_(bake_params(p)),
        hier_{p.choice<probes::HierOperator>("operator"), p.integer("neighbors"),
              static_cast<float>(p.number("threshold"))},
        lookup_method_(p.choice<probes::LookupMethod>("lookup")) {
    lookup_params_.layer = p.choice<probes::ProbeLayer>("layer");
  }

  void update(const scene::LightingState& state, const Control& control) override {
    scene::LightingState unscaled = state;
    unscaled.group_scales.assign(state.group_scales.size(), vec3(1));
    unscaled.emission.clear();
    if (!tracer_ || unscaled != traced_) trace(unscaled, control);
    for (std::size_t g = 0; g < set_.light_groups.size(); ++g)
      set_.light_groups[g].scale = state.group_scales[g];
    probes::merge_groups(set_);
    edges_used_ = probes::hier(set_, hier_);
    lookup_ = probes::make_lookup(lookup_method_, set_, *tracer_, lookup_params_);
  }

  const rays::IndirectLight& light() const override { return *lookup_; }

  sketch::Sketch drawing(Drawing what) const override {
    return what == Drawing::hierarchy ? hierarchy_drawing(set_) : sketch::Sketch{};
  }

  MethodMemory memory() const override {
    const auto coefficients = static_cast<std::size_t>(sh::coefficient_count(set_.degree));
    const auto looked_up = static_cast<std::size_t>(
        sh::coefficient_count(probes::irradiance_degree(lookup_params_, set_.degree)));
    std::size_t functions = 0;
    for (const probes::Probe& probe : set_.probes)
      functions +=
          2 * probe.groups.size() +
          probe.edges.size() * (hier_.op == probes::HierOperator::matrix ? 1 + coefficients : std::size_t{1});
    return {set_.probes.size() * (coefficients + looked_up) * sizeof(vec3),
            functions * coefficients * sizeof(vec3)};
  }

  MethodNumbers numbers() const override {
    return {{"probes", static_cast<double>(set_.probes.size())}, {"edges", static_cast<double>(edges_used_)}};
  }

 private:
  /// GEN, and VIZ where anything has moved since the last one.
  void trace(const scene::LightingState& state, const Control& control) {
    std::vector<mat4> poses = part_poses(source_, state.time);
    bake_.viz = !tracer_ || poses != poses_;
    lookup_.reset();  // it asks the tracer
    tracer_ = source_.path_tracing(state);
    set_.generator.time = state.time;
    bake::BakeReport report;
    set_ = bake::bake(*tracer_, std::move(set_), bake_, {}, report, control);
    traced_ = state;
    poses_ = std::move(poses);
  }

  const rays::TransportSource& source_;
  probes::ProbeSet set_;
  bake::BakeParams bake_;
  probes::HierParams hier_;
  probes::LookupMethod lookup_method_;
  probes::LookupParams lookup_params_;
  std::unique_ptr<rays::RadianceSource> tracer_;  ///< null before the first update
  scene::LightingState traced_;                   ///< of which it is, every group at its full strength
  std::vector<mat4> poses_;
  std::unique_ptr<rays::IndirectLight> lookup_;
  std::size_t edges_used_ = 0;
};

}  // namespace

MethodEntry entry() {
  return {
      "ssphh-paper",
      "the paper's SSPHH: path-traced SPHLs as lights, and what their neighbours add",
      {places_parameter({ProbePlaces::scene, ProbePlaces::found},
                        "of the SPHLs: the scene's, found where it has none; or found"),
       {"probes", 6, 1, 4096, "so many are found", true},
       {"degree", 10, 0, 10, "highest band of an SPHL", true},
       {"face", 64, 1, 4096, "texels along a face of a cube map", true},
       choice_parameter("gen", probes::GenMode::full, "GEN: every bounce, or direct light alone"),
       {"depth", 3, 0, 65535, "GEN: surface scatterings of a path", true},
       {"passes", 1, 1, 1 << 24, "GEN: of spp samples each", true},
       {"spp", 16, 1, 1 << 24, "GEN: samples per texel and pass", true},
       choice_parameter("viz_source", probes::VizSource::intensity, "VIZ: what is 1 of an SPHL's sphere"),
       choice_parameter("viz_paths", rays::PathSet::diffuse, "VIZ: scattering between SPHLs"),
       {"viz_depth", 3, 0, 65535, "VIZ: surface scatterings of a path", true},
       {"viz_passes", 1, 1, 1 << 24, "VIZ: of viz_spp samples each", true},
       {"viz_spp", 16, 1, 1 << 24, "VIZ: samples per texel and pass", true},
       choice_parameter("operator", probes::HierOperator::coefficient,
                        "HIER: what H and S are multiplied by"),
       {"neighbors", -1, -1, 65536, "HIER: N', at most so many neighbours, strongest first; -1: all", true},
       {"threshold", 0, 0, 1e30, "HIER: only neighbours with P above it"},
       choice_parameter("layer", probes::ProbeLayer::sum, "which part of S' lights surfaces"),
       choice_parameter("lookup", probes::LookupMethod::light,
                        "the nearest visible SPHL as a light, or irradiance blended from those in sight")},
      [](const MethodScene& scene, const MethodParameters& p, const Control& control)
          -> std::unique_ptr<Method> { return std::make_unique<SsphhPaper>(scene, p, control); },
      false,
      {Drawing::hierarchy}};
}

}  // namespace ssphh::methods::ssphh_paper

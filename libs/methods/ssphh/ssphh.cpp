#include <algorithm>
#include <optional>

#include <ssphh/methods/method_list.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/recorded_light.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "network_memory.h"
#include "probe_places.h"

namespace ssphh::methods::ssphh {
namespace {

std::vector<scene::ProbePlace> find_places(const MethodScene& scene, const MethodParameters& p,
                                           const Control& control) {
  place::PlaceParams params = place::place_params(scene.scene);
  if (probe_places(p) == ProbePlaces::scene) {
    if (params.manual.empty())
      throw Error("method ssphh", "the scene has no SPHLs of its own", "let places=auto find some");
    return params.manual;
  }
  params.spacing = static_cast<float>(p.number("spacing"));
  params.count = p.integer("probes");
  return scene::places_of(place::place_probes(scene.source, params, control).probes);
}

/// What lookups blend or ask beside weights of probes.
constexpr const char* gather = "gather";
constexpr int gather_rays = 512;

/// Of what is not gathered.
probes::WeightMethod weight_method(const MethodParameters& p) {
  return p.choice("weights") == gather ? probes::WeightMethod::mls
                                       : p.choice<probes::WeightMethod>("weights");
}

MethodParameter weights_parameter() {
  std::vector<std::string> words = names_of<probes::WeightMethod>();
  const auto surface = std::ranges::find(words, name_of(probes::WeightMethod::surface)) - words.begin();
  words.emplace_back(gather);
  return word_parameter("weights", std::move(words),
                        "of the probes at a point, or records of surfaces, or gather: rays at every lookup",
                        static_cast<std::size_t>(surface));
}

transport::RelightParams relight_params(const MethodScene& scene, const MethodParameters& p) {
  transport::RelightParams params;
  params.degree = p.integer("degree");
  params.transport.surfel_size = static_cast<float>(p.number("surfel_size"));
  params.transport.directions = p.integer("directions");
  params.warm_start = p.flag("warm_start");
  params.records.points = weight_method(p) == probes::WeightMethod::surface ? p.integer("records") : 0;
  if (!scene.keep_direct || params.records.points == 0) return params;
  const std::vector<scene::LightMode> modes = scene::light_modes(scene.scene);
  for (std::size_t g = 0; g < modes.size(); ++g)
    if (scene::keeps_direct(modes[g])) params.records.baked.push_back(static_cast<int>(g));
  return params;
}

/// SPHLs lit by `surfel` transport, with records of surfaces or blended by visible or fitted weights.
class Ssphh final : public Method {
 public:
  Ssphh(const MethodScene& scene, const MethodParameters& p, const Control& control)
      : source_(scene.source),
        session_(scene.source, find_places(scene, p, control), relight_params(scene, p), 0, control),
        surfaces_(std::in_place, scene.source, 0.0f),
        gathers_(p.choice("weights") == gather) {
    probes::WeightParams weights;
    weights.method = weight_method(p);
    if (weights.method == probes::WeightMethod::fitted)
      fitted_ = fit(p.integer("fit_poses"), p.integer("fit_points"), control);
    const std::vector<vec3> positions = scene::positions_of(session_.places());
    weights_ = probes::make_weights(
        positions, [this](const vec3& a, const vec3& b) { return surfaces_->visible(a, b); }, weights,
        fitted_ ? &*fitted_ : nullptr);
    if (session_.gather()) {
      records_ = std::make_shared<const probes::SurfaceInterpolation>(
          session_.gather()->points(),
          [this](const vec3& a, const vec3& b) { return surfaces_->joined(a, b); });
    }
  }

  void update(const scene::LightingState& state, const Control& control) override {
    session_.update(state, control);
    surfaces_.emplace(source_, state.time);
    lookup_ = std::make_shared<const probes::IrradianceLookup>(transport::lookup_set(session_), weights_,
                                                               probes::LookupParams{}, records_);
    if (gathers_) gathered_.emplace(session_, gather_rays, lookup_);
    if (records_) recorded_.emplace(session_, lookup_);
  }

  const rays::IndirectLight& light() const override {
    if (gathered_) return *gathered_;
    if (recorded_) return *recorded_;
    return *lookup_;
  }

  LightData light_data() const override {
    if (gathers_) return {};
    probes::ProbeSet set = transport::lookup_set(session_);
    set.fitted = fitted_;
    return ProbeLight{std::make_shared<const probes::ProbeSet>(std::move(set))};
  }

  sketch::Sketch drawing(Drawing what) const override {
    if (what == Drawing::surfels) return surfels_drawing(session_.network());
    if (what == Drawing::links) return links_drawing(session_.network());
    if (what != Drawing::hierarchy) return {};
    probes::ProbeSet set = transport::lookup_set(session_.places(), session_.reflected());
    probes::merge_groups(set);
    return hierarchy_drawing(set);
  }

  MethodMemory memory() const override {
    // Of each probe radiance for glossy lookups, and irradiance without negative values
    const int kept = probes::irradiance_degree({}, session_.reflected().front().degree());
    MethodMemory bytes;
    bytes.lookup = weights_->bytes() + session_.places().size() * sizeof(vec3) *
                                           (session_.reflected().front().values.size() +
                                            static_cast<std::size_t>(sh::coefficient_count(kept)));
    bytes.update = network_bytes(session_.network());
    if (records_) {
      bytes.lookup += records_->bytes() + records_->count() * sizeof(probes::RecordLight);
      bytes.update += session_.gather()->bytes();
    }
    return bytes;
  }

  MethodNumbers numbers() const override {
    return {{"probes", static_cast<double>(session_.places().size())},
            {"surfels", static_cast<double>(session_.network().surfel_count())},
            {"fitted_points", fitted_ ? static_cast<double>(fitted_->points.size()) : 0},
            {"records", records_ ? static_cast<double>(records_->count()) : 0}};
  }

 private:
  /// To poses evenly spaced over the scene's animation, under its own lights.
  probes::FittedPoints fit(int poses, int points, const Control& control) {
    std::vector<rays::SurfacePoint> places = transport::surfel_points(session_.network());
    if (points > 0) places = transport::spread_points(places, points);
    transport::WeightFit fit(std::move(places));
    const int count = source_.duration() > 0 ? poses : 1;
    for (int k = 0; k < count; ++k) {
      const float share = count > 1 ? static_cast<float>(k) / static_cast<float>(count - 1) : 0;
      session_.update(rays::lighting_at(source_, share * source_.duration()), control);
      fit.add_pose(session_.network(), source_, session_.direct_by_group(), control);
    }
    return fit.solve(control);
  }

  const rays::TransportSource& source_;
  transport::RelightSession session_;
  std::optional<rays::PosedWorld> surfaces_;
  std::optional<probes::FittedPoints> fitted_;
  std::shared_ptr<const probes::LookupWeights> weights_;
  std::shared_ptr<const probes::SurfaceInterpolation> records_;  ///< places of the session's; or null
  std::shared_ptr<const probes::IrradianceLookup> lookup_;
  bool gathers_ = false;
  std::optional<transport::GatherLight> gathered_;
  std::optional<transport::RecordedLight> recorded_;
};

}  // namespace

MethodEntry entry() {
  return {
      "ssphh",
      "SPHLs lit by transport between surfels",
      {places_parameter({ProbePlaces::found, ProbePlaces::scene},
                        "of the probes: found, or the scene's own SPHLs"),
       {"spacing", 0, 0, 1e4, "between probes that are placed [m]; 0: some 100 to 200 probes"},
       {"probes", 0, 0, 4096, "so many are placed; 0: as the spacing gives", true},
       {"degree", 4, 0, 10, "highest band kept of a probe's light", true},
       weights_parameter(),
       {"records", transport::usual_records, 1, 65536,
        "most points that keep light, and as many again where those are not seen; with weights surface",
        true},
       {"fit_poses", 3, 1, 64, "of the doors, to which weights are fitted", true},
       {"fit_points", 0, 0, 262144, "at most so many have weights; 0: one for each surfel", true},
       {"surfel_size", 0, 0, 1e3, "edge of a surfel [m]; 0: by the scene's radius and the probes' distance"},
       {"directions", 384, 16, 65536, "rays of a probe", true},
       {"warm_start", 1, 0, 1, "solve from the last frame's light", true}},
      [](const MethodScene& scene, const MethodParameters& p, const Control& control)
          -> std::unique_ptr<Method> { return std::make_unique<Ssphh>(scene, p, control); },
      true,
      {Drawing::surfels, Drawing::links, Drawing::hierarchy}};
}

}  // namespace ssphh::methods::ssphh

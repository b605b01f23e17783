#pragma once
/// Probes of a scene that stay lit while lamps and doors move: a relight session with all that it stands on.

#include <functional>
#include <memory>
#include <optional>

#include <ssphh/place/place.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh::viewer {

struct LiveLightParams {
  trace::SharedGeometry geometry;         ///< of the scene's surfaces; null: it is built
  std::vector<scene::ProbePlace> places;  ///< empty: place_probes() finds them
  float spacing = 0;                      ///< of the places to be found [m]; 0: some 100 to 200 probes
  transport::RelightParams relight;       ///< with records: whoever looks at surfaces sees what probes miss
  bool glance = false;                    ///< as at_a_glance() makes it

  LiveLightParams() { relight.records.points = transport::usual_records; }
};

class LiveLight {
 public:
  /// Seconds of work for large scenes. Throws Error as place::place_probes and transport::RelightSession do.
  LiveLight(std::shared_ptr<const scene::Scene> scene, const LiveLightParams& params, float time,
            const Control& control = {});

  transport::RelightReport update(const scene::LightingState& state,
                                  double budget_ms = transport::unlimited_ms) {
    return session_->update(state, {}, budget_ms);
  }

  const transport::RelightSession& session() const { return *session_; }
  const scene::Scene& scene() const { return *scene_; }
  bool is_glance() const { return glance_; }  ///< not the whole light that was asked for
  const trace::TransportScene& source() const { return source_; }

  /// A set of these places that holds the reflected light as it is now, groups merged into one.
  probes::ProbeSet probes() const;
  /// Only the coefficients of a set that probes() made. Does not allocate.
  void refresh(probes::ProbeSet& set) const;
  /// The set that a bake in this pose would give: light group by light group, with emitters.
  probes::ProbeSet bake(const scene::Scene& scene, const Control& control = {}) const;

 private:
  std::shared_ptr<const scene::Scene> scene_;
  bool glance_;
  trace::TransportScene source_;
  std::optional<transport::RelightSession> session_;
};

/// What lights any scene within some seconds, before the light of `params` is there: few surfels, no records.
LiveLightParams at_a_glance(LiveLightParams params);

/// Live light of `params`; before it, where `glance` is given, of what at_a_glance() makes of them, with the
/// same places.
std::shared_ptr<LiveLight> find_light(std::shared_ptr<const scene::Scene> scene, LiveLightParams params,
                                      float time, const Control& control,
                                      const std::function<void(std::shared_ptr<LiveLight>)>& glance = {});

}  // namespace ssphh::viewer

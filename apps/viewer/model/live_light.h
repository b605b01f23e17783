#pragma once
/// Probes of a scene that stay lit while lamps and doors move: a relight session with all that it stands on.

#include <memory>
#include <optional>

#include <ssphh/gi/place.h>
#include <ssphh/gi/session_sets.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::viewer {

struct LiveLightParams {
  trace::SharedGeometry geometry;      ///< of the scene's surfaces; null: it is built
  std::vector<gi::ProbePlace> places;  ///< empty: place_probes() finds them
  float spacing = 0;                   ///< of the places to be found [m]; 0: some 100 to 200 probes
  gi::RelightParams relight;
};

class LiveLight {
 public:
  /// Seconds of work for large scenes. Throws Error as gi::place_probes and gi::RelightSession do.
  LiveLight(std::shared_ptr<const scene::Scene> scene, const LiveLightParams& params, float time,
            const Control& control = {});

  gi::RelightReport update(const scene::LightingState& state) { return session_->update(state); }

  const gi::RelightSession& session() const { return *session_; }
  const trace::TransportScene& source() const { return source_; }

  /// A set of these places that holds the reflected light as it is now, groups merged into one.
  gi::ProbeSet probes() const;
  /// Only the coefficients of a set that probes() made. Does not allocate.
  void refresh(gi::ProbeSet& set) const;
  /// The set that a bake in this pose would give: light group by light group, with emitters.
  gi::ProbeSet bake(const scene::Scene& scene, const Control& control = {}) const;

 private:
  std::shared_ptr<const scene::Scene> scene_;
  trace::TransportScene source_;
  std::optional<gi::RelightSession> session_;
};

}  // namespace ssphh::viewer

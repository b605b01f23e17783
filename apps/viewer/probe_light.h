#pragma once
/// The probes of a session and where their light comes from: a file, a bake, or transport kept warm.

#include <memory>
#include <optional>
#include <string>

#include <ssphh/probes/blend.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/realtime/renderer.h>

#include "balls_gl.h"
#include "model/document.h"
#include "model/live_light.h"

namespace ssphh::viewer {

class ProbeLight {
 public:
  /// Light by transport that follows every edit; replaces what there was.
  void take(std::shared_ptr<LiveLight> live);
  /// Fixed light, of a file or a bake. Only its light groups can still be scaled.
  void take(probes::ProbeSet set, const std::string& origin);
  /// Fixed light that is blended between keys as the scene's animations go on; two or more.
  void take(std::vector<probes::KeyedSet> keys, float time, const std::string& origin);
  /// Fitted weights of the set that was taken last, made ready.
  void take_fitted(probes::FittedSurfaces fitted);
  /// Surfaces of its records, likewise.
  void take_records(probes::SurfaceLists records);
  void clear();
  /// Fixed light that took long and that no file has: by what it was made, GEN or VIZ. Whatever replaces the
  /// light takes this away, as saved() does.
  void not_saved(const std::string& work) { unsaved_ = work, ++works_; }
  void saved() { unsaved_.clear(); }
  const std::string& unsaved() const { return unsaved_; }  ///< empty: nothing
  int works() const { return works_; }                     ///< a number of its own for each work
  /// Light of one probe of a bake that is under way, and its edges once it has any: `set` was taken at its
  /// start.
  void take_probe(std::size_t i, const probes::Probe& probe);
  /// Edges of VIZ for the same places.
  void take_edges(std::size_t i, std::vector<probes::Edge> edges);

  bool empty() const { return !set_; }
  bool live() const { return live_ != nullptr; }
  bool is_glance() const { return live_ && live_->is_glance(); }
  const probes::ProbeSet& set() const { return *set_; }
  /// "live", or the file's name.
  const std::string& origin() const { return origin_; }
  const LiveLight* live_light() const { return live_.get(); }
  const transport::RelightReport& report() const { return report_; }

  /// How surfaces look it up, apart from the weights.
  probes::LookupParams lookup_params(const Settings& settings) const;

  struct Update {
    bool relit = false;     ///< light changed
    bool replaced = false;  ///< places changed
    double relight_ms = 0, hier_ms = 0, upload_ms = 0;
  };
  /// Brings light, hierarchy and the renderer up to date with the document and settings. Cheap when nothing
  /// changed. Live light that takes longer than the budget is on its way then, and what there was stays.
  Update update(const Document& document, const Settings& settings, realtime::Renderer& renderer);
  /// Milliseconds that update() spends on live light, about.
  double budget_ms = transport::unlimited_ms;
  bool under_way() const { return live_ && live_->session().under_way(); }
  /// Live light as a bake would write it, once what is under way is there.
  probes::ProbeSet bake(const scene::Scene& scene);

 private:
  bool relight(const Document& document);
  void spend(const scene::LightingState& state, double budget);
  /// Takes the light of the keys at a time, if there are keys and it is another time; whether it did.
  bool follow_keys(float time);
  /// Groups of a file that are `diffuse` are so as long as surroundings and pose are as baked.
  bool choose_modes(const scene::LightingState& state);
  bool rebuild_hierarchy(const Settings& settings);
  sh::RadianceSh looked_up(std::size_t i, const Settings& settings) const;

  std::shared_ptr<LiveLight> live_;
  std::vector<probes::KeyedSet> keys_;  ///< of a light that plays; empty: it does not
  std::optional<probes::ProbeSet> set_;
  std::string origin_, unsaved_;
  int works_ = 0;
  double spent_ms_ = 0;  ///< on live light that is under way
  transport::RelightReport report_;
  probes::FittedSurfaces fitted_;
  probes::SurfaceLists records_;

  std::vector<scene::LightMode> modes_;  ///< of a file's groups

  // What was last brought to the set and the renderer.
  bool places_new_ = false, light_new_ = false, surfaces_new_ = false, by_records_ = false;
  std::optional<scene::LightingState> lighting_;
  std::optional<Settings> settings_;
  std::vector<probes::LightGroup> groups_;
};

}  // namespace ssphh::viewer

#include "probe_light.h"

#include <algorithm>
#include <numeric>

#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>

namespace ssphh::viewer {
void ProbeLight::take(std::shared_ptr<LiveLight> live) {
  std::vector<std::vector<probes::Edge>> edges;
  const std::size_t count = live->session().places().size();
  if (set_ && set_->probes.size() == count) {
    // Edges of VIZ tell of places and surfaces, not of lamps: they outlive a change of lamps.
    bool same_places = true;
    for (std::size_t i = 0; i < count; ++i)
      same_places &= set_->probes[i].position == live->session().places()[i].position;
    if (same_places) {
      for (probes::Probe& probe : set_->probes) edges.push_back(std::move(probe.edges));
    }
  }
  live_ = std::move(live);
  spent_ms_ = 0;
  keys_.clear();
  set_ = live_->probes();
  for (std::size_t i = 0; i < edges.size(); ++i) set_->probes[i].edges = std::move(edges[i]);
  origin_ = "live";
  fitted_ = {};
  records_ = {};
  lighting_.reset();
  places_new_ = light_new_ = true;
  unsaved_.clear();
}

void ProbeLight::take(probes::ProbeSet set, const std::string& origin) {
  live_.reset();
  keys_.clear();
  set_ = std::move(set);
  modes_.clear();
  for (const probes::LightGroup& group : set_->light_groups) modes_.push_back(group.mode);
  probes::merge_groups(*set_);
  origin_ = origin;
  fitted_ = {};
  records_ = {};
  lighting_.reset();
  places_new_ = light_new_ = true;
  unsaved_.clear();
}

void ProbeLight::take(std::vector<probes::KeyedSet> keys, float time, const std::string& origin) {
  take(probes::light_at(keys, time).set, origin);
  keys_ = std::move(keys);
}

bool ProbeLight::follow_keys(float time) {
  if (keys_.empty() || (lighting_ && lighting_->time == time)) return false;
  *set_ = probes::light_at(keys_, time).set;
  return true;
}

void ProbeLight::take_fitted(probes::FittedSurfaces fitted) {
  fitted_ = std::move(fitted);
  surfaces_new_ = true;
}

void ProbeLight::take_records(probes::SurfaceLists records) {
  records_ = std::move(records);
  surfaces_new_ = true;
}

void ProbeLight::clear() {
  live_.reset();
  set_.reset();
  places_new_ = true;
  unsaved_.clear();
}

void ProbeLight::take_probe(std::size_t i, const probes::Probe& probe) {
  if (!set_ || i >= set_->probes.size()) return;
  set_->probes[i].groups = probe.groups;
  // VIZ comes after GEN: until then those of the glance before stay.
  if (!probe.edges.empty()) set_->probes[i].edges = probe.edges;
  probes::merge_groups(*set_);
  light_new_ = true;
}

void ProbeLight::take_edges(std::size_t i, std::vector<probes::Edge> edges) {
  if (!set_ || i >= set_->probes.size()) return;
  set_->probes[i].edges = std::move(edges);
  light_new_ = true;
}

void ProbeLight::spend(const scene::LightingState& state, double budget) {
  const Stopwatch watch;
  report_ = live_->update(state, budget);
  spent_ms_ += watch.milliseconds();
}

probes::ProbeSet ProbeLight::bake(const scene::Scene& scene) {
  if (under_way()) spend(live_->session().lighting(), transport::unlimited_ms);
  return live_->bake(scene);
}

/// Whether there is other light than update() has shown.
bool ProbeLight::relight(const Document& document) {
  scene::LightingState state = document.lighting();
  if (lighting_ == state && !under_way()) return false;
  if (live_) {
    // Until it is built anew for other lamps it holds still.
    if (!document.lamps_are_of(live_->scene())) return false;
    spend(state, budget_ms);
    state = live_->session().shown();
    if (lighting_ == state) return false;
    live_->refresh(*set_);
  } else {
    const std::vector<vec3>& scales = state.group_scales;
    const bool played = follow_keys(state.time);
    const bool dimmed = !lighting_ || lighting_->group_scales != scales;
    if (!(choose_modes(state) || dimmed || played)) return false;
    // By name: lamps that came or went since the bake have groups of their own.
    const std::vector<std::string> names = scene::light_groups(*document.scene);
    for (probes::LightGroup& group : set_->light_groups) {
      const auto found = std::ranges::find(names, group.name);
      if (found != names.end()) group.scale = scales[found - names.begin()];
    }
    probes::merge_groups(*set_);
  }
  lighting_ = std::move(state);
  return true;
}

bool ProbeLight::choose_modes(const scene::LightingState& state) {
  const bool as_baked =
      state.environment() == scene::EnvironmentState() && state.time == set_->generator.time;
  bool changed = false;
  for (std::size_t g = 0; g < modes_.size(); ++g) {
    if (modes_[g] != scene::LightMode::diffuse) continue;
    scene::LightMode& mode = set_->light_groups[g].mode;
    const scene::LightMode now = as_baked ? scene::LightMode::diffuse : scene::LightMode::realtime;
    changed |= mode != now;
    mode = now;
  }
  return changed;
}

bool ProbeLight::rebuild_hierarchy(const Settings& settings) {
  const bool wanted = settings.hier && probes::edge_count(*set_) > 0;
  if (!wanted) {
    const bool had = set_->hierarchy.has_value();
    set_->hierarchy.reset();
    return had;
  }
  probes::hier(*set_, settings.hier_params);
  return true;
}

probes::LookupParams ProbeLight::lookup_params(const Settings& settings) const {
  probes::LookupParams params = probes::lookup_params({.layer = settings.layer}, *set_);
  params.irradiance_degree = settings.degree;
  return params;
}

/// What surfaces look up: the reflected part of the probe's own light, and what HIER adds.
sh::RadianceSh ProbeLight::looked_up(std::size_t i, const Settings& settings) const {
  const probes::ProbeLayer layer = lookup_params(settings).layer.value();
  if (layer == probes::ProbeLayer::neighbor) return set_->hierarchy->neighbor[i];
  sh::RadianceSh light = set_->probes[i].reflected;
  if (layer == probes::ProbeLayer::sum) light += set_->hierarchy->neighbor[i];
  return light;
}

ProbeLight::Update ProbeLight::update(const Document& document, const Settings& settings,
                                      realtime::Renderer& renderer) {
  Update out;
  if (!set_) {
    if (places_new_) renderer.clear_probes(), out.replaced = out.relit = true;
    places_new_ = false;
    return out;
  }
  Stopwatch watch;
  const bool relit = relight(document) || light_new_;
  out.relight_ms = live_ ? spent_ms_ : watch.milliseconds();
  if (relit) spent_ms_ = 0;

  const bool hier_changed =
      !settings_ || settings_->hier != settings.hier || !(settings_->hier_params == settings.hier_params);
  bool hierarchy_new = false;
  if (relit || hier_changed) {
    watch = {};
    try {
      hierarchy_new = rebuild_hierarchy(settings);
    } catch (const Error& e) {
      log_warning("{}", e.what());
      set_->hierarchy.reset();
    }
    out.hier_ms = watch.milliseconds();
  }
  const bool lookup_changed =
      !settings_ || settings_->layer != settings.layer || settings_->degree != settings.degree;

  watch = {};
  if (places_new_ || lookup_changed) {
    renderer.set_probes(*set_, lookup_params(settings));
    surfaces_new_ = true;
    out.replaced = places_new_;
    out.relit = true;
  } else if (relit || hierarchy_new) {
    std::vector<int> changed;
    if (live_ && !hierarchy_new && !light_new_) {
      changed.assign(report_.changed_probes.begin(), report_.changed_probes.end());
    } else {
      changed.resize(set_->probes.size());
      std::iota(changed.begin(), changed.end(), 0);
    }
    std::vector<sh::RadianceSh> light;
    for (const int i : changed) light.push_back(looked_up(static_cast<std::size_t>(i), settings));
    renderer.update_probes(changed, light);
    out.relit = true;
  }
  if (groups_ != set_->light_groups) {
    if (!places_new_) renderer.set_kept_light(*set_);
    groups_ = set_->light_groups;
  }
  const bool by_records = !records_.empty() && probes::has_records(*set_, lookup_params(settings));
  if (surfaces_new_ || by_records != by_records_) {
    if (by_records) {
      renderer.set_records(records_);
    } else {
      renderer.set_fitted(fitted_);
    }
    by_records_ = by_records;
    surfaces_new_ = out.relit = true;
  }
  if (by_records && (relit || surfaces_new_)) renderer.set_record_light(set_->surface->light);
  out.upload_ms = watch.milliseconds();
  places_new_ = light_new_ = surfaces_new_ = false;
  settings_ = settings;
  return out;
}

}  // namespace ssphh::viewer

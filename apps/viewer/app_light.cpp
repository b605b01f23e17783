// What lights the scene: its probes, found, lit by transport or traced, or read from a file.

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/log.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/trace/path_tracer.h>

#include "app.h"

namespace ssphh::viewer {
template <class Places>
void App::take_places(const std::string& what, const Places& places) {
  Edits edits = document.edits();
  edits.sphls.clear();
  for (const auto& place : places)
    edits.sphls.push_back({-1, place.position, place.name, place.radius, true});
  // They are found again, or stand in a file: nothing is lost with them.
  document.history.seal();
  document.history.change(std::move(edits), what, false);
  document.history.seal();
  applied_.sphls = document.edits().sphls;
  selection = {};
}

void App::light_scene_probes() {
  if (document.places().empty())
    throw Error("probes", "the scene has no SPHLs", "press Place in the panel Probes, or give --probes auto");
  rebuild_light();
}

void App::use_probes(const std::string& what) {
  constexpr std::string_view automatic = "auto:";
  if (what == "off") {
    light.clear();
  } else if (what == "scene") {
    light_scene_probes();
  } else if (what == "auto") {
    place_probes(0);
  } else if (what.starts_with(automatic)) {
    const float spacing = number_of("probes", what.substr(automatic.size()));
    if (!(spacing > 0)) throw Error("probes", "a spacing must be over 0", "as in auto:0.7");
    place_probes(spacing);
  } else if (what.find(".sphl") != std::string::npos) {
    take_probe_file(what);
    if (options.live) light_scene_probes();
  } else {
    throw Error(
        "probes",
        fmt::format("\"{}\" is none of: off, scene, auto, auto:METRES, a .sphl or .sphl.json file", what));
  }
}

LiveLightParams App::light_params() {
  const QualityEffort effort = effort_of(settings.quality, options.transport);
  LiveLightParams params;
  params.geometry = geometry_;
  params.relight.transport = effort.transport;
  params.relight.records.points = options.records.value_or(effort.records);
  applied_.live_quality = settings.quality;
  return params;
}

void App::take_quality() {
  if (applied_.quality != settings.quality) use_quality(settings.quality);
  if (!light.live() || applied_.live_quality == settings.quality) return;
  applied_.live_quality = settings.quality;
  applied_.light_is_stale(window.seconds());
}

void App::use_quality(Quality quality) {
  settings.quality = quality;
  applied_.quality = quality;
  const QualityEffort effort = effort_of(quality);
  bake_params.path.spp = effort.spp;
  bake_params.face_size = effort.face_size;
  redraw();
}

bool App::quality_by_hand() const {
  const QualityEffort effort = effort_of(settings.quality);
  return bake_params.path.spp != effort.spp || bake_params.face_size != effort.face_size;
}

LightKnown App::light_known() const {
  LightKnown known;
  known.probes = document.places().size();
  known.paths_per_second = gen_rate_;
  known.transport = options.transport;
  if (light.live()) {
    const transport::TransportNetwork& network = light.live_light()->session().network();
    known.surfels = static_cast<double>(network.surfel_count());
    known.transport = network.params();
    known.live_seconds = live_seconds_;
  }
  return known;
}

void App::rebuild_light() {
  LiveLightParams params = light_params();
  params.places = document.places();
  if (params.places.empty()) {
    light.clear();
    say("there are no SPHLs left: direct light only");
    return;
  }
  start_light("lighting probes", params, [](const LiveLight&) {});
}

void App::place_probes(float spacing) {
  LiveLightParams params = light_params();
  params.spacing = spacing;
  start_light("placing probes", params, [this](const LiveLight& found) {
    take_places("place probes", found.session().places());
    say(fmt::format("{} probes", found.session().places().size()));
  });
}

/// Where somebody looks at a scene that nothing lights, at a glance first. `placed` is called once, before
/// the first light is taken.
void App::start_light(const std::string& name, const LiveLightParams& params,
                      const std::function<void(const LiveLight&)>& placed) {
  auto scene = std::make_shared<const scene::Scene>(with_materials(*document.scene, document.edits()));
  std::function<void(std::shared_ptr<LiveLight>)> glance;
  if (light.empty() && by_hand()) {
    glance = [this, placed](const std::shared_ptr<LiveLight>& coarse) {
      job.hand_over([this, placed, coarse] {
        placed(*coarse);
        light.take(coarse);
        screen.is_new = true;
      });
    };
  }
  job.start(name, [this, scene, params, placed, glance, time = document.time](const Control& control) {
    auto live = find_light(scene, params, time, control, glance);
    return [this, placed, is_placed = glance != nullptr, live] {
      live_seconds_ = job.status().seconds;
      if (!is_placed) placed(*live);
      light.take(live);
      screen.is_new = true;
      prepare_surfaces();
    };
  });
}

void App::take_probe_file(const std::string& file, bool anyway) {
  if (!scene_open()) throw Error(file, "there is no scene for these probes", "open the scene first");
  const std::vector<probes::ProbeKey> keys = probes::read_probe_keys(file);
  std::vector<probes::KeyedSet> sets;
  if (keys.size() > 1) {
    sets = probes::read_keyed_sets(keys);
  } else {
    sets.push_back({0, probes::read_probe_file(keys.front().file)});
  }
  for (probes::KeyedSet& key : sets) {
    const std::string problem = misfit(key.set);
    // What the command line names is refused; who sits at the window is asked.
    if (!problem.empty() && !anyway && by_hand() && !failures_end && !options.force) {
      question = {};
      question.then = Question::Then::take_probes, question.source = file, question.problem = problem;
      return redraw();
    }
    fit_to_scene(key.set, file, anyway);
  }
  const std::vector<probes::Probe>& places = sets.front().set.probes;
  take_places("probes of a file", places);
  say(fmt::format("{}: {} probes", file, places.size()));
  if (sets.size() > 1) {
    light.take(std::move(sets), document.time, file);
  } else {
    light.take(std::move(sets.front().set), file);
  }
  prepare_surfaces();
}

std::string App::misfit(const probes::ProbeSet& set) const {
  if (set.generator.scene_hash != scene::light_hash(*document.opened))
    return fmt::format("was baked in another scene (\"{}\")", set.generator.scene);
  const std::string modes = bake::mode_difference(set, *document.opened);
  return modes.empty() ? "" : "was baked with " + modes;
}

void App::fit_to_scene(probes::ProbeSet& set, const std::string& file, bool anyway) const {
  if (const std::string problem = misfit(set); !problem.empty()) {
    if (!anyway && !options.force)
      throw Error(file, problem, "open that scene, bake it anew, or go on with --force as it was baked");
    log_warning("{}: {}", file, problem);
  }
  if (bake::mode_difference(set, *document.opened).empty()) bake::adopt_modes(set, *document.opened);
}

void App::prepare_surfaces() {
  const probes::ProbeSet& set = light.set();
  if (!set.surface && !set.fitted) return;
  const auto sight = set.surface ? &trace::PathTracer::joined : &trace::PathTracer::visible;
  // What a door hides at any of these times lights nothing behind it at any other
  const auto prepare = [geometry = geometry_, scene = document.scene, time = document.time,
                        sight](const auto& with_sight) {
    std::vector<std::unique_ptr<trace::PathTracer>> poses;
    for (const float t : {time, 0.0f, scene::animation_duration(*scene)}) {
      if (poses.empty() || t != time)
        poses.push_back(std::make_unique<trace::PathTracer>(geometry, *scene, t));
    }
    return with_sight(*scene, time, probes::SeesProbe([&](const vec3& a, const vec3& b) {
      return std::ranges::all_of(poses, [&](const auto& pose) { return ((*pose).*sight)(a, b); });
    }));
  };
  if (set.surface) {
    job.start("surface records", [this, prepare, points = set.surface->points](const Control& control) {
      auto prepared = std::make_shared<probes::SurfaceLists>(
          prepare([&](const scene::Scene& scene, float time, const probes::SeesProbe& sees) {
            return probes::prepare_surfaces(scene, time, points, sees, control);
          }));
      return [this, prepared] { light.take_records(std::move(*prepared)); };
    });
  } else {
    job.start("fitted weights", [this, prepare, fitted = *set.fitted](const Control& control) {
      auto prepared = std::make_shared<probes::FittedSurfaces>(
          prepare([&](const scene::Scene& scene, float time, const probes::SeesProbe& sees) {
            return probes::prepare_fitted(scene, time, fitted, sees, control);
          }));
      return [this, prepared] { light.take_fitted(std::move(*prepared)); };
    });
  }
}

}  // namespace ssphh::viewer

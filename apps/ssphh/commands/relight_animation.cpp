#include "commands/relight_animation.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/parse_number.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/turn_surroundings.h>

namespace ssphh::app {
namespace {

const struct {
  const char* name;
  TrackProperty property;
} properties[] = {{"position", TrackProperty::position},
                  {"direction", TrackProperty::direction},
                  {"intensity", TrackProperty::intensity},
                  {"color", TrackProperty::color},
                  {"scale", TrackProperty::scale}};

bool is_vector(TrackProperty property) {
  return property == TrackProperty::position || property == TrackProperty::direction ||
         property == TrackProperty::color;
}

vec3 read_key(const std::string& where, std::string_view text, TrackProperty property) {
  const std::vector<float> n = parse_numbers(text).value_or(std::vector<float>());
  const bool vector = is_vector(property);
  const bool three = n.size() == 3 && (vector || property == TrackProperty::scale);
  if (!three && (vector || n.size() != 1)) {
    throw Error(where, fmt::format("\"{}\" is not {}", text, vector ? "three numbers x,y,z" : "a number"),
                "keys are parted by ':', as in lamp.position=0,2,0:1,2,0 or lamp.intensity=0:4");
  }
  const vec3 key = three ? vec3(n[0], n[1], n[2]) : vec3(n[0]);
  const bool signed_value = property == TrackProperty::time || property == TrackProperty::turn ||
                            property == TrackProperty::position || property == TrackProperty::direction;
  if (!signed_value && glm::any(glm::lessThan(key, vec3(0)))) throw Error(where, "light cannot be negative");
  if (property == TrackProperty::direction && !(glm::length(key) > 0))
    throw Error(where, "a direction of length 0 is none");
  return key;
}

/// The index of a name among those of the scene's lights or light groups.
int find(const std::string& where, const char* kind, const char* kinds, const std::string& name,
         const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw Error(where, fmt::format("there is no {} \"{}\"", kind, name),
                names.empty() ? fmt::format("the scene has no {}", kinds)
                              : fmt::format("its {}: {}", kinds, fmt::join(names, ", ")));
  }
  return static_cast<int>(found - names.begin());
}

/// Hours of "06:00..12:30..20:00"; a time that is earlier than the one before it is of the next day.
std::vector<vec3> read_hours(const std::string& where, std::string_view text) {
  std::vector<vec3> keys;
  for (std::size_t begin = 0;; begin += 2) {
    const std::size_t end = std::min(text.find("..", begin), text.size());
    auto hour = static_cast<float>(scene::read_hour(text.substr(begin, end - begin), where));
    if (!keys.empty() && hour < keys.back().x) hour += 24;
    if (!keys.empty() && hour < keys.back().x) throw Error(where, "lasts longer than two days");
    keys.emplace_back(hour);
    if (end == text.size()) return keys;
    begin = end;
  }
}

Track read_track(const std::string& spec, const rays::TransportSource& source, const scene::Scene& scene) {
  const std::string where = fmt::format("--animate \"{}\"", spec);
  const std::size_t equals = spec.rfind('=');
  if (equals == std::string::npos) throw Error(where, "has no '='", "write time=0:1 or lamp.intensity=0:4");
  const std::string what = spec.substr(0, equals);
  Track track;
  if (what == "time-of-day") {
    if (!scene.environment || !scene.environment->sun_sky || !scene.environment->sun_sky->time)
      throw Error(where, "the scene has no sky of a date and place",
                  "give --sky physical --date 2026-06-21 --place 48.1,11.6 --time-of-day 06:00..20:00");
    return {TrackProperty::time_of_day, -1, read_hours(where, std::string_view(spec).substr(equals + 1))};
  }
  if (what == "environment.rotation") {
    if (source.environment_group() < 0) throw Error(where, "the scene has no environment");
    track.property = TrackProperty::turn;
  } else if (what != "time") {
    const std::size_t dot = what.rfind('.');
    const std::string property = dot == std::string::npos ? "" : what.substr(dot + 1);
    const auto* known = std::ranges::find_if(properties, [&](const auto& p) { return property == p.name; });
    if (known == std::end(properties)) {
      throw Error(where, fmt::format("\"{}\" cannot be animated", what),
                  "time, time-of-day, environment.rotation, LIGHT.position, LIGHT.direction, "
                  "LIGHT.intensity, LIGHT.color "
                  "or GROUP.scale");
    }
    track.property = known->property;
    const std::string name = what.substr(0, dot);
    if (track.property == TrackProperty::scale) {
      track.target = find(where, "light group", "groups", name, source.light_groups());
    } else {
      const std::vector<std::string>& names = source.light_names();
      track.target = find(where, "light", "lights", name, names);
      if (std::ranges::count(names, name) > 1)
        throw Error(where, fmt::format("several lights are named \"{}\"", name),
                    "give them names of their own, or scale their group");
      const scene::LightType type = scene.lights[track.target].type;
      if (track.property == TrackProperty::position && type == scene::LightType::directional)
        throw Error(where, "a directional light has no position", "animate its direction");
      if (track.property == TrackProperty::direction &&
          (type == scene::LightType::point || type == scene::LightType::sphere))
        throw Error(where, "it shines into all directions alike", "animate its position");
    }
  }
  for (std::size_t begin = equals; begin != std::string::npos;) {
    const std::size_t end = spec.find(':', ++begin);
    track.keys.push_back(read_key(where, std::string_view(spec).substr(begin, end - begin), track.property));
    begin = end;
  }
  if (track.property == TrackProperty::turn)
    for (vec3& key : track.keys) key = glm::radians(key);
  return track;
}

}  // namespace

const char* const animation_help =
    "What moves, as NAME=KEY[:KEY ...]; the keys are spread evenly over the frames. time (the scene's "
    "animations [s]), environment.rotation (degrees), time-of-day (of a sky with "
    "date and place: 06:00..20:00), LIGHT.position, LIGHT.direction, LIGHT.color (x,y,z), "
    "LIGHT.intensity, GROUP.scale (number or r,g,b). May be repeated. Default: time=0:END if the scene has "
    "animations";

vec3 Track::at(float u) const {
  const float place = u * static_cast<float>(keys.size() - 1);
  const auto i = static_cast<std::size_t>(place);
  const std::size_t next = std::min(i + 1, keys.size() - 1);
  return glm::mix(keys[i], keys[next], place - static_cast<float>(i));
}

RelightAnimation::RelightAnimation(const rays::TransportSource& source, const scene::Scene& scene, float time,
                                   const std::vector<std::string>& specs)
    : source_(source), scene_(scene), time_(time) {
  std::set<std::pair<TrackProperty, int>> seen;
  for (const std::string& spec : specs) {
    tracks_.push_back(read_track(spec, source, scene));
    if (!seen.insert({tracks_.back().property, tracks_.back().target}).second)
      throw Error(fmt::format("--animate \"{}\"", spec), "is animated twice",
                  "give more keys instead: 0:1:0");
  }
  if (specs.empty() && source.duration() > 0)
    tracks_.push_back({TrackProperty::time, -1, {vec3(0), vec3(source.duration())}});
  check_sun();
  if (tracks_.empty()) {
    throw Error("--animate", "nothing moves: the scene has no animations of its own",
                source.light_names().empty() ? "and no lights"
                                             : fmt::format("animate a light, as in \"{}.intensity=0:4\"",
                                                           source.light_names().front()));
  }
}

void RelightAnimation::check_sun() const {
  for (const Track& track : tracks_) {
    if (track.property != TrackProperty::time_of_day) continue;
    const scene::SunSkyParams& sky = *scene_.environment->sun_sky;
    if (sky.model == scene::SkyModel::physical) continue;
    constexpr int steps = 96;
    for (int i = 0; i <= steps; ++i) {
      const float hour = track.at(static_cast<float>(i) / steps).x;
      if (sun_at(hour).elevation >= 0) continue;
      throw Error("time-of-day",
                  fmt::format("the sun is below the horizon at {}, of which Preetham's sky knows nothing",
                              scene::clock_text(static_cast<double>(hour))),
                  "give --sky physical");
    }
  }
}

scene::SunSkyParams RelightAnimation::sun_at(float hour) const {
  const scene::SunSkyParams& sky = *scene_.environment->sun_sky;
  scene::SunTime time = *sky.time;
  time.hour = static_cast<double>(hour);
  return scene::at_time(sky, time);
}

SceneOptions at_start_of_day(SceneOptions scene, std::vector<std::string>& specs) {
  std::string& day = scene.sky.time_of_day;
  const std::size_t dots = day.find("..");
  if (dots == std::string::npos) return scene;
  specs.push_back("time-of-day=" + day);
  day.resize(dots);
  return scene;
}

bool RelightAnimation::moves_time() const {
  return std::ranges::any_of(tracks_,
                             [](const Track& track) { return track.property == TrackProperty::time; });
}

scene::LightingState RelightAnimation::frame(float u) const {
  float time = time_, turn = 0;
  for (const Track& track : tracks_) {
    if (track.property == TrackProperty::time) time = track.at(u).x;
    if (track.property == TrackProperty::turn) turn = track.at(u).x;
  }
  scene::LightingState state = rays::lighting_at(source_, time);
  for (const Track& track : tracks_) {
    if (track.property == TrackProperty::time_of_day)
      scene::set_sun_sky(state, scene_, scene::make_sun_sky(sun_at(track.at(u).x)));
  }
  scene::turn_surroundings(state, scene_, turn);
  for (const Track& track : tracks_) {
    const vec3 value = track.at(u);
    if (track.target < 0) continue;  // as above: a light with a direction of its own keeps it
    const auto target = static_cast<std::size_t>(track.target);
    if (track.property == TrackProperty::scale) {
      state.group_scales[target] = value;
      continue;
    }
    scene::LightState& light = state.lights[target];
    if (track.property == TrackProperty::position) light.world[3] = vec4(value, 1);
    if (track.property == TrackProperty::direction)
      light.world = pipeline::aimed(scene_.lights[target].type, light.world, value);
    if (track.property == TrackProperty::intensity) light.intensity = value.x;
    if (track.property == TrackProperty::color) light.color = value;
  }
  return state;
}

}  // namespace ssphh::app

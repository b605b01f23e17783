#include "commands/web_lamps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <ssphh/core/nearest_word.h>
#include <ssphh/lightmap/light.h>
#include <ssphh/pipeline/lamp_light.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>

namespace ssphh::app {
namespace {

/// What a page keeps of lightmaps of one lamp in one pose, unpacked [bytes].
constexpr double most_bytes = double{256} * 1024 * 1024;
/// Indirect light is smooth: its lightmaps have so many times fewer texels along each axis.
constexpr int coarser = 4;
constexpr int least_size = 64;
/// Share of the mean light that is kept.
constexpr float faint = 1.0f / 1024;

/// Places of a spot are nearer: what its bright disc lights moves with it [m].
constexpr float spot_spacing = 0.5f;

using scene::Light;
using scene::LightType;

/// Why a lamp cannot be moved; empty: it can.
std::string problem_of(const scene::Scene& scene, const Light& light) {
  if (light.type == LightType::directional) return "is at infinity";
  if (light.type == LightType::sphl) return "is an SPHL, whose direct light the page cannot draw";
  if (scene::is_area_lamp(light.type)) return "is flat, and the page cannot draw its direct light";
  if (light.has_profile()) return "has a photometric profile, which the page cannot draw";
  if (light.node >= 0 && scene.nodes[light.node].movable) return "is moved by an animation";
  const std::string group = scene::light_group(light);
  const auto shares = [&](const auto& emitter) { return scene::light_group(emitter) == group; };
  std::ptrdiff_t emitters = std::ranges::count_if(scene.lights, shares);
  if (scene.environment && shares(*scene.environment)) ++emitters;
  for (const scene::Instance& instance : scene.instances) {
    const int material = scene::instance_material(scene, instance);
    if (material >= 0 && scene.materials[material].emissive() && scene::light_group(scene, instance) == group)
      ++emitters;
  }
  return emitters > 1 ? fmt::format("shares the light group \"{}\" with others", group) : "";
}

std::vector<std::size_t> lights_named(const WebOptions& o, const scene::Scene& scene) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (const Light& light : scene.lights) names.push_back(light.name);
  for (const std::string& wanted : o.movable) {
    if (wanted == "all") {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (problem_of(scene, scene.lights[i]).empty()) found.push_back(i);
      continue;
    }
    const std::string where = "--movable " + wanted;
    const auto light = std::ranges::find(names, wanted);
    if (light == names.end()) {
      const std::vector<std::string> groups = scene::light_groups(scene);
      if (std::ranges::find(groups, wanted) != groups.end())
        throw Error(where,
                    "is no point, spot or sphere light: a sky and shining surfaces stay where they are",
                    nearest_hint(wanted, names));
      throw Error(where, "is no lamp of the scene", nearest_hint(wanted, names));
    }
    const auto index = static_cast<std::size_t>(light - names.begin());
    if (const std::string problem = problem_of(scene, scene.lights[index]); !problem.empty())
      throw Error(where, "cannot be moved: it " + problem, "leave it out, or let --movable all choose");
    found.push_back(index);
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

vec3 place_of(const scene::Scene& scene, const Light& light, float time) {
  return vec3(scene::world_matrix(scene, light.node, time)[3]);
}

/// As few texels as are of use; where so few do not hold all charts, as coarse.
lightmap::Layout coarse_layout(const LitStage& stage) {
  const WebOptions& o = stage.options;
  const int size = o.movable_size.value_or(std::max(least_size, stage.plan.layout.width / coarser));
  try {
    return lightmap::lay_out(stage.plan.charts.charts, {.size = size, .least = 1});
  } catch (const Error&) {
    if (o.movable_size)
      throw Error(fmt::format("--movable-size {}", size), "is too small for the charts", "leave it out");
    return lightmap::lay_out(stage.plan.charts.charts,
                             {.density = stage.plan.layout.density / coarser, .least = 1});
  }
}

std::vector<std::byte> little_endian(std::span<const int> values) {
  std::vector<std::byte> out;
  for (const int value : values) {
    out.push_back(static_cast<std::byte>(value & 255));
    out.push_back(static_cast<std::byte>(value >> 8 & 255));
  }
  return out;
}

/// Of each chart its first texel and count in the scene's lightmap, and in that of lamps.
std::vector<std::byte> chart_table(const lightmap::Layout& fine, const lightmap::Layout& coarse) {
  std::vector<int> values;
  for (std::size_t i = 0; i < fine.places.size(); ++i)
    for (const lightmap::PlacedChart& place : {fine.places[i], coarse.places[i]})
      values.insert(values.end(), {place.first.x, place.first.y, place.count.x, place.count.y});
  return little_endian(values);
}

std::size_t texel_count(const lightmap::Layout& layout) {
  std::size_t count = 0;
  for (const lightmap::PlacedChart& place : layout.places)
    count += static_cast<std::size_t>(place.count.x) * static_cast<std::size_t>(place.count.y);
  return count;
}

double bytes_of(const WebLamp& lamp, const lightmap::Layout& layout) {
  return 6.0 * static_cast<double>(texel_count(layout)) * static_cast<double>(lamp.lattice.places.size());
}

void check_bytes(const WebLamp& lamp, const lightmap::Layout& layout) {
  const std::size_t texels = texel_count(layout), places = lamp.lattice.places.size();
  const double bytes = bytes_of(lamp, layout);
  if (bytes <= most_bytes) return;
  throw Error("--movable " + lamp.name,
              fmt::format("{} places of {} texels take {:.0f} MB of the browser, and {:.0f} MB is the most",
                          places, texels, bytes / 1e6, most_bytes / 1e6),
              "give a lower --movable-size, a larger --movable-step or a lower --movable-reach");
}

std::ptrdiff_t texel_offset(const image::Image& picture, const glm::ivec2& at) {
  return 3 * (std::ptrdiff_t{at.y} * picture.width + at.x);
}

/// Rounds to what may be seen beside the lamp's light: the noise of rooms that hardly get any would be most
/// of the file.
void drop_faint(image::Image& light) {
  double sum = 0;
  for (const float x : light.pixels) sum += x;
  const float least = static_cast<float>(sum / static_cast<double>(light.pixels.size())) * faint;
  if (!(least > 0)) return;
  for (float& x : light.pixels) x = std::round(x / least) * least;
}

json::Value lamp_json(const scene::Scene& scene, const WebLamp& lamp, float time) {
  const Light& light = scene.lights[lamp.light];
  const mat4 world = scene::world_matrix(scene, light.node, time);
  const pipeline::LampLattice& lattice = lamp.lattice;
  const vec3 at(world[3]), ahead = -glm::normalize(vec3(world[2])), power = light.color * light.intensity;
  const auto numbers = [](const vec3& v) { return json::Value(std::span(glm::value_ptr(v), 3)); };
  json::Value out = {
      {"name", lamp.name},           {"group", lamp.group},
      {"type", name_of(light.type)}, {"at", numbers(at)},
      {"power", numbers(power)},     {"radius", light.type == LightType::sphere ? light.radius : 0.0f},
      {"range", light.range}};
  if (light.type == LightType::spot)
    out["spot"] = {
        {"toward", numbers(ahead)}, {"inner_cone", light.inner_cone}, {"outer_cone", light.outer_cone}};
  json::Value planes = json::Value::array();
  for (const std::vector<int>& axis : lattice.planes) planes.push_back(json::Value(axis));
  out["lattice"] = {{"origin", numbers(lattice.origin)}, {"box", lattice.box},
                    {"planes", std::move(planes)},       {"boxes", lamp.boxes},
                    {"places", lattice.places.size()},   {"place_of", json::Value(lattice.place_of)}};
  out["textures"] = json::Value(lamp.textures);
  return out;
}

}  // namespace

WebLamps find_web_lamps(const LitStage& stage, std::span<const float> times, std::vector<FolderFile>& files,
                        const Control& control) {
  const WebOptions& o = stage.options;
  WebLamps lamps{&stage.scene, {}, {}, {}, o.scene.time};
  const std::vector<std::size_t> lights = lights_named(o, stage.scene);
  if (lights.empty()) return lamps;
  lamps.layout = coarse_layout(stage);
  files.push_back(hashed_file("charts", "bin", chart_table(stage.plan.layout, lamps.layout)));
  lamps.charts = files.back().name;
  for (const std::size_t index : lights) {
    const Light& light = stage.scene.lights[index];
    WebLamp& lamp =
        lamps.lamps.emplace_back(WebLamp{light.name, scene::light_group(light), index, {}, {}, {}});
    pipeline::LampLatticeParams params{.reach = o.movable_reach};
    if (light.type == LightType::spot) params.spacing = spot_spacing;
    if (o.movable_step) params.spacing = *o.movable_step;
    if (light.type == LightType::sphere) params.radius = light.radius;
    try {
      do {  // farther apart where they are too many and nobody asked for so many
        lamp.lattice = pipeline::lamp_lattice(stage.source, times, place_of(stage.scene, light, o.scene.time),
                                              params, control);
        params.spacing *= 1.5f;
      } while (!o.movable_step && params.spacing < 2 * o.movable_reach &&
               bytes_of(lamp, lamps.layout) > most_bytes);
    } catch (const Error& error) {
      throw Error("--movable " + light.name, error.what());
    }
    check_bytes(lamp, lamps.layout);
    const auto seen = std::as_bytes(std::span(lamp.lattice.seen));
    files.push_back(
        hashed_file(fmt::format("boxes-{}", lamps.lamps.size() - 1), "bin", {seen.begin(), seen.end()}));
    lamp.boxes = files.back().name;
  }
  return lamps;
}

void add_lamp_pose(const LitStage& stage, const probes::ProbeSet& set, float time, WebLamps& lamps,
                   std::vector<FolderFile>& files, const Control& control) {
  if (lamps.lamps.empty()) return;
  const trace::PathTracer tracer(stage.geometry, stage.scene, time);
  const lightmap::Texels texels =
      lightmap::make_texels(stage.plan.scene, time, stage.plan.charts.charts, lamps.layout, control);
  const lightmap::Places places =
      lightmap::find_places(texels, rays::PosedWorld(stage.source, time), control);
  pipeline::LampLight light(stage.source, tracer, set, places.points, control);
  for (std::size_t i = 0; i < lamps.lamps.size(); ++i) {
    WebLamp& lamp = lamps.lamps[i];
    // A row for each place.
    image::Image all(static_cast<int>(texel_count(lamps.layout)),
                     static_cast<int>(lamp.lattice.places.size()), 3);
    auto to = all.pixels.begin();
    ProgressStage progress(control, "light of " + lamp.name, lamp.lattice.places.size(), "places");
    for (const vec3& place : lamp.lattice.places) {
      const std::span<const vec3> found = light.at(lamp.light, place, control);
      const auto irradiance = [&](const rays::SurfacePoint& at) {
        return found[static_cast<std::size_t>(&at - places.points.data())];
      };
      const image::Image atlas = lightmap::light_texels(texels, places, irradiance, nullptr, control);
      for (const lightmap::PlacedChart& chart : lamps.layout.places)
        for (int y = 0; y < chart.count.y; ++y)
          to = std::copy_n(atlas.pixels.begin() + texel_offset(atlas, chart.first + glm::ivec2(0, y)),
                           3 * chart.count.x, to);
      progress.advance(1);
    }
    drop_faint(all);
    files.push_back(
        hashed_file(fmt::format("moved-{}-{}", i, lamp.textures.size()), "bin", packed_light(all)));
    lamp.textures.push_back(files.back().name);
  }
}

json::Value to_json(const WebLamps& lamps) {
  json::Value list = json::Value::array();
  for (const WebLamp& lamp : lamps.lamps) list.push_back(lamp_json(*lamps.scene, lamp, lamps.time));
  return {{"width", lamps.layout.width},
          {"height", lamps.layout.height},
          {"charts", lamps.charts},
          {"lamps", std::move(list)}};
}

}  // namespace ssphh::app

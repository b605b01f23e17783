// Lamps that come, go and are aimed.

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene_io/ies.h>

#include "app.h"
#include "model/lamp_aim.h"
#include "model/lamp_profile.h"
#include "model/lengths.h"
#include "model/pick.h"

namespace ssphh::viewer {
namespace {

/// How far the handle of a lamp stands from a surface that it is added at, at most, in the shortest lengths
/// that somebody looks at, and in shares of how far away that surface is.
constexpr float off_surface = 5, off_distance = 0.05f;

}  // namespace

void App::add_lamp(scene::LightType type) {
  const rays::RayQuery middle = pixel_ray(view, {0.5f, 0.5f}, viewport.aspect());
  vec3 place = view.center();
  const float least = lengths_of(document.bounds).least;
  float distance = std::max(view.focus, least);
  if (const auto surface = pick_surface(*picking_, document.time, middle)) {
    const float depth = glm::distance(surface->position, view.eye);
    const rays::RayQuery off{surface->position + 0.01f * least * surface->normal, surface->normal, 1e4f};
    const auto ceiling = pick_surface(*picking_, document.time, off);
    const float room = ceiling ? glm::distance(ceiling->position, off.origin) : depth;
    const float off_it = std::max(off_surface * least, off_distance * depth);
    place = surface->position + std::min({off_it, 0.5f * room, 0.5f * depth}) * surface->normal;
    distance = std::min(depth, room);
  }
  add_lamp(new_lamp(type, new_lamp_name(document.edits(), std::string(name_of(type))), place,
                    std::max(distance, least), settings.exposure));
}

void App::add_lamp(LightEdit lamp) {
  const std::string name = lamp.lamp.name;
  document.edit_at_once("add " + name, [&](Edits& e) { e.lights.push_back(std::move(lamp)); });
  selection = {Kind::light, static_cast<int>(document.edits().lights.size()) - 1};
  // A bake has the light of the lamps that it was made with.
  const bool fixed = !light.empty() && !light.live();
  say(fixed ? fmt::format("{}: direct light only. The probes of {} were lit without it; \u201cLight them "
                          "live\u201d in the panel Probes lights them with it.",
                          name, light.origin())
            : name);
}

void App::duplicate_lamp() {
  if (!selection.is(Kind::light)) return;
  const auto i = static_cast<std::size_t>(selection.index);
  LightEdit copy = document.edits().lights[i];
  copy.world = document.lighting().lights[i].world;
  if (has_place(copy.lamp.type))
    copy.world = with_position(*copy.world, light_position(*copy.world) + 0.1f * view.focus * view.right());
  copy.source = -1;
  copy.lamp.name = new_lamp_name(document.edits(), copy.lamp.name);
  copy.lamp.group.clear();
  add_lamp(std::move(copy));
}

void App::delete_lamp() {
  const auto i = selection.index;
  const std::string name = document.scene->lights[i].name;
  document.edit_at_once("delete " + name, [&](Edits& e) { e.lights.erase(e.lights.begin() + i); });
  selection = {};
  say("deleted: " + name);
}

void App::set_lamp_profile(std::size_t lamp, const scene::LampProfile& profile) {
  const std::string name = document.edits().lights[lamp].lamp.name;
  const mat4 world = document.lighting().lights[lamp].world;
  document.edit_at_once("profile of " + name, [&](Edits& e) { set_profile(e.lights[lamp], profile, world); });
  say(profile.empty() ? name + " shines as before, without a profile"
                      : fmt::format("{} shines as {}, up to {:g} cd there", name, profile.name,
                                    scene::greatest_candela(*profile.table)));
}

void App::take_profile(const std::string& file) {
  if (!selection.is(Kind::light))
    throw Error(file, "is the photometric profile of a lamp, and no lamp is selected",
                "select a point or spot lamp first");
  set_lamp_profile(static_cast<std::size_t>(selection.index), scene_io::read_ies(file));
}

void App::take_surroundings(const std::string& file) {
  if (!scene_open()) throw Error(file, "is a picture of a sky, and no scene is open", "open a scene first");
  std::optional<Surroundings> around;
  if (!file.empty()) around = read_surroundings(file);
  const bool fixed = !light.empty() && !light.live();
  document.edit_at_once(around ? "the sky" : "the scene's own sky", [&](Edits& e) {
    if (around) e.sky.reset();
    e.surroundings = around;
  });
  const std::string name = std::filesystem::path(file).filename().string();
  say(file.empty() ? "the sky is the scene's own again"
      : fixed      ? fmt::format("{} is the sky of direct light. The probes of {} were lit without it; "
                                      "“Light them live” in the panel Probes lights them with it.",
                                 name, light.origin())
                   : fmt::format("{} is the sky", name));
}

bool App::can_aim() const {
  if (!selection.is(Kind::light)) return false;
  const Lamp& lamp = document.edits().lights[selection.index].lamp;
  return has_direction(lamp.type, lamp.profile);
}

std::optional<vec3> App::aim_origin() const {
  if (!can_aim()) return {};
  return selected_position().value_or(view.center());
}

void App::turn_selected(const vec3& direction) {
  if (!can_aim() || !(glm::length(direction) > 1e-6f)) return;
  const auto i = static_cast<std::size_t>(selection.index);
  const mat4 world = document.lighting().lights[i].world;
  document.edit("aim " + document.scene->lights[i].name,
                [&](Edits& e) { e.lights[i].world = aimed(e.lights[i].lamp, world, direction); });
  redraw();
}

void App::pose_selected(const mat4& world) {
  if (!can_aim()) return;
  const auto i = static_cast<std::size_t>(selection.index);
  document.edit("turn " + document.scene->lights[i].name, [&](Edits& e) { e.lights[i].world = world; });
  redraw();
}

void App::aim_at(const vec3& point) {
  if (const auto from = selected_position()) turn_selected(point - *from);
}

bool App::aim_on_ray(const rays::RayQuery& ray) {
  if (!can_aim()) return false;
  const auto surface = pick_surface(*picking_, document.time, ray);
  if (selected_position()) {
    if (surface) aim_at(surface->position);
    return surface.has_value();
  }
  turn_selected(surface ? -surface->normal : -ray.direction);
  return true;
}

}  // namespace ssphh::viewer

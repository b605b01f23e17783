#include "script_player.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include <ssphh/scene_io/ies.h>

#include "injection.h"
#include "model/lamp_aim.h"
#include "model/lamp_profile.h"
#include "model/overlay_file.h"
#include "model/ring.h"
#include "model/sky_edit.h"

namespace ssphh::viewer {

const char* const script_help =
    "set NAME VALUE | time T | camera NAME | view X Y Z TO_X TO_Y TO_Z | tab NAME | "
    "add-camera NAME | add-light point|spot|directional|sphere|sphl NAME X Y Z | light NAME delete | "
    "light NAME duplicate | light NAME aim X Y Z | light NAME on|off | light NAME color R G B | "
    "light NAME profile FILE|none | light NAME turn DEGREES | light NAME pan-tilt PAN TILT | light NAME "
    "position X Y Z | light NAME "
    "intensity V (radius, range, "
    "outer-cone, inner-cone, diameter) | "
    "group NAME FACTOR | environment DEGREES | sun ELEVATION AZIMUTH | time-of-day HH:MM | material NAME R G "
    "B | select light|sphl|material|object NAME "
    "| sphl "
    "X Y Z | "
    "probes auto|auto:M|scene|FILE | gen | viz | bookmark | undo | redo | key NAME | click X Y | "
    "drag X Y TO_X TO_Y [right] | wait FRAMES | settle | screenshot FILE [panels] | save FILE | quit";

namespace {

float number(const ScriptLine& line, std::size_t word) {
  return number_of(line.where, line.words[word]);
}

vec3 vector(const ScriptLine& line, std::size_t word) {
  return {number(line, word), number(line, word + 1), number(line, word + 2)};
}

template <class Items, class Name>
std::size_t find_named(const ScriptLine& line, const Items& items, const std::string& name,
                       const Name& name_of) {
  const auto found = std::ranges::find_if(items, [&](const auto& i) { return name_of(i) == name; });
  if (found == items.end()) {
    std::string known;
    for (const auto& item : items) known += (known.empty() ? "" : ", ") + name_of(item);
    throw Error(line.where, fmt::format("there is no \"{}\"", name), "there are: " + known);
  }
  return static_cast<std::size_t>(found - items.begin());
}

const auto by_name = [](const auto& item) { return item.name; };

void edit_light(App& app, const ScriptLine& line) {
  if (line.words.size() < 3) expect_words(line, 2, "light NAME on");
  const std::size_t i = find_named(line, app.document.scene->lights, line.words[1], by_name);
  const std::string& what = line.words[2];
  const mat4 world = app.document.lighting().lights[i].world;
  app.document.history.seal();
  const auto edit = [&](const auto& change) {
    app.document.edit(fmt::format("{} of {}", what, line.words[1]), [&](Edits& e) { change(e.lights[i]); });
  };
  if (what == "on" || what == "off") {
    expect_words(line, 2, "light NAME on|off");
    edit([&](LightEdit& light) { light.on = what == "on"; });
  } else if (what == "delete" || what == "duplicate") {
    expect_words(line, 2, "light NAME delete|duplicate");
    app.selection = {Kind::light, static_cast<int>(i)};
    what == "delete" ? app.delete_selection() : app.duplicate_lamp();
  } else if (what == "aim") {
    expect_words(line, 5, "light NAME aim X Y Z");
    app.selection = {Kind::light, static_cast<int>(i)};
    app.aim_at(vector(line, 3));
  } else if (what == "color") {
    expect_words(line, 5, "light NAME color R G B");
    edit([&](LightEdit& light) { light.color = glm::max(vector(line, 3), vec3(0)); });
  } else if (what == "profile") {
    expect_words(line, 3, "light NAME profile FILE|none");
    const std::string& file = line.words[3];
    app.set_lamp_profile(i, file == "none" ? scene::LampProfile{} : scene_io::read_ies(file));
  } else if (what == "turn") {
    expect_words(line, 3, "light NAME turn DEGREES");
    const float turn = glm::radians(number(line, 3));
    edit([&](LightEdit& light) { light.world = with_turn(world, turn); });
  } else if (what == "pan-tilt") {
    expect_words(line, 4, "light NAME pan-tilt PAN TILT");
    app.selection = {Kind::light, static_cast<int>(i)};
    if (!app.can_aim())
      throw Error(line.where, fmt::format("{} shines alike in all directions", line.words[1]));
    app.turn_selected(direction_of({number(line, 3), std::clamp(number(line, 4), -90.0f, 90.0f)}));
  } else if (what == "position") {
    expect_words(line, 5, "light NAME position X Y Z");
    edit([&](LightEdit& light) { light.world = with_position(world, vector(line, 3)); });
  } else {
    // Numbers, by their names in the panel
    std::string name = what;
    std::ranges::replace(name, '-', ' ');
    std::vector<std::string> known = {"on",    "off",     "delete", "duplicate", "aim",
                                      "color", "profile", "turn",   "pan-tilt",  "position"};
    for (const LampNumber& n : lamp_numbers(app.document.edits().lights[i])) known.emplace_back(n.name);
    if (std::ranges::find(known, name) == known.end()) throw Error(line.where, none_of(what, known));
    expect_words(line, 3, "light NAME intensity V");
    edit([&](LightEdit& light) { set_lamp_number(light, name, number(line, 3)); });
  }
  app.document.history.seal();
}

void add_light(App& app, const ScriptLine& line) {
  const auto type = enum_named<scene::LightType>(line.where, line.words[1]);
  LightEdit lamp = new_lamp(type, new_lamp_name(app.document.edits(), "lamp"), vector(line, 3),
                            std::max(app.view.focus, 0.1f), app.settings.exposure);
  Edits named = app.document.edits();
  named.lights.push_back(lamp);
  rename_lamp(named, named.lights.size() - 1, line.words[2]);
  lamp.lamp.name = line.words[2];
  app.add_lamp(std::move(lamp));
}

void select(App& app, const ScriptLine& line) {
  expect_words(line, 2, "select light|sphl|material|object NAME");
  const std::string &kind = line.words[1], &name = line.words[2];
  const auto take = [&](Kind k, const auto& items) {
    app.selection = {k, static_cast<int>(find_named(line, items, name, by_name))};
  };
  const std::optional<Kind> what = value_in(selectable_kinds, kind);
  if (what == Kind::light) return take(Kind::light, app.document.scene->lights);
  if (what == Kind::sphl) return take(Kind::sphl, app.document.edits().sphls);
  if (what == Kind::material) return take(Kind::material, app.document.edits().materials);
  if (what == Kind::object) return take(Kind::object, app.document.scene->nodes);
  throw Error(line.where, none_of(kind, names_in(selectable_kinds)));
}

void save(App& app, const std::string& file) {
  if (file.ends_with(".glb") || file.ends_with(overlay_ending)) return app.save_scene(file);
  if (is_probe_file(file)) return app.save_probes(file);
  if (file.ends_with(".csv") || file.ends_with(".stats.json")) return app.save_stats(file);
  app.save_path(file);
}

}  // namespace

void ScriptPlayer::press(const ScriptLine& line) {
  expect_words(line, 1, "key NAME");
  std::string name = line.words[1];
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  InjectedInput input;
  for (const auto& [prefix, flag] : {std::pair{"ctrl+", &input.ctrl}, {"shift+", &input.shift}}) {
    if (name.starts_with(prefix)) name.erase(0, std::string_view(prefix).size()), *flag = true;
  }
  const std::optional<int> key = key_by_name(name);
  if (!key) throw Error(line.where, fmt::format("there is no key \"{}\"", line.words[1]));
  input.keys = {*key};
  input_ = {input, {}};
}

void ScriptPlayer::move_mouse(const ScriptLine& line) {
  const bool click = line.words[0] == "click";
  const bool right = line.words.back() == "right";
  if (click) {
    expect_words(line, 2, "click X Y");
  } else {
    expect_words(line, right ? 5 : 4, "drag X Y TO_X TO_Y [right]");
  }
  const std::array<float, 2> from{number(line, 1), number(line, 2)};
  const std::array<float, 2> to = click ? from : std::array<float, 2>{number(line, 3), number(line, 4)};
  constexpr int steps = 6;
  const std::array<bool, 3> down{!right, right, false};
  input_ = {{from, {}, {}}, {from, down, {}}};
  for (int i = 1; i <= steps && !click; ++i) {
    const float s = static_cast<float>(i) / steps;
    input_.push_back(
        {std::array<float, 2>{from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])}, down, {}});
  }
  input_.push_back({to, {}, {}});
  input_.push_back({to, {}, {}});
}

void ScriptPlayer::run(App& app, const ScriptLine& line) {
  const std::vector<std::string>& words = line.words;
  const std::string& verb = words[0];
  const auto expect = [&](std::size_t count, const char* usage) { expect_words(line, count, usage); };
  if (verb == "set") {
    expect(2, "set NAME VALUE");
    set_setting(app.settings, words[1], words[2]);
  } else if (verb == "time") {
    expect(1, "time SECONDS");
    app.document.time = std::clamp(number(line, 1), 0.0f, app.document.duration);
  } else if (verb == "camera") {
    expect(1, "camera NAME");
    app.go_to_camera(words[1]);
  } else if (verb == "add-camera") {
    expect(1, "add-camera NAME");
    app.save_camera(words[1]);
  } else if (verb == "add-light") {
    expect(5, "add-light TYPE NAME X Y Z");
    add_light(app, line);
  } else if (verb == "view") {
    expect(6, "view X Y Z TO_X TO_Y TO_Z");
    app.view = look_at(vector(line, 1), vector(line, 4), app.view.yfov);
  } else if (verb == "tab") {
    expect(1, "tab NAME");
    app.open_tab = words[1];
  } else if (verb == "light") {
    edit_light(app, line);
  } else if (verb == "group") {
    expect(2, "group NAME FACTOR");
    const std::vector<std::string> groups = scene::light_groups(*app.document.scene);
    find_named(line, groups, words[1], [](const std::string& g) { return g; });
    app.document.edit("scale " + words[1],
                      [&](Edits& e) { e.groups[words[1]] = vec3(std::max(number(line, 2), 0.0f)); });
  } else if (verb == "environment") {
    expect(1, "environment DEGREES");
    if (!app.document.scene->environment) throw Error(line.where, "the scene has no environment");
    const float turn = glm::radians(number(line, 1));
    app.document.edit("turn the environment", [&](Edits& e) { e.environment_rotation = turn; });
  } else if (verb == "sun" || verb == "time-of-day") {
    const auto shown = shown_sky(app.document);
    if (!shown)
      throw Error(line.where, "the scene has no computed sky", "start the viewer with --sky physical");
    scene::SunSkyParams sky = *shown;
    if (verb == "sun") {
      expect(2, "sun ELEVATION AZIMUTH");
      sky.elevation = glm::radians(number(line, 1)), sky.azimuth = glm::radians(number(line, 2) - 90);
      sky.time.reset();
    } else {
      expect(1, "time-of-day HH:MM");
      sky = at_hour(sky, scene::read_hour(words[1], line.where));
    }
    change_sky(app.document, sky);
  } else if (verb == "material") {
    expect(4, "material NAME R G B");
    const std::size_t i = find_named(line, app.document.edits().materials, words[1], by_name);
    app.document.edit("material " + words[1], [&](Edits& e) {
      e.materials[i].base_color = glm::clamp(vector(line, 2), vec3(0), vec3(1));
    });
  } else if (verb == "select") {
    select(app, line);
  } else if (verb == "sphl") {
    expect(3, "sphl X Y Z");
    app.add_sphl(vector(line, 1));
  } else if (verb == "probes") {
    expect(1, "probes auto|auto:M|scene|FILE");
    app.use_probes(words[1]);
  } else if (verb == "gen" || verb == "viz") {
    expect(0, "gen");
    app.start_gen(verb == "viz");
  } else if (verb == "bookmark") {
    app.add_bookmark();
  } else if (verb == "undo") {
    app.undo();
  } else if (verb == "redo") {
    app.redo();
  } else if (verb == "key") {
    press(line);
  } else if (verb == "click" || verb == "drag") {
    move_mouse(line);
  } else if (verb == "wait") {
    expect(1, "wait FRAMES");
    wait_frames_ = static_cast<int>(number(line, 1));
  } else if (verb == "settle") {
    settling_ = true;
  } else if (verb == "screenshot") {
    const bool panels = words.size() == 3 && words[2] == "panels";
    expect(panels ? 2 : 1, "screenshot FILE [panels]");
    app.screenshot(words[1], panels);
    wait_frames_ = panels ? 1 : 0;
    settling_ = is_linear_picture(words[1]);
  } else if (verb == "save") {
    expect(1, "save FILE");
    save(app, words[1]);
  } else if (verb == "quit") {
    app.window.close();
  } else {
    throw Error(line.where, fmt::format("there is no command \"{}\"", verb), script_help);
  }
}

InjectedInput ScriptPlayer::next(App& app) {
  if (done()) return {};
  // While others work there is nothing new to draw until they hand something over.
  if (!settling_ || !(app.job.running() || app.reference.status().running || app.marks.status().running))
    app.redraw();
  if (!input_.empty()) {
    InjectedInput input = input_.front();
    input_.pop_front();
    return input;
  }
  if (wait_frames_ > 0) {
    --wait_frames_;
    return {};
  }
  if (settling_ && (!app.current() || app.take_exposure() || !app.settled())) {
    // Nobody is there to choose between waiting and a bake of this machine.
    if (app.farm && app.farm->used && app.baking()) {
      if (const std::string failure = app.farm->failure(); !failure.empty())
        throw Error(lines_[at_ - 1].where, failure);
      if (app.farm->lost())
        throw Error(lines_[at_ - 1].where,
                    fmt::format("the bake waits for {}, whose broker does not answer", app.farm->endpoint()),
                    "start it again, or leave out --broker");
    }
    return {};
  }
  settling_ = false;
  if (at_ < lines_.size()) {
    const ScriptLine& line = lines_[at_++];
    try {
      run(app, line);
    } catch (const Error& e) {
      // Errors of actions do not know which line asked for them.
      if (e.where() == line.where) throw;
      throw Error(line.where, e.what());
    }
  }
  return {};
}

}  // namespace ssphh::viewer

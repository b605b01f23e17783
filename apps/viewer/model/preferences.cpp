#include "preferences.h"

#include <algorithm>

#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>

namespace ssphh::viewer {
namespace {

constexpr const char* preferences_format = "ssphh-preferences";
constexpr int preferences_version = 1;

}  // namespace

std::string lasting_name(const std::string& source) {
  if (source.starts_with("builtin:")) return source;
  return std::filesystem::absolute(source).lexically_normal().string();
}

Preferences read_preferences(const std::filesystem::path& file) {
  Preferences preferences;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return preferences;
  const std::string name = file.string();
  const json::Value value = json::parse(read_text_file(file, 1 << 20), name);
  const json::Cursor in(value, name);
  in.expect_format(preferences_format, preferences_version);
  in.members({"format", "version"}, {"recent", "side_width", "histogram", "waveform", "false_color",
                                     "quality", "snap", "snap_angle_degrees"});
  if (in.has("recent")) {
    for (const json::Cursor& scene : json::elements(in["recent"]))
      preferences.recent.push_back(scene.text(4096));
  }
  WindowLook& look = preferences.look;
  if (in.has("side_width")) look.side_width = in["side_width"].number(0, 1000);
  look.histogram = in.boolean_or("histogram", false);
  look.waveform = in.boolean_or("waveform", false);
  look.false_color = in.boolean_or("false_color", false);
  if (in.has("quality")) look.quality = in["quality"].named<Quality>();
  look.snap = in.boolean_or("snap", look.snap);
  if (in.has("snap_angle_degrees")) look.snap_angle = in["snap_angle_degrees"].number(0.1f, 180);
  return preferences;
}

void write_preferences(const Preferences& preferences, const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  const json::Value out = {{"format", preferences_format},
                           {"version", preferences_version},
                           {"recent", preferences.recent},
                           {"side_width", preferences.look.side_width},
                           {"histogram", preferences.look.histogram},
                           {"waveform", preferences.look.waveform},
                           {"false_color", preferences.look.false_color},
                           {"quality", name_of(preferences.look.quality)},
                           {"snap", preferences.look.snap},
                           {"snap_angle_degrees", preferences.look.snap_angle}};
  write_file(file, json::print(out, 2) + "\n");
}

void remember(Preferences& preferences, const std::string& source) {
  forget(preferences, source);
  preferences.recent.insert(preferences.recent.begin(), lasting_name(source));
  if (preferences.recent.size() > Preferences::most_recent)
    preferences.recent.resize(Preferences::most_recent);
}

void forget(Preferences& preferences, const std::string& source) {
  std::erase(preferences.recent, lasting_name(source));
}

}  // namespace ssphh::viewer

#include "overlay_paths.h"

#include <cstdlib>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene_io/overlay.h>

#include "printable.h"

namespace ssphh::scene_io {

std::string expand_variables(std::string_view text, const std::string& where) {
  std::string out;
  while (!text.empty()) {
    const auto begin = text.find("${");
    out += text.substr(0, begin);
    if (begin == text.npos) break;
    const auto end = text.find('}', begin);
    if (end == text.npos) throw Error(where, "a \"${\" is not closed");
    std::string_view name = text.substr(begin + 2, end - begin - 2);
    text.remove_prefix(end + 1);
    std::optional<std::string_view> fallback;
    if (const auto dash = name.find(":-"); dash != name.npos) {
      fallback = name.substr(dash + 2);
      name = name.substr(0, dash);
    }
    if (!name.starts_with("SSPHH_")) {
      throw Error(where, fmt::format("the variable {} is not allowed", printable(name, 40)),
                  "only names that begin with SSPHH_ are");
    }
    const char* value = std::getenv(std::string(name).c_str());
    if (value && *value) {
      // As a shell means it: where the user stands, not where the overlay lies.
      out += out.empty() ? std::filesystem::absolute(value).string() : value;
    } else if (fallback) {
      out += *fallback;
    } else {
      throw Error(where, fmt::format("the environment variable {} is not set", printable(name, 40)));
    }
  }
  return out;
}

std::filesystem::path overlay_path(const json::Cursor& member, const std::filesystem::path& overlay) {
  const std::filesystem::path named = expand_variables(member.text(), member.file() + ": " + member.path());
  if (named.empty() || named.native().find('\0') != std::string::npos) member.fail("must be a file name");
  return named.is_absolute() ? named : overlay.parent_path() / named;
}

std::string overlay_scene(std::string_view text, const std::filesystem::path& path) {
  const std::string file = path.string();
  const json::Value json = json::parse(text, file);
  const json::Cursor root(json, file);
  const auto scene = root.find("scene");
  if (!scene)
    root.fail("\"scene\" is missing", "a JSON file is a scene when it names one: {\"scene\": \"FILE.glb\"}");
  if (scene->text().starts_with("builtin:")) return scene->text();
  return overlay_path(*scene, path).string();
}

}  // namespace ssphh::scene_io

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/file.h>
#include <ssphh/core/json.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/obj.h>
#include <ssphh/scene_io/overlay.h>
#include <ssphh/scene_io/unit.h>

#include "file_bytes.h"
#include "overlay_paths.h"

namespace ssphh::scene_io {
namespace {

namespace fs = std::filesystem;
using scene::Scene;

constexpr std::string_view builtin_prefix = "builtin:";
constexpr std::uint64_t max_scene_bytes = std::uint64_t{4} << 30;

enum class Format { gltf, obj, overlay };

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Format format_of(std::span<const std::byte> data, const fs::path& path) {
  const std::string_view text = as_text(data);
  const std::string extension = lower_extension(path);
  if (text.starts_with("glTF") || extension == ".gltf") return Format::gltf;
  const auto first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first != text.npos && text[first] == '{') {
    const std::string file = path.string();
    const json::Value json = json::parse(text, file);
    return json.contains("asset") ? Format::gltf : Format::overlay;
  }
  if (extension == ".obj") return Format::obj;
  if (extension == ".glb") throw Error(path.string(), "is no GLB file: it does not begin with \"glTF\"");
  throw Error(path.string(), "is no scene of a known format",
              "known are glTF 2.0 (.gltf, .glb), Wavefront OBJ (.obj) and overlays (.ssphh.json)");
}

// A builtin scene or a scene file, not an overlay.
Scene load_plain(const std::string& source, const std::vector<std::byte>* data, float time) {
  if (source.starts_with(builtin_prefix)) return scene::make_builtin(source.substr(builtin_prefix.size()));
  std::vector<std::byte> own;
  if (!data) {
    own = read_file(source, max_scene_bytes);
    data = &own;
  }
  const Format format = format_of(*data, source);
  if (format == Format::gltf) return load_gltf(*data, source, time);
  if (format == Format::obj) return load_obj(as_text(*data), source);
  throw Error(source, "is an overlay; one cannot stand on another");
}

void check_size(const Scene& scene, const std::string& source) {
  const auto bounds = scene::world_bounds(scene, scene::world_matrices(scene));
  if (bounds.empty()) return;
  const float size = 2 * bounds.radius();
  if (size > 2000) {
    log_warning(
        "{}: is {:.0f} m across; if its unit is no metre, say so: --unit mm, cm, inch or auto, or in an "
        "overlay: "
        "{{\"unit\": 0.001}}",
        source, size);
  }
  if (size > 0 && glm::length(bounds.center()) > 100 * size) {
    log_warning(
        "{}: lies {:.3g} m from the origin and is {:.3g} m across, which costs precision; move it with "
        "\"origin\" in an overlay",
        source, glm::length(bounds.center()), size);
  }
}

}  // namespace

fs::path overlay_beside(const std::string& source) {
  return fs::path(source).replace_extension(".ssphh.json");
}

Scene load_scene(const std::string& source, const LoadOptions& options) {
  require(std::isfinite(options.environment_intensity) && options.environment_intensity >= 0 &&
              std::isfinite(options.environment_rotation),
          "environment", "its intensity and rotation must be finite, the first not negative");
  if (const auto problem = unit_problem(options.unit); !options.unit.empty() && !problem.empty())
    throw Error("unit", problem);
  require(std::isfinite(options.time), "time", "it must be a finite number of seconds");
  // Read the scene, through the overlay that names it if SOURCE is one
  fs::path overlay = options.overlay;
  bool in_metres = options.unit.empty();  // or in what overlays say
  Scene scene;
  const auto overlay_with = [&](std::string_view text, const fs::path& path) {
    apply_overlay(scene, text, path, in_metres && !options.unit.empty() ? "m" : options.unit);
    in_metres = true;
  };
  if (source.starts_with(builtin_prefix)) {
    scene = load_plain(source, nullptr, options.time);
  } else {
    const auto data = read_file(source, max_scene_bytes);
    if (format_of(data, source) == Format::overlay) {
      const std::string named = overlay_scene(as_text(data), source);
      scene = load_plain(named, nullptr, options.time);
      overlay_with(as_text(data), source);
    } else {
      scene = load_plain(source, &data, options.time);
      const fs::path beside = overlay_beside(source);
      std::error_code unreadable;
      if (overlay.empty() && fs::exists(beside, unreadable)) overlay = beside;
    }
  }
  if (!overlay.empty()) {
    overlay_with(read_text_file(overlay, max_overlay_bytes), overlay);
  }
  if (!in_metres) set_unit(scene, metres_per_unit(options.unit, scene, source));

  if (!options.environment.empty()) {
    scene::Environment environment;
    environment.equirect = image::read_image(options.environment);
    environment.color = vec3(options.environment_intensity);
    environment.rotation = options.environment_rotation;
    scene.environment = std::move(environment);
  } else if (scene.environment) {
    scene.environment->rotation += options.environment_rotation;
  }

  if (options.sun_sky) scene::add_sun_sky(scene, *options.sun_sky);

  for (const std::string& group : scene::drop_unused_light_modes(scene))
    log_warning("{}: the light mode of \"{}\" is not used: its lights were replaced", source, group);

  for (const auto& repair : scene::validate(scene)) log_warning("{}: {}", source, repair);
  if (!options.keep_dark_light) scene = scene::without_dark_light(std::move(scene));
  if (scene.instances.empty()) log_warning("{}: shows no triangles", source);
  if (!scene.ignored.empty()) log_warning("{}: ignored: {}", source, fmt::join(scene.ignored, ", "));
  check_size(scene, source);
  return scene;
}

}  // namespace ssphh::scene_io

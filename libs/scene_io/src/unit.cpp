#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/unit.h>

#include "printable.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;

struct NamedUnit {
  std::string_view name;
  float metres;
};
constexpr std::array named_units = {NamedUnit{"mm", 0.001f}, NamedUnit{"cm", 0.01f}, NamedUnit{"m", 1},
                                    NamedUnit{"inch", 0.0254f}};
constexpr std::string_view automatic = "auto";

std::optional<float> told_unit(std::string_view text) {
  for (const NamedUnit& unit : named_units)
    if (unit.name == text) return unit.metres;
  float value = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (wrong != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

/// In the file's unit.
struct Extent {
  double width, height;
};

/// From the first to the last percent of the vertices that are seen.
Extent extent_of(const Scene& scene) {
  constexpr std::size_t enough = 200'000;
  scene::check_indices(scene);
  std::size_t count = 0;
  for (const auto& instance : scene.instances) count += scene.meshes[instance.mesh].positions.size();
  const std::size_t step = count / enough + 1;
  const auto world = scene::world_matrices(scene);
  std::array<std::vector<float>, 3> along;
  std::size_t next = 0, begin = 0;
  for (const auto& instance : scene.instances) {
    const auto& positions = scene.meshes[instance.mesh].positions;
    const mat4 m = instance.node < 0 ? mat4(1) : world[instance.node];
    for (; next < begin + positions.size(); next += step) {
      const vec3 p(m * vec4(positions[next - begin], 1));
      for (int axis = 0; axis < 3; ++axis) along[axis].push_back(p[axis]);
    }
    begin += positions.size();
  }
  const auto length = [](std::vector<float>& values) {
    if (values.empty()) return 0.0;
    const auto at = [&](std::size_t i) {
      const auto place = values.begin() + static_cast<std::ptrdiff_t>(i);
      std::ranges::nth_element(values, place);
      return static_cast<double>(*place);
    };
    const std::size_t cut = values.size() / 100;
    return at(values.size() - 1 - cut) - at(cut);
  };
  return {std::max(length(along[0]), length(along[2])), length(along[1])};
}

/// How far a length lies from the usual one: (ln(length / usual) / spread)².
double strangeness(double length, double usual, double spread_below, double spread_above) {
  const double d = std::log(length / usual);
  return std::pow(d / (d < 0 ? spread_below : spread_above), 2);
}

/// Of a place for people [m]: some 12 m wide, give or take a factor of three; 3 m high, seldom lower.
double strangeness(const Extent& extent, double unit) {
  const double wide = strangeness(extent.width * unit, 12, 1.1, 1.1);
  return extent.height > 0 ? wide + strangeness(extent.height * unit, 3.2, 0.3, 1.1) : wide;
}

}  // namespace

std::string unit_problem(const std::string& unit) {
  if (unit == automatic || told_unit(unit)) return {};
  return fmt::format(
      "\"{}\" is no unit of length: mm, cm, m, inch, auto, or metres per unit as a number above 0",
      printable(unit, 40));
}

float guess_unit(const Scene& scene) {
  constexpr double plausible_width = 100, clearly = 4;
  const Extent extent = extent_of(scene);
  if (!(extent.width > plausible_width)) return 1;
  float best = 1;
  double least = strangeness(extent, 1) - clearly;
  for (const float unit : {0.01f, 0.001f}) {
    const double strange = strangeness(extent, unit);
    if (strange < least) least = strange, best = unit;
  }
  return best;
}

float metres_per_unit(const std::string& unit, const Scene& scene, const std::string& where) {
  if (const auto told = told_unit(unit)) return *told;
  if (unit != automatic) throw Error(where, unit_problem(unit));
  const float guess = guess_unit(scene);
  if (guess != 1) {
    const Extent extent = extent_of(scene);
    log_warning(
        "{}: would be {:.3g} m wide and {:.3g} m high: its unit is taken for the {} (--unit m, or another, "
        "overrules this)",
        where, extent.width, extent.height, guess == 0.01f ? "centimetre" : "millimetre");
  }
  return guess;
}

void set_unit(Scene& scene, float unit, const vec3& origin) {
  require(std::isfinite(unit) && unit > 0, "unit", "must be finite and greater than 0");
  require(is_finite(origin), "origin", "must be finite");
  scene::Node root;
  root.name = "unit";
  root.local.scale = vec3(unit);
  root.local.translation = vec3(-glm::dvec3(origin) * double{unit});
  scene.nodes.insert(scene.nodes.begin(), root);
  for (std::size_t i = 1; i < scene.nodes.size(); ++i) ++scene.nodes[i].parent;
  const auto shift = [](auto& items) {
    for (auto& item : items) ++item.node;
  };
  shift(scene.instances);
  shift(scene.cameras);
  shift(scene.lights);
  shift(scene.sphls);
  for (auto& animation : scene.animations) shift(animation.channels);
  for (auto& light : scene.lights) light.range *= unit;
  for (auto& material : scene.materials) material.thickness *= unit, material.attenuation_distance *= unit;
  for (auto& camera : scene.cameras)
    if (camera.orthographic) camera.yheight *= unit;
}

}  // namespace ssphh::scene_io

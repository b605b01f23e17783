#pragma once
/// Charts: pieces of still surfaces laid flat, each of which becomes a rectangle of a lightmap.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/scene/scene.h>

namespace ssphh::lightmap {

/// A triangle of a mesh as it lies on its chart.
struct FlatTriangle {
  std::uint32_t triangle = 0;  ///< of the instance's mesh
  std::array<vec2, 3> at{};    ///< its corners [m]; counter-clockwise or not, as the chart has it
  std::uint8_t open = 0;       ///< bit k: the edge from corner k to the next is the chart's border
};

/// Triangles of one instance that hang together, and of which no two overlap on the chart. The least
/// rectangle around them begins at 0, is `size` wide and high, and no higher than wide.
struct Chart {
  std::uint32_t instance = 0;
  std::vector<FlatTriangle> triangles;
  vec2 size{0};      ///< [m]
  int halvings = 0;  ///< its texels are as wide as 2 to that many of the atlas'
};

/// Of each instance's triangles, what Chart::halvings is of charts; empty: none.
using Halvings = std::vector<std::vector<std::uint8_t>>;

/// Where charts come from: `own`: pieces whose normals stay near that of one triangle, projected on its
/// plane; `scene`: islands of the second texture coordinates, refused where these are not fit; `automatic`:
/// `scene` for meshes whose coordinates are fit, else `own`.
enum class UvChoice { automatic, own, scene };
constexpr auto enum_table(UvChoice) {
  using enum UvChoice;
  return std::to_array<EnumName<UvChoice>>({{automatic, "auto"}, {own, "own"}, {scene, "scene"}});
}

struct ChartParams {
  UvChoice uvs = UvChoice::automatic;
  float cone = 0.87f;    ///< most between the normals of a chart's triangles and its plane's [radians]
  bool moving = false;   ///< also of what moves: its light is that of one time
  float crease = 0.35f;  ///< an edge where shading normals turn by more parts charts [radians]
};

struct Charts {
  std::vector<Chart> charts;       ///< by instance
  std::vector<std::string> notes;  ///< what has none and why, a line each
  std::vector<std::uint8_t> own;   ///< of each instance, 1: its charts do not follow its coordinates
};

/// Charts of all surfaces that stand still, or of all, posed at `time`: not of unlit materials and of clear
/// glass, of triangles without area, nor where a material's textures take both sets of coordinates, which
/// leaves none for a lightmap. Own charts hold triangles of equal `halvings`. Throws Error with
/// UvChoice::scene for a mesh without second coordinates, or whose second coordinates leave [0, 1] or
/// overlap; Cancelled when asked to stop.
Charts make_charts(const scene::Scene& scene, float time, const ChartParams& params = {},
                   const Halvings& halvings = {}, const Control& control = {});

/// What is wrong with a mesh's second texture coordinates as those of a lightmap; empty: nothing.
std::string second_uvs_problem(const scene::Mesh& mesh);

/// Which sets of coordinates a material's textures take.
std::array<bool, 2> uv_sets_used(const scene::Material& material);

}  // namespace ssphh::lightmap

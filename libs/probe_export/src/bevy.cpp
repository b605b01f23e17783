#include <fmt/format.h>

#include <ssphh/core/json.h>
#include <ssphh/core/parallel.h>
#include <ssphh/image/ktx2.h>
#include <ssphh/sh/irradiance.h>

#include "writers.h"

namespace ssphh::probe_export {
namespace {

/// Sides of an ambient cube: + and − of x, y, z.
constexpr int sides = 6;

vec3 normal_of(int side) {
  vec3 n(0);
  n[side / 2] = side % 2 == 0 ? 1.0f : -1.0f;
  return n;
}

/// The place before the surface that faces `normal` and is nearest to the point within a cell along the
/// normal: what asks this side of the cube there is that surface. The point itself where there is none.
vec3 asked_from(const rays::PosedWorld& world, const vec3& point, const vec3& normal, const vec3& cell) {
  constexpr int most_surfaces = 8;
  const float reach = std::abs(glm::dot(cell, normal));
  const float lift = 0.01f * reach;
  vec3 best = point;
  float least = std::numeric_limits<float>::infinity();
  float from = reach;  // above the point, along the normal
  for (int i = 0; i < most_surfaces && from > -reach; ++i) {
    const rays::RayQuery ray{point + from * normal, -normal, from + reach};
    rays::RayHit hit;
    world.intersect({&ray, 1}, {&hit, 1});
    if (hit.escaped()) break;
    const float at = from - hit.distance;
    if (!hit.back && std::abs(at) < least) least = std::abs(at), best = point + (at + lift) * normal;
    from = at - lift;
  }
  return best;
}

/// E/π of each side of each point's cube.
std::vector<vec3> cubes_of(const LightGrid& grid, const FreeLight& light, const Control& control) {
  const GridShape& shape = grid.shape;
  std::vector<vec3> cubes(shape.count() * sides);
  std::vector<std::uint8_t> asked(cubes.size(), 0);
  parallel_for(
      shape.count(), 16,
      [&](std::size_t i) {
        const vec3 point = shape.point(shape.place(i));
        for (int side = 0; side < sides; ++side) {
          const std::size_t at = i * sides + static_cast<std::size_t>(side);
          const vec3 n = normal_of(side), place = asked_from(light.world(), point, n, shape.cell);
          bool seen = false;
          if (place != point) cubes[at] = light.irradiance(place, n, seen) / pi;
          asked[at] = seen;
          if (!seen) cubes[at] = glm::max(sh::irradiance(grid.light[i], n), vec3(0)) / pi;
        }
      },
      control);
  // Neighbours' sides, which may have been asked for at surfaces that this point's lines miss.
  for (const FilledPoint& point : grid.filled) {
    for (std::size_t side = 0; side < sides; ++side) {
      if (asked[point.index * sides + side]) continue;
      vec3 sum(0);
      for (const std::size_t other : point.from) sum += cubes[other * sides + side];
      cubes[point.index * sides + side] = sum / static_cast<float>(point.from.size());
    }
  }
  return cubes;
}

}  // namespace

Exported write_bevy(const ExportSource& source, const std::string& name, const Control& control) {
  const FreeLight light(source.set, source.scene, source.light);
  const GridShape shape = fit_grid(source.set, light, source.grid);
  const LightGrid grid = resample(source.set, light, source.scene, shape, control);
  const std::vector<vec3> cubes = cubes_of(grid, light, control);

  // Rx × 2 Ry × 3 Rz: positive sides first along y, the axes one after another along z.
  const glm::ivec3 size = shape.size, atlas = size * glm::ivec3(1, 2, 3);
  ByteWriter texels;
  for (int z = 0; z < atlas.z; ++z) {
    for (int y = 0; y < atlas.y; ++y) {
      for (int x = 0; x < atlas.x; ++x) {
        const int side = 2 * (z / size.z) + y / size.y;
        const std::size_t cube = shape.index({x, y % size.y, z % size.z});
        const vec3& e = cubes[cube * sides + static_cast<std::size_t>(side)];
        for (int c = 0; c < 3; ++c) write_half(texels, e[c], "irradiance volume for Bevy");
        write_half(texels, 1, "irradiance volume for Bevy");
      }
    }
  }
  const vec3 middle = 0.5f * (shape.low + shape.high()), extent = shape.high() - shape.low;
  const json::Value place = {{"format", "ssphh-bevy-volume"},  {"version", 1},
                             {"texture", name + ".vxgi.ktx2"}, {"translation", json_triple(middle)},
                             {"scale", json_triple(extent)},   {"intensity", 1.0}};
  return {
      {{"", image::ktx2_of_halves(atlas, texels.bytes())}, {".json", bytes_of(json::print(place, 2) + "\n")}},
      shape.count(),
      grid.filled.size(),
      {fmt::format("Transform: translation {:g} {:g} {:g}, scale {:g} {:g} {:g}; intensity 1 before "
                   "exposure (docs/engines.md)",
                   middle.x, middle.y, middle.z, extent.x, extent.y, extent.z)}};
}

}  // namespace ssphh::probe_export

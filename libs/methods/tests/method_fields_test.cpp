/// What methods interpolate between their own probes and voxels, in light that differs by place, direction
/// and colour.

#include <optional>

#include <gtest/gtest.h>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/methods/vct/cone_light.h>
#include <ssphh/probes/lookup.h>

#include "ddgi/field.h"
#include "probe_volume/probe_volume.h"
#include "varied_light.h"

namespace ssphh::methods {
namespace {

using test::light_at;
using test::VariedLight;

void expect_channels_near(const vec3& actual, const vec3& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << "channel " << c;
}

/// 4 × 3 × 5 probes in a box of unequal cells, every texel that of a linear field.
struct Ddgi {
  Ddgi() : field({.first = {0.2f, 0.3f, 0.1f}, .spacing = {1.1f, 1.3f, 0.9f}, .count = {4, 3, 5}}) {
    field.visibility = false;
    field.bias = 0;
    for (int i = 0; i < field.grid.size(); ++i) {
      for (int t = 0; t < ddgi::DdgiField::irradiance_texels; ++t)
        field.irradiance_of(i)[t] = light_at(field.grid.position(i))
                                        .irradiance(octahedral_texel(t, ddgi::DdgiField::irradiance_size));
    }
  }
  ddgi::DdgiField field;
};

TEST(MethodFields, DdgiBlendsItsEightProbesByTentsAndWrappedCosines) {
  const Ddgi ddgi;
  Pcg32 random(8);
  for (int i = 0; i < 60; ++i) {
    const vec3 cell = vec3(3, 2, 4) * (0.01f + 0.98f * random.uniform3());
    const vec3 x = ddgi.field.grid.first + ddgi.field.grid.spacing * cell;
    const vec3 n = sample_uniform_sphere(random.uniform2());
    // Majercik et al. (2019): tents, and ((n·d + 1) / 2)² + 0.2
    VariedLight sum;
    float total = 0;
    for (int k = 0; k < ddgi.field.grid.size(); ++k) {
      const vec3 p = ddgi.field.grid.position(k), away = glm::abs(p - x) / ddgi.field.grid.spacing;
      if (max_component(away) >= 1) continue;
      const float wrapped = 0.5f + 0.5f * glm::dot(glm::normalize(p - x), n);
      const float weight = (wrapped * wrapped + 0.2f) * glm::max(1 - away.x, 1e-3f) *
                           glm::max(1 - away.y, 1e-3f) * glm::max(1 - away.z, 1e-3f);
      sum = sum + weight * light_at(p), total += weight;
    }
    // Bilinear between directions π / 8 apart and more: h² / 8 = 0.04 of the curvature, of 2π/3 |b| < 3 and
    // π/4 6 c
    const vec3 facing = sample_uniform_sphere(random.uniform2());
    expect_channels_near(ddgi.field.irradiance(x, n, n, facing), (1 / total * sum).irradiance(facing), 0.15f);
  }
}

/// A box of voxels, [0, 1]³, whose six walls shine inwards, each in a colour of its own.
struct LitBox {
  static constexpr int size = 64, wall = 4;  ///< the walls stand so many voxels from the grid's rim

  LitBox() : grid{.origin = vec3(0), .voxel = 1.0f / size, .resolution = size, .size = {size, size, size}} {
    std::vector<vct::VoxelKey> keys;
    const auto visit = [&](const auto& use) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool high : {false, true}) {
          for (int u = wall; u < size - wall; ++u) {
            for (int v = wall; v < size - wall; ++v) {
              std::array<int, 3> cell{};
              cell[axis] = high ? size - wall : wall - 1;
              cell[(axis + 1) % 3] = u, cell[(axis + 2) % 3] = v;
              use(vct::Cell{cell[0], cell[1], cell[2]}, axis, high);
            }
          }
        }
      }
    };
    visit([&](const vct::Cell& cell, int, bool) { keys.push_back(vct::voxel_key(cell)); });
    voxels.emplace(grid, vct::Storage::sparse, keys);
    // Of each axis first the side that looks along it, then the one that looks back
    visit([&](const vct::Cell& cell, int axis, bool high) {
      voxels->find(0, cell)->side[2 * axis + high] = vec4(colour(axis, high), 1);
    });
    voxels->filter();
  }
  static vec3 colour(int axis, bool high) {
    return high ? vec3(1 + axis, 4 - axis, 2) : vec3(3 - 0.5f * static_cast<float>(axis), 0.5f, 0.5f + axis);
  }
  /// Which wall a ray meets.
  vec3 seen(const vec3& x, const vec3& d) const {
    const float low = static_cast<float>(wall) / size - 0.5f / size, high = 1 - low;
    float nearest = 1e9f;
    vec3 found(0);
    for (int axis = 0; axis < 3; ++axis) {
      const float t = ((d[axis] > 0 ? high : low) - x[axis]) / d[axis];
      if (t < nearest) nearest = t, found = colour(axis, d[axis] > 0);
    }
    return found;
  }

  vct::VoxelGrid grid;
  std::optional<vct::Pyramid> voxels;
};

TEST(MethodFields, ConesSeeEachOfSixColouredWallsInItsPlace) {
  const LitBox box;
  vct::ConeParams params;
  params.cones = 128, params.offset = 0;
  const vct::ConeLight light(*box.voxels, params);
  Pcg32 random(9);
  for (int i = 0; i < 24; ++i) {
    const vec3 x = 0.35f + 0.3f * random.uniform3(), n = sample_uniform_sphere(random.uniform2());
    const Frame frame = Frame::around(n);
    vec3 expected(0);
    constexpr int rays = 4000;
    for (int k = 0; k < rays; ++k) {
      const auto [u, v] = std::pair((static_cast<float>(k) + 0.5f) / rays, 0.618034f * static_cast<float>(k));
      expected += box.seen(x, frame.to_world(sample_cosine_hemisphere({u, v - std::floor(v)}))) * (pi / rays);
    }
    // Cones are 0.2 rad wide, and of one that meets an edge of the box the part over a wall's rim sees
    // nothing: seen to lose up to 9 %. A wall that is taken for another errs by a fifth of the light and more
    expect_channels_near(light.irradiance({x, n}), expected, 0.12f * max_component(expected));
    const vec3 straight = light.glossy({x, n}, n, 0);
    const vec3 ray = box.seen(x, n);
    if (glm::distance(box.seen(x, n + 0.25f * frame.x), ray) +
            glm::distance(box.seen(x, n - 0.25f * frame.x), ray) +
            glm::distance(box.seen(x, n + 0.25f * frame.y), ray) +
            glm::distance(box.seen(x, n - 0.25f * frame.y), ray) ==
        0)
      expect_channels_near(straight, ray, 0.05f * max_component(ray));  // what a wall lets through
  }
}

TEST(MethodFields, TetrahedraGiveALinearFieldOfColouredDirections) {
  Pcg32 random(7);
  std::vector<vec3> places;
  for (int i = 0; i < 8; ++i) places.push_back(4.0f * vec3(i % 2, i / 2 % 2, i / 4));
  for (int i = 0; i < 60; ++i) places.push_back(4.0f * random.uniform3());
  const probes::IrradianceLookup lookup(test::varied_set(places, 4, test::light_at),
                                        std::make_unique<probe_volume::VolumeWeights>(places), {});
  for (int i = 0; i < 60; ++i) {
    const rays::SurfacePoint p{0.02f + 3.96f * random.uniform3(), sample_uniform_sphere(random.uniform2())};
    // Flat cells at the hull lose a thousandth of an edge (tetrahedra_test.cpp); π and a slope of 0.9 on top
    expect_channels_near(lookup.irradiance(p), test::light_at(p.position).irradiance(p.normal), 0.01f);
  }
}

}  // namespace
}  // namespace ssphh::methods

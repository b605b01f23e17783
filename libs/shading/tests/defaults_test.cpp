/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/shading/bsdf.h>
#include <ssphh/shading/glass.h>
#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>
#include <ssphh/shading/scattering.h>
#include <ssphh/shading/surface.h>

#include "light_scenes.h"
#include "lights/distant_lights.h"
#include "lights/punctual_lights.h"

namespace ssphh::shading {
namespace {

TEST(Defaults, OfScatteringAndLights) {
  const BsdfParams bsdf;
  EXPECT_EQ(bsdf.diffuse, vec3(0.8f));
  EXPECT_EQ(bsdf.f0, vec3(0.04f));
  EXPECT_EQ(bsdf.diffuse_roughness, 0);
  EXPECT_EQ(bsdf.specular_roughness, 1);
  const BsdfValue value;
  EXPECT_EQ(value.value, vec3(0));
  EXPECT_EQ(value.pdf, 0);
  const Surface surface{};
  EXPECT_EQ(surface.emission, vec3(0));
  EXPECT_EQ(surface.alpha, 1);
  EXPECT_FALSE(surface.unlit);
  const SurfaceGeometry geometry;
  EXPECT_EQ(geometry.position, vec3(0));
  EXPECT_EQ(geometry.front, vec3(0));
  EXPECT_EQ(geometry.normal, vec3(0));
  EXPECT_EQ(geometry.uv[0], vec2(0));
  EXPECT_EQ(geometry.uv[1], vec2(0));
  const EmittedPhoton photon;
  EXPECT_EQ(photon.normal, vec3(0));
  const PointLight point{vec3(1), vec3(2)};
  EXPECT_EQ(point.axis, vec3(0));
  EXPECT_EQ(point.cone_scale, 0);
  EXPECT_EQ(point.cone_offset, 1);
  EXPECT_EQ(point.range, 0);
  EXPECT_EQ(point.group, 0);
  const SphereLight sphere{vec3(1), 1, vec3(2)};
  EXPECT_EQ(sphere.group, 0);
  EXPECT_EQ(DistantLights().count(), 0u);
  EXPECT_EQ(MeshView::max_triangles, 32u);
  const MeshView none(vec3(0), vec3(0, 1, 0), vec3(1), 0);
  EXPECT_EQ(none.irradiance(), vec3(0));
  EXPECT_FALSE(none.sample(vec2(0.5f)));
}

TEST(Defaults, OfGlass) {
  const GlassParams glass;
  EXPECT_EQ(glass.share, 0);
  EXPECT_TRUE(glass.sheet);
  EXPECT_FALSE(glass.inside);
  EXPECT_EQ(glass.ior, 1.5f);
  EXPECT_EQ(glass.specular, 1);
  EXPECT_EQ(glass.roughness, 0);
  EXPECT_EQ(glass.tint, vec3(1));
  EXPECT_EQ(glass.absorption, vec3(0));
}

TEST(Defaults, OfWhatIsFound) {
  const GlassShares shares;
  EXPECT_EQ(shares.reflected, vec3(0));
  EXPECT_EQ(shares.transmitted, vec3(0));
  EXPECT_EQ(GlassSample{}.spread, 1);
  EXPECT_EQ(ScatteringSample{}.spread, 1);
  EXPECT_FALSE(ScatteringSample{}.glass);
}

}  // namespace
}  // namespace ssphh::shading

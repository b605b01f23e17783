/// Indirect light on an engine's G-buffer, against the CPU's lookup at the same texels, whichever way the
/// engine keeps depth.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>

#include "error_message.h"
#include "gl_context.h"
#include "pictures.h"

namespace ssphh::test {
namespace {

using realtime::GBuffer;
using realtime::Renderer;
using testing::HasSubstr;

constexpr PictureSize engine_size{84, 60};
constexpr float aspect = 1.4f;

/// How an engine's camera keeps depth.
struct Convention {
  std::string name;
  mat4 projection{1};
  bool zero_to_one = false;
  float empty_depth = 1;
  bool by_position = false, normal_from_zero = false;
};
void PrintTo(const Convention& c, std::ostream* out) {
  *out << c.name;
}

mat4 reversed_without_end(float yfov, float near) {
  const float f = 1 / std::tan(0.5f * yfov);
  return {vec4(f / aspect, 0, 0, 0), vec4(0, f, 0, 0), vec4(0, 0, 0, -1), vec4(0, 0, near, 0)};
}

std::vector<Convention> conventions() {
  const mat4 usual = glm::perspectiveRH_NO(1.1f, aspect, 0.1f, 40.0f);
  const mat4 aside = glm::translate(mat4(1), {0.3f, -0.2f, 0}) * usual;
  const mat4 reversed_box = glm::scale(glm::translate(mat4(1), {0, 0, 1}), {1, 1, -1}) *
                            glm::orthoRH_ZO(-1.4f, 1.4f, -1.0f, 1.0f, 0.05f, 20.0f);
  return {{"OpenGL", usual},
          {"ZeroToOne", glm::perspectiveRH_ZO(1.1f, aspect, 0.1f, 40.0f), true},
          {"ReversedWithoutEnd", reversed_without_end(1.1f, 0.05f), true, 0},
          {"AsideOfTheAxis", aside},
          {"Orthographic", glm::orthoRH_NO(-1.4f, 1.4f, -1.0f, 1.0f, 0.05f, 20.0f)},
          {"OrthographicReversed", reversed_box, true, 0},
          {"Positions", usual, false, 1, true, true}};
}

/// What an engine has drawn, here by rays: textures whose row 0 is at the bottom, and the points that they
/// show.
struct EnginesFrame {
  EnginesFrame(const rays::TransportSource& source, const mat4& view, const Convention& how) {
    const mat4 view_projection = how.projection * view, back = glm::inverse(view_projection);
    const float near = how.empty_depth == 0 ? 1 : how.zero_to_one ? 0 : -1, further = 0.5f;
    std::vector<rays::RayQuery> rays;
    for (int y = 0; y < engine_size.height; ++y) {
      for (int x = 0; x < engine_size.width; ++x) {
        const vec2 at = 2.0f * (vec2(x, y) + 0.5f) / vec2(engine_size.width, engine_size.height) - 1.0f;
        const auto world = [&](float z) {
          const vec4 p = back * vec4(at, z, 1);
          return vec3(p) / p.w;
        };
        rays.push_back({world(near), glm::normalize(world(further) - world(near))});
      }
    }
    std::vector<rays::RayHit> hits(rays.size());
    std::vector<std::uint8_t> moves(rays.size());
    rays::PosedWorld(source, 0).intersect(rays, hits, moves);
    std::vector<float> depths;
    std::vector<vec4> positions, normals, albedos;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool empty = i % engine_size.width < 8;  // as if the sky were there
      const vec3 p = empty ? vec3(0) : rays[i].origin + hits[i].distance * rays[i].direction;
      const vec4 clip = view_projection * vec4(p, 1);
      const float z = clip.z / clip.w;
      depths.push_back(empty ? how.empty_depth : how.zero_to_one ? z : 0.5f * z + 0.5f);
      positions.emplace_back(p, empty ? 0 : 1);
      const vec3 n = how.normal_from_zero ? 0.5f + 0.5f * hits[i].normal : 3.0f * hits[i].normal;
      normals.emplace_back(n, 0);
      albedos.emplace_back(hits[i].albedo, 1);
      moving.push_back(moves[i] != 0 ? 1.0f : 0.0f);
      points.push_back({p, hits[i].normal, moves[i] != 0});
      albedo.push_back(empty ? vec3(0) : hits[i].albedo);
    }
    const auto upload = [](gl::Format format, auto& texels) {
      gl::Texture texture(format, engine_size.width, engine_size.height);
      texture.upload(std::as_bytes(std::span(texels)));
      return texture;
    };
    textures.push_back(upload(gl::Format::r32f, depths));
    textures.push_back(upload(gl::Format::rgba32f, positions));
    textures.push_back(upload(gl::Format::rgba32f, normals));
    textures.push_back(upload(gl::Format::rgba32f, albedos));
    textures.push_back(upload(gl::Format::r32f, moving));
    gbuffer.depth = textures[0].id();
    gbuffer.position = how.by_position ? textures[1].id() : 0;
    gbuffer.normal = textures[2].id(), gbuffer.normal_from_zero = how.normal_from_zero;
    gbuffer.albedo = textures[3].id(), gbuffer.moving = textures[4].id();
    gbuffer.view_projection = view_projection;
    gbuffer.zero_to_one = how.zero_to_one, gbuffer.empty_depth = how.empty_depth;
  }

  std::vector<gl::Texture> textures;
  GBuffer gbuffer;
  std::vector<rays::SurfacePoint> points;
  std::vector<vec3> albedo;  ///< 0 where nothing stands
  std::vector<float> moving;
};

/// The same light by the CPU's lookup and by the renderer.
struct Lit {
  explicit Lit(const std::string& name) : scene(scene::make_builtin(name)), source(scene), tracer(scene) {
    bake::TransportBakeParams params;
    params.transport.surfels_per_radius = 8;
    params.transport.directions = 128;
    params.records.points = 800;
    bake::TransportBakeReport report;
    set = bake::bake_transport(source, place::init_from_scene(scene, 5), params, report);
    lookup.emplace(set, tracer);
  }
  void give_to(Renderer& renderer) const {
    renderer.set_probes(set);
    set_records(renderer, scene, *set.surface, tracer);
  }
  mat4 view() const { return glm::inverse(scene::camera_pose(scene, "").world); }

  scene::Scene scene;
  trace::TransportScene source;
  trace::PathTracer tracer;
  probes::ProbeSet set;
  std::optional<probes::IrradianceLookup> lookup;
};

const Lit& lit_rooms() {
  static const Lit lit("two-rooms");
  return lit;
}

std::vector<vec4> read(const gl::Texture& texture) {
  std::vector<vec4> texels(static_cast<std::size_t>(texture.width() * texture.height()));
  texture.read({&texels[0].x, 4 * texels.size()}, 4);
  return texels;
}

/// Sums and differences of luminances of what stands there.
struct GBufferDifference {
  double ratio = 0, mean_difference = 0;  ///< of the sums; in shares of the mean
  int lit = 0;
};
GBufferDifference compare(const EnginesFrame& frame, const rays::IndirectLight& lookup,
                          const std::vector<vec4>& found) {
  double expected_sum = 0, sum = 0, differences = 0;
  GBufferDifference result;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (frame.albedo[i] == vec3(0)) {
      EXPECT_EQ(vec3(found[i]), vec3(0)) << i;
      continue;
    }
    const vec3 expected = frame.albedo[i] / pi * lookup.irradiance(frame.points[i]), e = found[i];
    expected_sum += static_cast<double>(luminance(expected)), sum += static_cast<double>(luminance(e));
    differences += static_cast<double>(luminance(glm::abs(e - expected)));
    ++result.lit;
  }
  result.ratio = sum / expected_sum, result.mean_difference = differences / expected_sum;
  return result;
}

/// One renderer for all tests, with light.
class EnginesGBuffer : public WithGl {
 protected:
  void SetUp() override {
    WithGl::SetUp();
    if (IsSkipped() || renderer_) return;
    renderer_ = std::make_unique<Renderer>(gl(), lit_rooms().scene);
    lit_rooms().give_to(*renderer_);
  }
  static void TearDownTestSuite() { renderer_.reset(); }
  static std::vector<vec4> light(const EnginesFrame& frame, const realtime::FrameSettings& settings = {}) {
    return read(renderer_->draw_indirect(frame.gbuffer, settings));
  }
  static EnginesFrame usual_frame() { return {lit_rooms().source, lit_rooms().view(), conventions()[0]}; }

  inline static std::unique_ptr<Renderer> renderer_;
};
class EnginesConvention : public EnginesGBuffer, public testing::WithParamInterface<Convention> {};

TEST_P(EnginesConvention, GivesTheLookupsLightAtTheSameTexels) {
  const EnginesFrame frame(lit_rooms().source, lit_rooms().view(), GetParam());
  const GBufferDifference found = compare(frame, *lit_rooms().lookup, light(frame));
  EXPECT_GT(found.lit, engine_size.width * engine_size.height / 2);
  EXPECT_NEAR(found.ratio, 1, 1e-3);
  EXPECT_LT(found.mean_difference, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(Of, EnginesConvention, testing::ValuesIn(conventions()),
                         [](const auto& of) { return of.param.name; });

TEST_F(EnginesGBuffer, IsWhiteWhereThereIsNoAlbedo) {
  EnginesFrame frame = usual_frame();
  frame.gbuffer.albedo = 0;
  for (vec3& albedo : frame.albedo)
    if (albedo != vec3(0)) albedo = vec3(1);
  EXPECT_LT(compare(frame, *lit_rooms().lookup, light(frame)).mean_difference, 2e-3);
}

TEST_F(EnginesGBuffer, WhatMovesIsLitByProbesAlone) {
  EnginesFrame frame = usual_frame();
  const std::vector<vec4> still = light(frame);
  std::ranges::fill(frame.moving, 1.0f);
  frame.textures[4].upload(std::as_bytes(std::span(frame.moving)));
  for (rays::SurfacePoint& at : frame.points) at.moves = true;
  const std::vector<vec4> found = light(frame);
  EXPECT_LT(compare(frame, *lit_rooms().lookup, found).mean_difference, 0.02);
  EXPECT_NE(found, still);
}

TEST_F(EnginesGBuffer, InterpolatesAndDarkensCornersAsDrawDoes) {
  const EnginesFrame frame = usual_frame();
  realtime::FrameSettings settings;
  settings.indirect_scale = 2;
  EXPECT_LT(compare(frame, *lit_rooms().lookup, light(frame, settings)).mean_difference, 0.02);
  settings.ambient_occlusion = true;
  const double darkened = compare(frame, *lit_rooms().lookup, light(frame, settings)).ratio;
  EXPECT_TRUE(darkened > 0.5 && darkened < 0.98) << darkened;
}

TEST_F(EnginesGBuffer, FollowsTheRenderersLight) {
  const EnginesFrame frame = usual_frame();
  const std::vector<vec4> before = light(frame);
  std::vector<probes::RecordLight> dimmed = lit_rooms().set.surface->light;
  for (probes::RecordLight& record : dimmed) record *= 0.5f;
  renderer_->set_record_light(dimmed);
  const std::vector<vec4> after = light(frame);
  renderer_->set_record_light(lit_rooms().set.surface->light);
  double was = 0, is = 0;
  for (std::size_t i = 0; i < before.size(); ++i) was += before[i].y, is += after[i].y;
  EXPECT_NEAR(is / was, 0.52, 0.02) << "where no record reaches, probes light as before";
  EXPECT_EQ(light(frame), before);
}

/// Normal maps: light by the shading normal, sight of probes against the plane that was drawn.
TEST_F(EnginesGBuffer, TakesAGeometricNormalBesideTheShadingOne) {
  EnginesFrame frame = usual_frame();
  std::ranges::fill(frame.moving, 1.0f);  // so that probes light it
  frame.textures[4].upload(std::as_bytes(std::span(frame.moving)));
  const auto upload = [](const std::vector<vec4>& normals) {
    gl::Texture texture(gl::Format::rgba32f, engine_size.width, engine_size.height);
    texture.upload(std::as_bytes(std::span(normals)));
    return texture;
  };
  std::vector<vec4> tilted, turned;
  for (rays::SurfacePoint& at : frame.points) {
    turned.emplace_back(-at.normal, 0);
    at.moves = true;
    at.normal = glm::normalize(at.normal + vec3(0.3f, -0.2f, 0.25f));
    tilted.emplace_back(at.normal, 0);
  }
  const gl::Texture shading = upload(tilted), behind = upload(turned);
  const std::vector<vec4> flat = light(frame);
  frame.gbuffer.geometric_normal = frame.gbuffer.normal;
  EXPECT_EQ(light(frame), flat);
  frame.gbuffer.geometric_normal = behind.id();
  EXPECT_FALSE(light(frame) == flat) << "walls hide probes that stand behind them";
  frame.gbuffer.geometric_normal = frame.gbuffer.normal;
  frame.gbuffer.normal = shading.id();
  EXPECT_LT(compare(frame, *lit_rooms().lookup, light(frame)).mean_difference, 0.05);
}

TEST_F(EnginesGBuffer, RefusalsSayWhatIsWrong) {
  const EnginesFrame frame = usual_frame();
  const auto refused = [&](const auto& change) {
    GBuffer g = frame.gbuffer;
    change(g);
    return message_of([&] { renderer_->draw_indirect(g); });
  };
  EXPECT_THAT(refused([](GBuffer& g) { g.normal = 0; }), HasSubstr("it needs a texture of normals"));
  EXPECT_THAT(refused([](GBuffer& g) { g.depth = 0; }), HasSubstr("one of depth or of positions"));
  EXPECT_THAT(refused([](GBuffer& g) { g.albedo = 99999; }),
              HasSubstr("G-buffer, albedo: OpenGL has no 2-D texture of number 99999"));
  const gl::Texture other(gl::Format::rgba32f, 5, 4), many(gl::Format::rgba32f, 84, 60, 2);
  EXPECT_THAT(refused([&](GBuffer& g) { g.normal = other.id(); }),
              HasSubstr("G-buffer, normal: its texture has 5 x 4"));
  EXPECT_THAT(refused([&](GBuffer& g) { g.geometric_normal = other.id(); }),
              HasSubstr("G-buffer, geometric normal: its texture has 5 x 4"));
  EXPECT_THAT(refused([&](GBuffer& g) { g.moving = many.id(); }), HasSubstr("no 2-D texture"));
  EXPECT_THAT(refused([](GBuffer& g) { g.view_projection = mat4(0); }), HasSubstr("cannot be inverted"));
  EXPECT_THAT(refused([](GBuffer& g) { g.view_projection[0].y = 3; }), HasSubstr("none of a perspective or"));
  EXPECT_THAT(refused([](GBuffer& g) { g.view_projection[3].x = NAN; }), HasSubstr("cannot be inverted"));
  EXPECT_LT(compare(frame, *lit_rooms().lookup, light(frame)).mean_difference, 2e-3) << "and goes on";
}

}  // namespace
}  // namespace ssphh::test

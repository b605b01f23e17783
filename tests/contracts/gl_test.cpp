/// Contracts of libs/gl and libs/realtime.

#include <epoxy/gl.h>

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/texture.h>
#include <ssphh/gl/volume.h>
#include <ssphh/realtime/renderer.h>

#include "contract.h"
#include "gl_context.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

using realtime::Renderer;

/// A row of which `run` needs a context.
struct GlContract {
  std::string entry, given;
  std::function<void(gl::Context&)> run;
};
void PrintTo(const GlContract& row, std::ostream* out) {
  *out << row.entry << " " << row.given;
}

class GlContractTest : public WithGl, public testing::WithParamInterface<GlContract> {};

TEST_P(GlContractTest, Holds) {
  GetParam().run(gl());
  EXPECT_NO_THROW(gl().throw_on_error("afterwards"));
}

GlContract refuses_gl(std::string entry, std::string given, std::function<void()> call,
                      std::vector<std::string> words) {
  return {std::move(entry), std::move(given), [=](gl::Context&) { expect_refusal(call, words); }};
}

/// A renderer with probes; afterwards it still has them.
GlContract refuses_frame(std::string given, std::function<void(Renderer&)> call,
                         std::vector<std::string> words) {
  return {"Renderer", std::move(given), [=](gl::Context& context) {
            Renderer renderer(context, sound_scene());
            renderer.set_probes(sound_set());
            expect_refusal([&] { call(renderer); }, words);
            EXPECT_EQ(renderer.probe_count(), 3);
            EXPECT_EQ(renderer.lighting(), scene::lighting_at(sound_scene()));
          }};
}

/// The same for a state of the light.
GlContract refuses_drawn_state(std::string given, std::function<void(scene::LightingState&)> spoil,
                               std::vector<std::string> words) {
  return refuses_frame(
      std::move(given),
      [spoil](Renderer& renderer) {
        scene::LightingState state = renderer.lighting();
        spoil(state);
        renderer.set(state);
      },
      std::move(words));
}

const std::array<std::byte, 64> bytes{};

std::vector<GlContract> of_objects() {
  using gl::Buffer, gl::Format, gl::Texture, gl::Volume;
  return {
      refuses_gl("Buffer", "UpdatedPastItsEnd", [] { Buffer(8).update_bytes(4, std::span(bytes).first(8)); },
                 {"buffer", "room"}),
      refuses_gl("Buffer", "UpdatedFarPastItsEnd",
                 [] { Buffer(8).update_bytes(~std::size_t{0} - 3, std::span(bytes).first(8)); },
                 {"buffer", "room"}),
      refuses_gl("Texture", "OfNoSize", [] { Texture(Format::rgba8, 0, 4); }, {"texture", "size"}),
      refuses_gl("Texture", "OfMinusOneLayers", [] { Texture(Format::rgba8, 4, 4, -1); }, {"texture"}),
      refuses_gl("Texture", "LargerThanAnyDriver", [] { Texture(Format::rgba8, 1 << 30, 1); }, {"texture"}),
      refuses_gl("Texture", "UploadedWithTooFewBytes",
                 [] { Texture(Format::rgba8, 4, 4).upload(std::span(bytes).first(8)); },
                 {"texture", "bytes"}),
      refuses_gl("Texture", "UploadedOutside",
                 [] { Texture(Format::rgba8, 4, 4).upload_rect(std::span(bytes).first(16), 3, 0, 2, 2); },
                 {"texture", "inside"}),
      refuses_gl("Texture", "UploadedToNoLayer", [] { Texture(Format::rgba8, 4, 4, 2).upload(bytes, 2); },
                 {"texture", "inside"}),
      refuses_gl("Texture", "ReadIntoTooLittle",
                 [] {
                   std::array<float, 4> out;
                   Texture(Format::rgba32f, 4, 4).read(out, 4);
                 },
                 {"texture", "room"}),
      refuses_gl("Texture", "ReadWithFiveChannels",
                 [] {
                   std::array<float, 80> out;
                   Texture(Format::rgba32f, 4, 4).read(out, 5);
                 },
                 {"texture", "channels"}),
      refuses_gl("Volume", "OfNoSize", [] { Volume(glm::ivec3(4, 0, 4)); }, {"volume"}),
      refuses_gl("Volume", "UploadedOutside",
                 [] {
                   const std::array<std::uint64_t, 8> texels{};
                   Volume(glm::ivec3(2)).upload_box(texels, glm::ivec3(1), glm::ivec3(2));
                 },
                 {"volume", "inside"}),
      refuses_gl("Volume", "UploadedWithTooFewTexels",
                 [] { Volume(glm::ivec3(2)).upload_box({}, glm::ivec3(0), glm::ivec3(2)); },
                 {"volume", "texels"}),
      refuses_gl("Framebuffer", "OfNineTextures",
                 [] {
                   const Texture texture(Format::rgba8, 4, 4);
                   const std::vector<const Texture*> nine(9, &texture);
                   gl::Framebuffer(nine, nullptr);
                 },
                 {"framebuffer", "8"}),
      refuses_gl("ShaderFiles", "OfNoName", [] { gl::ShaderFiles({}).text("x.frag"); }, {"x.frag"}),
  };
}

std::vector<GlContract> of_renderer() {
  std::vector<GlContract> rows = {
      refuses_frame("ProbesOfHigherDegree",
                    [](Renderer& r) {
                      probes::ProbeSet set = sound_set();
                      set.probes[1].reflected = sh::RadianceSh(4);
                      r.set_probes(set);
                    },
                    {"probe 1", "25 RGB coefficients"}),
      refuses_frame(
          "UpdateOfHigherDegree",
          [](Renderer& r) {
            r.update_probes(std::vector<int>{0, 2}, std::vector{sh::RadianceSh(2), sh::RadianceSh(4)});
          },
          {"probe 2", "25 RGB coefficients", "9"}),
      refuses_frame("UpdateThatIsNoNumber",
                    [](Renderer& r) {
                      sh::RadianceSh light(2);
                      light[3].z = nan;
                      r.update_probes(std::vector<int>{1}, std::vector{light});
                    },
                    {"probe 1", "not finite"}),
      refuses_frame("UpdateOfNoProbe",
                    [](Renderer& r) { r.update_probes(std::vector<int>{3}, std::vector{sh::RadianceSh(2)}); },
                    {"probe 3"}),
      refuses_frame("UpdateWithoutLight", [](Renderer& r) { r.update_probes(std::vector<int>{0}, {}); },
                    {"probes", "function for each"}),
      refuses_drawn_state("EmissionOfNoProbe",
                          [](auto& s) {
                            s.emission = {{3, {}}};
                          },
                          {"probe 3"}),
      refuses_drawn_state("EmissionThatIsNoNumber",
                          [](auto& s) {
                            s.emission = {{0, sh::RadianceSh(0)}};
                            s.emission[0].leaving[0] = vec3(nan);
                          },
                          {"emission", "finite"}),
      refuses_drawn_state("OneLightMore", [](auto& s) { s.lights.resize(2); }, {"2 lights"}),
      refuses_drawn_state("LightThatIsNoNumber", [](auto& s) { s.lights[0].color = vec3(nan); },
                          {"light 0", "finite"}),
      refuses_drawn_state("OneGroupMore", [](auto& s) { s.group_scales.resize(2); }, {"2 groups"}),
      refuses_drawn_state("GroupScaleThatIsNoNumber", [](auto& s) { s.group_scales[0] = vec3(nan); },
                          {"group 0", "finite"}),
      refuses_frame("MaterialThatIsNotThere", [](Renderer& r) { r.set_material(1, {}); }, {"material 1"}),
      refuses_drawn_state("TimeThatIsNoNumber", [](auto& s) { s.time = nan; }, {"time"}),
      refuses_frame("FrameOfNoSize", [](Renderer& r) { r.draw({}, {}, {.width = 0}); }, {"frame size"}),
      refuses_frame("ReadBackBeforeAFrame", [](Renderer& r) { r.read_back(); }, {"no frame"}),
      refuses_frame("FittedPointsOfNoProbe",
                    [](Renderer& r) {
                      probes::FittedSurfaces fitted;
                      fitted.surfaces.points.resize(1);
                      fitted.weights.resize(1);
                      fitted.weights[0].add(3, 1);
                      fitted.surfaces.ranges.resize(1), fitted.surfaces.lists.resize(1);
                      r.set_fitted(fitted);
                    },
                    {"fitted point 0", "probe 3"}),
      refuses_frame("LightOfRecordsThatAreNotThere",
                    [](Renderer& r) { r.set_record_light(std::vector(2, probes::RecordLight(0))); },
                    {"2 lights", "0 records"}),
      {"Renderer", "ThatWasMoved",
       [](gl::Context& context) {
         Renderer first(context, sound_scene());
         Renderer second = std::move(first);
         expect_refusal([&] { first.lighting(); }, {"moved from"});
         expect_refusal([&] { first.read_back(); }, {"moved from"});
         EXPECT_EQ(second.lighting().time, 0);
       }},
      {"Renderer", "AfterAnErrorOfTheHost",
       [](gl::Context& context) {
         glEnable(GL_TEXTURE_2D + 7777);  // no capability
         EXPECT_NO_THROW(Renderer(context, sound_scene()));
       }},
  };
  for (const SpoiltScene& s : spoilt_scenes())
    rows.push_back({"Renderer", s.name, [s](gl::Context& context) {
                      expect_refusal([&] { Renderer(context, s.make()); }, s.words);
                    }});
  return rows;
}

/// `spoil` is given sound buffers of a quad with normals and texture coordinates, and one of 16 bytes.
GlContract refuses_buffers(std::string given, std::function<void(realtime::MeshBuffers&, unsigned)> spoil,
                           std::vector<std::string> words, int copies = 1) {
  return {"MeshBuffers", std::move(given), [=](gl::Context& context) {
            const scene::Scene scene = sound_scene();
            const scene::Mesh& mesh = scene.meshes[0];
            const gl::Buffer places(std::span<const vec3>(mesh.positions)),
                normals(std::span<const vec3>(mesh.normals)), uvs(std::span<const vec2>(mesh.uvs[0])),
                corners(std::span<const uvec3>(mesh.triangles)), little(16);
            realtime::MeshBuffers buffers{.positions = {places.id(), 0, 12},
                                          .normals = {normals.id(), 0, 12},
                                          .uvs = {{{uvs.id(), 0, 8}, {}}},
                                          .indices = {corners.id()}};
            const auto make = [&] {
              Renderer(context, scene, {}, 0, std::vector(static_cast<std::size_t>(copies), buffers));
            };
            if (copies == 1) make();
            spoil(buffers, little.id());
            expect_refusal(make, words);
          }};
}

std::vector<GlContract> of_mesh_buffers() {
  using realtime::MeshBuffers;
  return {
      refuses_buffers("OfNoMesh", [](MeshBuffers& b, unsigned) { b.mesh = 1; }, {"mesh 1", "scene has 1"}),
      refuses_buffers("OfMeshMinusOne", [](MeshBuffers& b, unsigned) { b.mesh = -1; }, {"mesh -1"}),
      refuses_buffers(
          "OfOneMeshTwice", [](MeshBuffers&, unsigned) {}, {"mesh 0", "twice"}, 2),
      refuses_buffers("WithoutPositions", [](MeshBuffers& b, unsigned) { b.positions = {}; },
                      {"mesh 0, positions", "no buffer of number 0"}),
      refuses_buffers("WithoutIndices", [](MeshBuffers& b, unsigned) { b.indices = {}; },
                      {"mesh 0, indices", "no buffer of number 0"}),
      refuses_buffers("WithoutNormalsThatTheSceneHas", [](MeshBuffers& b, unsigned) { b.normals = {}; },
                      {"mesh 0, normals", "no buffer of number 0"}),
      refuses_buffers("WithColorsThatTheSceneLacks",
                      [](MeshBuffers& b, unsigned little) { b.colors.buffer = little; },
                      {"mesh 0, colors", "has none"}),
      refuses_buffers("OfANumberThatIsNoBuffer", [](MeshBuffers& b, unsigned) { b.uvs[0].buffer = 4567; },
                      {"mesh 0, first uvs", "4567"}),
      refuses_buffers("OfTooFewVertices", [](MeshBuffers& b, unsigned little) { b.normals.buffer = little; },
                      {"mesh 0, normals", "48 bytes", "has 16"}),
      refuses_buffers("OfTooFewCorners", [](MeshBuffers& b, unsigned little) { b.indices.buffer = little; },
                      {"mesh 0, indices", "24 bytes", "has 16"}),
      refuses_buffers("PastTheirEnd", [](MeshBuffers& b, unsigned) { b.positions.offset = 4; },
                      {"mesh 0, positions", "from byte 4"}),
      refuses_buffers("FarPastTheirEnd",
                      [](MeshBuffers& b, unsigned) { b.positions.offset = ~std::size_t{0} - 3; },
                      {"mesh 0, positions", "bytes from byte"}),
      refuses_buffers("OfAStrideThatNoDriverTakes",
                      [](MeshBuffers& b, unsigned) { b.positions.stride = std::size_t{1} << 40; },
                      {"mesh 0, positions", "stride"}),
      refuses_buffers("OfAStrideBetweenNumbers", [](MeshBuffers& b, unsigned) { b.positions.stride = 11; },
                      {"mesh 0, positions", "stride", "multiple of 4"}),
      refuses_buffers("NotAligned", [](MeshBuffers& b, unsigned) { b.indices.offset = 2; },
                      {"mesh 0, indices", "multiple of 4"}),
      refuses_buffers("OfNoComponent",
                      [](MeshBuffers& b, unsigned) { b.normals.type = static_cast<gl::Component>(9); },
                      {"component 9"}),
  };
}

std::vector<GlContract> of_contexts() {
  static int heard = 0;
  static constexpr auto listen = [](GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar*,
                                    const void* user) {
    EXPECT_EQ(user, &heard);
    ++heard;
  };
  return {
      {"AdoptedContext", "LeavesTheHostItsDebugCallback",
       [](gl::Context& context) {
         void *before = nullptr, *before_user = nullptr;
         glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &before);
         glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &before_user);
         heard = 0;
         glDebugMessageCallback(listen, &heard);
         {
           gl::Context adopted = gl::Context::adopt_current();
           glEnable(GL_TEXTURE_2D + 7777);
           EXPECT_EQ(heard, 1) << "the host hears what happens meanwhile";
           EXPECT_THROW(adopted.throw_on_error("x"), Error);
         }
         void *callback = nullptr, *user = nullptr;
         glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
         glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
         EXPECT_EQ(callback, reinterpret_cast<void*>(+listen));
         EXPECT_EQ(user, &heard);
         glEnable(GL_TEXTURE_2D + 7777);
         EXPECT_EQ(heard, 2);
         glDebugMessageCallback(reinterpret_cast<GLDEBUGPROC>(before), before_user);
         context.forget_errors();
       }},
      {"AdoptedContext", "AfterAnErrorOfTheHost",
       [](gl::Context& context) {
         glEnable(GL_TEXTURE_2D + 7777);
         gl::Context adopted = gl::Context::adopt_current();
         EXPECT_NO_THROW(adopted.throw_on_error("x"));
         context.forget_errors();
       }},
      {"Context", "ThatWasMoved",
       [](gl::Context& context) {
         gl::Context first = gl::Context::adopt_current();
         const gl::Context second = std::move(first);
         expect_refusal([&] { first.info(); }, {"moved from"});
         EXPECT_EQ(second.info().renderer, context.info().renderer);
       }},
      {"Context", "AssignedANewOneStaysCurrent",
       [](gl::Context& context) {
         gl::Context own = gl::Context::headless();
         own = gl::Context::headless();
         EXPECT_NE(glGetString(GL_VERSION), nullptr);
         context.make_current();
       }},
  };
}

std::string row_name(const testing::TestParamInfo<GlContract>& row) {
  return row.param.entry + row.param.given;
}
INSTANTIATE_TEST_SUITE_P(OfGl, GlContractTest, testing::ValuesIn(of_objects()), row_name);
INSTANTIATE_TEST_SUITE_P(OfContexts, GlContractTest, testing::ValuesIn(of_contexts()), row_name);
INSTANTIATE_TEST_SUITE_P(OfMeshBuffers, GlContractTest, testing::ValuesIn(of_mesh_buffers()), row_name);
INSTANTIATE_TEST_SUITE_P(OfRenderer, GlContractTest, testing::ValuesIn(of_renderer()), row_name);

}  // namespace
}  // namespace ssphh::test

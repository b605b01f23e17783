#include <array>
#include <fstream>
#include <vector>

#include <gmock/gmock.h>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/vertex_array.h>

#include "gl_context.h"
#include "temp_dir.h"

namespace ssphh::gl {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* triangle =
    "#version 450 core\n"
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n";
constexpr const char* paint =
    "#version 450 core\n"
    "#include \"color.glsl\"\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = vec4(the_color(), LAST); }\n";

class Gl : public test::WithGl {
 protected:
  static ShaderFiles files(std::string_view color, std::filesystem::path directory = {}) {
    const std::array<ShaderFiles::Embedded, 3> table{
        {{"triangle.vert", triangle}, {"paint.frag", paint}, {"color.glsl", color}}};
    return ShaderFiles(table, std::move(directory));
  }
};

TEST_F(Gl, SaysWhatItRunsOn) {
  EXPECT_THAT(gl().info().renderer, Not(IsEmpty()));
}

TEST_F(Gl, ProgramDrawsWhatItsIncludesSay) {
  Program program(files("vec3 the_color() { return vec3(0.25, 0.5, 2); }"), "triangle.vert", "paint.frag",
                  "#define LAST 7.0");
  EXPECT_THAT(program.warnings(), IsEmpty());
  Texture image(Format::rgba32f, 3, 2);
  const Framebuffer target(std::array<const Texture*, 1>{&image}, nullptr);
  bind_framebuffer(target.id(), {0, 0, 3, 2});
  apply_conventions();
  apply({});
  program.use();
  const VertexArray nothing;
  nothing.bind();
  draw_triangles(3);
  std::vector<float> texels(3 * 2 * 4);
  image.read(texels, 4);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(texels[4 * i], 0.25f);
    EXPECT_EQ(texels[4 * i + 2], 2.0f);
    EXPECT_EQ(texels[4 * i + 3], 7.0f);
  }
  gl().throw_on_error("test");
}

TEST_F(Gl, CompilersErrorsNameTheAuthorsFileAndLine) {
  try {
    Program program(files("// a comment\nvec3 the_color() { return no_such_thing; }"), "triangle.vert",
                    "paint.frag", "#define LAST 1.0");
    FAIL() << "compiled";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("paint.frag"));
    EXPECT_THAT(e.what(), HasSubstr("color.glsl:2"));
    EXPECT_THAT(e.what(), HasSubstr("no_such_thing"));
  }
}

TEST_F(Gl, MissingIncludeIsAnError) {
  const std::array<ShaderFiles::Embedded, 2> table{{{"triangle.vert", triangle}, {"paint.frag", paint}}};
  EXPECT_THROW(Program(ShaderFiles(table), "triangle.vert", "paint.frag"), Error);
}

TEST_F(Gl, FilesOnDiskReplaceBuiltInOnes) {
  const test::TempDir directory;
  std::ofstream(directory.path() / "color.glsl") << "vec3 the_color() { return vec3(1); }";
  const ShaderFiles both = files("broken", directory.path());
  EXPECT_NO_THROW(Program(both, "triangle.vert", "paint.frag", "#define LAST 1.0"));
  EXPECT_GT(both.newest_change(), std::filesystem::file_time_type::min());
}

TEST_F(Gl, MarksOfTheStencilStandBesideTheClass) {
  // Fragments of the left half are discarded: only the right half is marked, and the class stays
  const std::array<ShaderFiles::Embedded, 2> table{
      {{"triangle.vert", triangle},
       {"half.frag",
        "#version 450 core\nlayout(location = 0) out vec4 color;\n"
        "void main() { if (HALF != 0 && gl_FragCoord.x < 2) discard; color = vec4(1); }\n"}}};
  const ShaderFiles sources(table);
  const Program whole(sources, "triangle.vert", "half.frag", "#define HALF 0"),
      half(sources, "triangle.vert", "half.frag", "#define HALF 1");
  const Texture color(Format::rgba32f, 4, 1), depth(Format::depth32f_stencil8, 4, 1);
  const Framebuffer target(std::array<const Texture*, 1>{&color}, &depth);
  const VertexArray nothing;
  nothing.bind();
  apply_conventions();
  const auto draw = [&](const Program& program, const DrawState& state) {
    bind_framebuffer(target.id(), {0, 0, 4, 1});
    apply(state);
    program.use();
    draw_triangles(3);
  };
  bind_framebuffer(target.id(), {0, 0, 4, 1});
  clear_stencil(2);
  draw(half, {.color_write = false, .stencil_equal = 2, .stencil_mark = 0x80});
  const auto drawn_where = [&](int stencil) {
    clear_color(0, 0, 0, 0, 0);
    draw(whole, {.stencil_equal = stencil});
    std::vector<float> texels(4 * 4);
    color.read(texels, 4);
    return std::vector<float>{texels[0], texels[4], texels[8], texels[12]};
  };
  EXPECT_THAT(drawn_where(2), testing::ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(drawn_where(2 | 0x80), testing::ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(drawn_where(1), testing::ElementsAre(0, 0, 0, 0));
}

TEST_F(Gl, ComputeRunsOnAsManyGroupsAsABufferSays) {
  const std::array<ShaderFiles::Embedded, 1> table{
      {{"add.comp",
        "#version 450 core\nlayout(local_size_x = 2) in;\n"
        "layout(rgba32f, binding = 0) uniform image2D picture;\n"
        "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
        "  imageStore(picture, at, imageLoad(picture, at) + vec4(STEP, at, 1)); }\n"}}};
  Program program = Program::compute(ShaderFiles(table), "add.comp", "#define STEP 5");
  EXPECT_THAT(program.warnings(), IsEmpty());
  Texture picture(Format::rgba32f, 6, 2);
  const std::vector<float> zeros(6 * 2 * 4, 0);
  picture.upload(std::as_bytes(std::span(zeros)));
  const std::array<unsigned, 3> groups{2, 2, 1};
  const Buffer buffer{std::span<const unsigned>(groups)};
  picture.bind_image(0);
  program.use();
  for (int i = 0; i < 2; ++i) {
    dispatch(buffer);
    shader_memory_barrier();
  }
  std::vector<float> texels(zeros.size());
  picture.read(texels, 4);
  for (std::size_t x = 0; x < 6; ++x) {
    for (std::size_t y = 0; y < 2; ++y) {
      const float once = x < 4 ? 1 : 0;  // two groups of two
      const std::size_t i = 4 * (6 * y + x);
      EXPECT_THAT(std::vector<float>(texels.begin() + static_cast<std::ptrdiff_t>(i),
                                     texels.begin() + static_cast<std::ptrdiff_t>(i) + 4),
                  testing::ElementsAre(10 * once, 2 * static_cast<float>(x) * once,
                                       2 * static_cast<float>(y) * once, 2 * once));
    }
  }
}

TEST_F(Gl, TexelsSurviveTheRoundTrip) {
  Texture image(Format::rgba32f, 4, 3, 2);
  std::vector<float> texels(4 * 3 * 4);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = 0.37f * static_cast<float>(i) - 5;
  image.upload(std::as_bytes(std::span(texels)), 1);
  std::vector<float> back(2 * texels.size());
  image.read(back, 4);
  EXPECT_TRUE(
      std::equal(texels.begin(), texels.end(), back.begin() + static_cast<std::ptrdiff_t>(texels.size())));
}

TEST_F(Gl, MisuseBecomesAnError) {
  Texture image(Format::rgba8, 2, 2);
  image.bind(1000000);  // no such unit
  EXPECT_THROW(gl().throw_on_error("here"), Error);
  EXPECT_NO_THROW(gl().throw_on_error("here"));
  EXPECT_THROW(Texture(Format::rgba8, 1 << 20, 1), Error);
}

}  // namespace
}  // namespace ssphh::gl

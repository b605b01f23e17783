/// Programs: where their sources come from, what they are told, and what the compiler says.

#include <chrono>
#include <fstream>

#include <gmock/gmock.h>

#include "error_message.h"
#include "shaders.h"
#include "temp_dir.h"

namespace ssphh::gl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* one_group = "#version 450 core\nlayout(local_size_x = 1) in;\n";

class GlProgram : public WithShaders {
 protected:
  using Table = std::vector<ShaderFiles::Embedded>;
  /// The message of what refuses compute shader "a.comp" of a table.
  static std::string refusal(const Table& table, std::string_view defines = {}) {
    return test::message_of([&] { Program::compute(ShaderFiles(table), "a.comp", defines); });
  }
};

TEST_F(GlProgram, IsToldNumbersOfEveryKindByName) {
  Program program = compute_program(
      "uniform int whole; uniform ivec4 wholes, two, three; uniform float single; uniform vec2 pair;\n"
      "uniform vec3 triple; uniform vec4 quadruple; uniform mat4 turned; uniform float several[4];\n"
      "layout(location = 41) uniform int placed;",
      "i == 0 ? vec4(whole, single, pair) : i == 1 ? vec4(wholes) : i == 2 ? vec4(triple, placed)"
      " : i == 3 ? quadruple : i < 8 ? turned[i - 4] : i == 8 ? vec4(several[0], several[1], several[2],"
      " several[3]) : i == 9 ? vec4(two) : vec4(three)");
  program.set("whole", -3);
  program.set("single", 0.5f);
  program.set("pair", vec2(1.5f, 2.5f));
  program.set("wholes", 5, 6, 7, 8);
  program.set("triple", vec3(9, 10, 11));
  program.set("quadruple", vec4(12, 13, 14, 15));
  mat4 turned;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) turned[column][row] = static_cast<float>(100 + 10 * column + row);
  program.set("turned", turned);
  program.set("several", std::span<const float>(std::array{20.0f, 21.0f, 22.0f, 23.0f}));
  program.set("two", 31, 32);
  program.set("three", 33, 34, 35);
  program.set_at(41, 77);
  EXPECT_THAT(run(program, 11), ElementsAre(vec4(-3, 0.5f, 1.5f, 2.5f), vec4(5, 6, 7, 8), vec4(9, 10, 11, 77),
                                            vec4(12, 13, 14, 15), turned[0], turned[1], turned[2], turned[3],
                                            vec4(20, 21, 22, 23), vec4(31, 32, 0, 0), vec4(33, 34, 35, 0)));
  program.set("single", 0.75f);
  program.set("whole", 4);
  EXPECT_EQ(run(program, 1)[0], vec4(4, 0.75f, 1.5f, 2.5f)) << "told anew, by names that it knows";
  gl().throw_on_error("telling");
}

TEST_F(GlProgram, NamesThatTheShaderLacksAreIgnored) {
  Program program = compute_program("uniform int used;", "used");
  program.set("removed", 5);
  program.set("removed", vec3(1));
  program.set("used", 6);
  EXPECT_NO_THROW(gl().throw_on_error("telling"));
  EXPECT_EQ(run(program, 1)[0].x, 6);
}

TEST_F(GlProgram, FileIsIncludedOnceHoweverOftenItIsNamed) {
  const Table table{{"a.comp",
                     "#version 450 core\n#include \"b.glsl\"\n \t #include \"c.glsl\"\n#include \"b.glsl\"\n"
                     "layout(local_size_x = 1) in;\nvoid main() { b(); c(); }\n"},
                    {"b.glsl", "#include \"c.glsl\"\nvoid b() { c(); }\n"},
                    {"c.glsl", "#include \"a.comp\"\nvoid c() {}\n"}};
  EXPECT_EQ(refusal(table), "no error");
}

TEST_F(GlProgram, IncludeWithoutQuotationMarksIsRefusedWithItsPlace) {
  for (const char* line : {"#include <b.glsl>", "#include \"b.glsl", "  #include"}) {
    const std::string text = std::string("#version 450 core\n\n") + line + "\n";
    EXPECT_EQ(refusal({{"a.comp", text}, {"b.glsl", ""}}),
              "a.comp:3: #include needs a name in quotation marks");
  }
}

TEST_F(GlProgram, EveryLineOfAMessageNamesTheAuthorsLine) {
  // Four lines before the includes, of which two are defines; line 3 of b, then the last of a
  const Table table{{"a.comp",
                     "#version 450 core\nlayout(local_size_x = 1) in;\n#include \"b.glsl\"\n\nvoid main() {\n"
                     "  wrong_here();\n}\n"},
                    {"b.glsl", "// b\nvoid b() {\n  wrong_there();\n}\n"}};
  const std::string said = refusal(table, "#define ONE 1\n#define TWO 2");
  EXPECT_THAT(said, StartsWith("shader a.comp: "));
  EXPECT_THAT(said, AllOf(HasSubstr("b.glsl:3"), HasSubstr("a.comp:6")));
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.find('\0'), std::string::npos);
    if (line.find("wrong_there") != std::string::npos) {
      EXPECT_THAT(line, HasSubstr("b.glsl:3"));
    }
    if (line.find("wrong_here") != std::string::npos) {
      EXPECT_THAT(line, HasSubstr("a.comp:6"));
    }
  }
}

TEST_F(GlProgram, MistakeInADefineIsOneOfTheVersionsLine) {
  const std::string text = std::string("\n\n") + one_group + "int x = NUMBER;\nvoid main() {}\n";
  EXPECT_THAT(refusal({{"a.comp", text}}, "#define NUMBER no_such_number"), HasSubstr("a.comp:5"));
  EXPECT_THAT(refusal({{"a.comp", std::string(one_group) + "void main() {}\n"}}, "this is no GLSL"),
              HasSubstr("a.comp:1"));
}

TEST_F(GlProgram, DefinesAreOfAllShadersButStandOnceInEach) {
  const Table table{
      {"a.vert",
       "#version 450 core\n#ifndef GIVEN\n#error a.vert knows nothing of it\n#endif\n"
       "void main() { gl_Position = vec4(GIVEN); }\n"},
      {"a.frag", "#version 450 core\n#ifndef GIVEN\n#error nor a.frag\n#endif\nvoid main() {}\n"}};
  EXPECT_NO_THROW(Program(ShaderFiles(table), "a.vert", "a.frag", "#define GIVEN 1"));
  EXPECT_THAT(test::message_of([&] { Program(ShaderFiles(table), "a.vert", "a.frag"); }),
              AllOf(StartsWith("shader a.vert: "), HasSubstr("knows nothing")));
}

TEST_F(GlProgram, ShadersThatDoNotFitAreRefusedByBothNames) {
  const Table table{
      {"a.vert",
       "#version 450 core\nout vec2 given;\nvoid main() { given = vec2(0); gl_Position = vec4(0); }\n"},
      {"a.frag", "#version 450 core\nin vec4 given;\nout vec4 color;\nvoid main() { color = given; }\n"}};
  const std::string said = test::message_of([&] { Program(ShaderFiles(table), "a.vert", "a.frag"); });
  EXPECT_THAT(said, AllOf(StartsWith("shader program a.vert + a.frag: "), HasSubstr("given")));
  const Table twice{{"a.comp", std::string_view("#version 450 core\nlayout(local_size_x = 1) in;\nvoid f();\n"
                                                "void main() { f(); }\n")}};
  EXPECT_THAT(refusal(twice), AllOf(StartsWith("shader program a.comp: "), HasSubstr("f")));
}

TEST_F(GlProgram, WarningsAreThoseOfAllItsShaders) {
  // Another text each time: a program out of the driver's cache has none
  const std::string once =
      "// " + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()) + "\n";
  const std::string fragment =
      "#version 450 core\nout vec4 color;\nvoid main() {\n  int first;\n"
      "  color = vec4(first);\n}\n" +
      once;
  const std::string vertex =
      "#version 450 core\nvoid main() {\n\n  float other;\n"
      "  gl_Position = vec4(other);\n}\n" +
      once;
  const Table table{{"a.vert", vertex}, {"a.frag", fragment}};
  const Program program(ShaderFiles(table), "a.vert", "a.frag");
  if (program.warnings().empty())
    GTEST_SKIP() << "this compiler does not warn of what is used without a value";
  EXPECT_THAT(program.warnings(), AllOf(HasSubstr("a.vert:5"), HasSubstr("a.frag:5")));
  EXPECT_THAT(program.warnings(), HasSubstr("\na.frag:5"));
}

TEST_F(GlProgram, ShaderThatDoesNotCompileIsNoErrorOfWhatComesNext) {
  EXPECT_NE(refusal({{"a.comp", "#version 450 core\nthis is no GLSL"}}), "no error");
  EXPECT_NO_THROW(gl().throw_on_error("drawing"));
}

TEST_F(GlProgram, OfNothingSaysSo) {
  EXPECT_EQ(refusal({}), "shader a.comp: there is no such file");
  EXPECT_EQ(Program().id(), 0u);
}

TEST_F(GlProgram, MovedOneIsTheSameProgram) {
  Program first = compute_program("uniform int a;", "a");
  const unsigned id = first.id();
  Program second = std::move(first);
  EXPECT_EQ(second.id(), id);
  EXPECT_EQ(first.id(), 0u);
  first = std::move(second);
  EXPECT_EQ(first.id(), id);
}

TEST(ShaderFilesTest, KnowsTheNewestChangeOfItsDirectory) {
  using std::filesystem::file_time_type;
  const test::TempDir directory;
  const std::span<const ShaderFiles::Embedded> none;
  EXPECT_FALSE(ShaderFiles(none).on_disk());
  EXPECT_EQ(ShaderFiles(none).newest_change(), file_time_type::min());
  const ShaderFiles files(none, directory.path());
  EXPECT_TRUE(files.on_disk());
  const auto now = file_time_type::clock::now();
  for (const auto& [name, age] : {std::pair("a", 20), {"b", 10}, {"c", 30}}) {
    std::ofstream(directory / name) << "x";
    std::filesystem::last_write_time(directory / name, now - std::chrono::hours(age));
  }
  EXPECT_EQ(files.newest_change(), std::filesystem::last_write_time(directory / "b"));
  EXPECT_EQ(ShaderFiles(none, directory / "missing").newest_change(), file_time_type::min());
}

TEST(ShaderFilesTest, FileOfTheDirectoryWinsAndOthersAreBuiltIn) {
  const test::TempDir directory;
  std::ofstream(directory / "a") << "from disk";
  const std::array<ShaderFiles::Embedded, 2> table{{{"a", "built in"}, {"b", "b, built in"}}};
  const ShaderFiles files(table, directory.path());
  EXPECT_EQ(files.text("a"), "from disk");
  EXPECT_EQ(files.text("b"), "b, built in");
  EXPECT_EQ(ShaderFiles(table).text("a"), "built in");
}

}  // namespace
}  // namespace ssphh::gl

/// What one driver takes and another refuses. Drivers by Mesa, the only ones that tests run on, are lenient.

#include <regex>

#include <gtest/gtest.h>

#include "shader_constants.h"
#include "shader_table.h"

namespace ssphh::realtime {
namespace {

/// The arguments of the call whose opening parenthesis stands before `begin`.
std::vector<std::string> arguments(std::string_view text, std::size_t begin) {
  std::vector<std::string> found(1);
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == ')' && depth-- == 0) break;
    if (text[i] == '(') ++depth;
    if (text[i] == ',' && depth == 0) {
      found.emplace_back();
    } else if (text[i] != ' ') {
      found.back() += text[i];
    }
  }
  return found;
}

/// Calls of `clamp` and the like with 1 beside 1e-3, which NVIDIA's compiler calls ambiguous: between float
/// and double.
std::vector<std::string> mixed_literals(std::string_view text) {
  static const std::regex call(R"(\b(clamp|min|max|mix|pow|step|smoothstep)\()"), whole(R"(-?\d+)"),
      real(R"(-?(\d+\.\d*|\d+)(e-?\d+)?)");
  std::vector<std::string> found;
  const std::string all(text);
  for (std::sregex_iterator at(all.begin(), all.end(), call), end; at != end; ++at) {
    bool has_whole = false, has_real = false;
    std::string shown = at->str();
    for (const std::string& argument :
         arguments(text, static_cast<std::size_t>(at->position() + at->length()))) {
      const bool is_whole = std::regex_match(argument, whole);
      has_whole |= is_whole;
      has_real |= !is_whole && std::regex_match(argument, real);
      shown += argument + ",";
    }
    if (has_whole && has_real) found.push_back(shown);
  }
  return found;
}

TEST(ShaderText, MixedLiteralsAreFound) {
  EXPECT_EQ(mixed_literals("a = clamp(r * r, 1e-3, 1);").size(), 1u);
  EXPECT_EQ(mixed_literals("a = max(f(0, 1), 1.0) + min(ivec2(1), 3) + clamp(x, 0.0, 1.0);").size(), 0u);
  EXPECT_EQ(mixed_literals("max(2.0, clamp(x, 0, 1.))").size(), 1u);
}

TEST(ShaderText, CallsHaveLiteralsOfOneKind) {
  for (const gl::ShaderFiles::Embedded& file : shader_table()) {
    const auto found = mixed_literals(file.text);
    EXPECT_TRUE(found.empty()) << file.name << ": " << found.front();
  }
}

// A number that C++ has as well stands there alone.
TEST(ShaderText, ConstantsOfCppAreUsedAndNotSaidAgain) {
  static const std::regex define(R"(#define (\w+) \S+\n)");
  const std::string& lines = shader_constants();
  for (std::sregex_iterator at(lines.begin(), lines.end(), define), end; at != end; ++at) {
    const std::string name = at->str(1);
    const std::regex whole("\\b" + name + "\\b"),
        again("(const\\s+\\w+[^;]*\\b" + name + "\\s*=|define\\s+" + name + "\\b)");
    bool used = false;
    for (const gl::ShaderFiles::Embedded& file : shader_table()) {
      const std::string text(file.text);
      used |= std::regex_search(text, whole);
      EXPECT_FALSE(std::regex_search(text, again)) << name << " in " << file.name;
    }
    EXPECT_TRUE(used) << name;
  }
}

TEST(ShaderText, BindingsStandInCpp) {
  static const std::regex number(R"(\bbinding\s*=\s*\d)");
  for (const gl::ShaderFiles::Embedded& file : shader_table())
    EXPECT_FALSE(std::regex_search(std::string(file.text), number)) << file.name;
}

}  // namespace
}  // namespace ssphh::realtime

// Scenes that come in many, one line each: a change of one changes its line.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>

#include "expected_text.h"
#include "text_digest.h"

namespace ssphh::scene {
namespace {

TEST(BuiltinNumberText, EachIsThatOfTheList) {
  std::string text;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    if (!builtin.number) continue;
    const int most =
        std::min(builtin.number->most, builtin.number->least + (builtin.name == "random" ? 47 : 3));
    for (int number = builtin.number->least; number <= most; ++number) {
      const Scene scene = builtin.number->make(number);
      const test::TextDigest digest = test::digest_of(test::scene_text(scene));
      text += fmt::format("{} {}: \"{}\", {} meshes, {} nodes, {} lights, {}, words x{:08x}\n", builtin.name,
                          number, scene.name, scene.meshes.size(), scene.nodes.size(), scene.lights.size(),
                          test::numbers_text(digest), test::hash_of(digest.words));
    }
  }
  test::expect_text_of("libs/scene/tests/expected/in-many.txt", text);
}

}  // namespace
}  // namespace ssphh::scene

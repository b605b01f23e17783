// Every number of the built-in scenes, which documents, pictures and benchmarks rely on: where walls, lamps,
// doors and cameras stand, what they are made of, how they move. A file each in expected/.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>

#include "expected_text.h"
#include "scene_text.h"

namespace ssphh::scene {
namespace {

TEST(BuiltinText, EveryNumberIsThatOfTheList) {
  std::string table;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    table += builtin.name + ": " + builtin.description + "\n";
    if (builtin.number) continue;  // builtin_number_test.cpp
    test::expect_text_of("libs/scene/tests/expected/" + builtin.name + ".txt",
                         test::scene_text(make_builtin(builtin.name)));
  }
  test::expect_text_of("libs/scene/tests/expected/builtin.txt", table);
}

}  // namespace
}  // namespace ssphh::scene

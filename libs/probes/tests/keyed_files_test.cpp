// Several files as keys: times by hand or of the bakes, in order, none twice.

#include <gtest/gtest.h>

#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/probe_file.h>

#include "error_message.h"
#include "random_set.h"
#include "temp_dir.h"

namespace ssphh::probes {
namespace {

TEST(KeyedFiles, AreReadInTheOrderOfTheirTimesAndNoneTwice) {
  const test::TempDir dir;
  const std::string a = dir / "a.sphl", b = dir / "b.sphl";
  ProbeSet set = test::random_set(1, 3, 1);
  set.generator.time = 2;
  write_probe_file(set, a);
  set.generator.time = 0.5f;
  write_probe_file(set, b);
  const auto times = [](const std::string& text) {
    std::vector<float> found;
    for (const KeyedSet& key : read_keyed_sets(read_probe_keys(text))) found.push_back(key.time);
    return found;
  };
  EXPECT_EQ(times(a + "," + b), (std::vector<float>{0.5f, 2}));
  EXPECT_EQ(times(a + "," + b + "@3"), (std::vector<float>{2, 3}));
  const auto said = [&](const std::string& text) { return test::message_of([&] { times(text); }); };
  const std::string same = "give keys their times: FILE@SECONDS,FILE@SECONDS";
  EXPECT_EQ(said(a + "," + b + "@2"), b + ": is a key at 2 s, as another is (" + same + ")");
  EXPECT_EQ(said(a + "@x"), a + "@x: has no time after its @ (write FILE@SECONDS, as door.sphl@0.5)");
}

}  // namespace
}  // namespace ssphh::probes

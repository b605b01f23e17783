// `ssphh cook` on a small set that was made by hand.

#include <ssphh/core/file.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/runtime/runtime.h>
#include <ssphh/scene/builtin.h>

#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CookTool : public testing::Test {
 protected:
  CookTool() {
    probes::ProbeSet set = place::init_from_scene(scene::make_builtin("two-rooms"), 6);
    set.light_groups = {{"lamp"}, {"the sun"}};
    set.light_groups[1].mode = scene::LightMode::baked;
    for (probes::Probe& probe : set.probes) {
      probe.groups.resize(2);
      for (probes::GroupLight& light : probe.groups) {
        light.reflected = sh::RadianceSh(6);
        light.reflected[0] = vec3(1, 2, 3);
      }
    }
    probes::merge_groups(set);
    probes::write_probe_file(set, file_);
  }
  std::vector<std::string> cook(const std::vector<std::string>& more = {}) const {
    return joined({"cook", file_, "-o", out_}, more);
  }
  static std::vector<std::string> in_rooms(const std::vector<std::string>& more = {}) {
    return joined({"--scene", "builtin:two-rooms", "--points", "64", "--force"}, more);
  }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "a.sphl", out_ = dir_ / "a.sphlc";
};

TEST_F(CookTool, WritesAFileThatOpensAndComparesIt) {
  const json::Value said = json_here(cook(in_rooms()));
  const std::vector<std::byte> file = read_file(out_);
  EXPECT_EQ(*said["bytes"].integer(), static_cast<std::int64_t>(file.size()));
  EXPECT_EQ(said["groups"], json::Value::array({"lamp", "the sun"}));
  EXPECT_EQ(*said["probes"].integer(), 6);
  EXPECT_EQ(*said["points"].integer(), 0);
  EXPECT_GT(*said["sight_bytes"].integer(), 0);
  // The same light at every probe: whatever hides them, the mean is the full lookup's
  for (const char* where : {"on_surfaces", "in_the_open"}) {
    EXPECT_GT(*said[where]["points"].integer(), 0);
    EXPECT_NEAR(said[where]["ratio"].number(), 1, 0.1) << where;
  }
  std::size_t size = 0;
  ASSERT_EQ(ssphh_runtime_size_needed(file.data(), file.size(), &size), SSPHH_RUNTIME_OK);
  EXPECT_EQ(*said["memory"].integer(), static_cast<std::int64_t>(size));
  std::vector<std::byte> memory(size);
  ssphh_runtime* runtime = nullptr;
  ASSERT_EQ(ssphh_runtime_open(file.data(), file.size(), memory.data(), size, &runtime), SSPHH_RUNTIME_OK);
  // E = π L, L = Y₀₀ c, of both groups
  const float place[] = {-1, 1, 0}, normal[] = {0, 1, 0};
  float rgb[3];
  ASSERT_EQ(ssphh_runtime_irradiance(runtime, SSPHH_RUNTIME_OPEN, place, normal, rgb), SSPHH_RUNTIME_OK);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(rgb[c], 2 * pi * 0.28209479f * static_cast<float>(c + 1), 1e-4f * static_cast<float>(c + 1));
}

TEST_F(CookTool, TellsWhatIsNotCarried) {
  EXPECT_THAT(test::text_here(cook()), AllOf(HasSubstr("without --scene every probe counts as seen"),
                                             HasSubstr("bands 5 to 6"), Not(HasSubstr("against the full"))));
  EXPECT_THAT(test::text_here(cook(in_rooms())),
              AllOf(HasSubstr("on surfaces  ratio 1."), HasSubstr("in the open  ratio"),
                    HasSubstr("groups       lamp, the sun"), Not(HasSubstr("without --scene"))));
}

TEST_F(CookTool, SightTakesRoomByItsTexels) {
  for (const auto& [texels, bytes] : {std::pair{"8", 6 * 6 * 64 * 2}, {"0", 0}}) {
    const json::Value said = json_here(cook(in_rooms({"--sight", texels})));
    EXPECT_EQ(*said["sight_bytes"].integer(), bytes);
  }
  const json::Value quiet = json_here(cook({"--scene", "builtin:two-rooms", "--points", "0", "--force"}));
  EXPECT_FALSE(json::print(quiet).find("on_surfaces") != std::string::npos);
}

TEST_F(CookTool, BadInputIsNamed) {
  EXPECT_THAT(problem_here({"cook", file_, "-o", dir_ / "a.bin"}), HasSubstr("named .sphlc"));
  EXPECT_THAT(problem_here(joined(cook(), {"--scene", "builtin:cornell"})), HasSubstr("another scene"));
  EXPECT_THAT(problem_here(cook(in_rooms({"--sight", "3"}))), HasSubstr("0 or 8 to 256"));
  EXPECT_THAT(problem_here({"cook", dir_ / "none.sphl", "-o", out_}), HasSubstr("none.sphl"));
  EXPECT_THAT(problem_here(cook({"--places-of", file_})), HasSubstr("needs --scene"));
  const std::string other = dir_ / "b.sphl";
  probes::ProbeSet fewer = probes::read_probe_file(file_);
  fewer.probes.pop_back();
  probes::write_probe_file(fewer, other);
  EXPECT_THAT(problem_here(cook(in_rooms({"--places-of", other}))), HasSubstr("of other probes"));
  EXPECT_FALSE(std::filesystem::exists(out_)) << "nothing was written";
}

}  // namespace
}  // namespace ssphh

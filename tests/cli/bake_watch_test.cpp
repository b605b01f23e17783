// `bake --watch`: a real process whose scene is saved again and again.

#include "commands/bake_watch.h"

#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/probes/probe_file.h>

#include "here.h"
#include "temp_dir.h"
#include "tev_listener.h"
#include "tool.h"

namespace ssphh {
namespace {

using testing::HasSubstr;

class BakeWatch : public testing::Test {
 protected:
  /// The overlay with a lamp of so many candela and more members, as an editor saves it.
  void save(int candela, const std::string& more = "") const {
    write_file(scene_, R"({"scene": "builtin:cornell", "lights": [{"name": "l", "type": "point",
                          "position": [0, 1, 0], "intensity": )" +
                           std::to_string(candela) + "}]" + more + "}");
  }
  std::vector<std::string> bake(const std::string& output) const {
    return {"bake",      scene_, "-o",       output, "--face",       "4",  "--spp",         "4",
            "--records", "100",  "--degree", "2",    "--directions", "64", "--surfel-size", "0.3"};
  }
  static std::string bytes(const std::string& file) { return read_text_file(file, 1 << 24); }

  const test::TempDir dir_;
  const std::string scene_ = dir_ / "room.ssphh.json", out_ = dir_ / "out.sphl", full_ = dir_ / "full.sphl",
                    picture_ = dir_ / "p.png";
};

TEST_F(BakeWatch, FollowsSavesUntilCtrlC) {
  save(2);
  test::TevListener tev;
  test::ToolProcess tool(test::joined(bake(out_), {"--watch", "--preview", picture_, "--tev", tev.address(),
                                                   "--tolerance", "0", "--progress", "none", "--json"}));
  ASSERT_TRUE(tool.wait_for_stderr("watching 1 file;")) << tool.stderr_so_far();
  test::json_here(bake(full_));
  EXPECT_EQ(bytes(out_), bytes(full_));
  const image::Image first = image::read_image(picture_);
  EXPECT_EQ(first.width, 480);

  save(8);
  ASSERT_TRUE(tool.wait_for_stderr("with the light of before the picture was")) << tool.stderr_so_far();
  test::json_here(bake(full_));
  EXPECT_EQ(bytes(out_), bytes(full_));
  EXPECT_NE(image::read_image(picture_).pixels, first.pixels);

  write_file(scene_, R"({"scene": )");
  ASSERT_TRUE(tool.wait_for_stderr("waiting for the next save")) << tool.stderr_so_far();
  EXPECT_EQ(bytes(out_), bytes(full_)) << "a broken file changes nothing";

  // Saves that come at once are one
  const std::string blue = R"(, "materials": [{"name": "red", "base_color": [0, 0, 1]}])";
  save(3), save(4), save(5, blue);
  ASSERT_TRUE(tool.wait_for_stderr("left wall\" (surface), light \"l\" (emission); 5 of 5 probes baked"))
      << tool.stderr_so_far();
  test::json_here(bake(full_));
  EXPECT_EQ(bytes(out_), bytes(full_));

  tool.signal(SIGINT);
  const test::ToolResult ended = tool.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::vector<image::Image>& seen = tev.shown().seen.at(picture_);
  EXPECT_EQ(seen.size(), 5u)
      << "the first, and two of each save that could be read: with the light of before, and after";
  EXPECT_EQ(seen[0].width, 480);
  EXPECT_NE(seen[0].pixels, seen[2].pixels);
  const json::Value result = test::parse_json(ended.out);
  EXPECT_EQ(result["first"]["probes"], 5);
  ASSERT_EQ(result["rounds"].size(), 3u) << ended.err;
  EXPECT_EQ(result["rounds"][0]["changed"][0]["name"], "l");
  EXPECT_EQ(result["rounds"][0]["probes_baked"], 5);
  EXPECT_GT(result["rounds"][0]["picture_was_off"].number(), 0.01);
  EXPECT_THAT(result["rounds"][1]["problem"].string(), HasSubstr("not valid JSON"));
  EXPECT_TRUE(result["rounds"][2]["problem"].is_null());
}

TEST_F(BakeWatch, NeedsAFileAndWhatItCanBegin) {
  EXPECT_THAT(test::problem_here({"bake", "builtin:cornell", "-o", out_, "--watch"}),
              HasSubstr("builtin:cornell is no file"));
  write_file(scene_, "{");
  EXPECT_THAT(test::problem_here(test::joined(bake(out_), {"--watch"})), HasSubstr("room.ssphh.json"));
}

TEST_F(BakeWatch, WaitsForAnyOfTheFilesAndEndsWhenItIsCancelled) {
  save(2);
  const FileStamp before = stamp_of(scene_);
  std::vector<FileStamp> files = {before, stamp_of(dir_ / "missing")};
  write_file(dir_ / "missing", "now it is there");
  EXPECT_TRUE(app::wait_for_save(files, {}));
  CancelToken cancel;
  cancel.request();
  EXPECT_FALSE(app::wait_for_save({before}, {nullptr, &cancel}));
}

}  // namespace
}  // namespace ssphh

// Recent scenes, and the walk to a file.

#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "model/file_browser.h"
#include "model/preferences.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST(Preferences, RecentScenesStandOnceTheLastOneFirst) {
  Preferences p;
  remember(p, "/a.glb"), remember(p, "/b.glb"), remember(p, "/x/../a.glb");
  EXPECT_THAT(p.recent, ElementsAre("/a.glb", "/b.glb"));
  forget(p, "/b.glb");
  EXPECT_THAT(p.recent, ElementsAre("/a.glb"));
  for (int i = 0; i < 20; ++i) remember(p, "/" + std::to_string(i));
  EXPECT_EQ(p.recent.size(), Preferences::most_recent);
  EXPECT_EQ(p.recent.front(), "/19");
  EXPECT_EQ(lasting_name("builtin:cornell"), "builtin:cornell");
  EXPECT_EQ(lasting_name("rooms.glb"), (fs::current_path() / "rooms.glb").string());
}

TEST(Preferences, ComeBackAndBrokenOnesAreRefused) {
  const test::TempDir dir;
  const fs::path file = dir / "config" / "preferences.json";
  EXPECT_TRUE(read_preferences(file).recent.empty());
  const WindowLook look{21.5f, true, false, true, Quality::best, true, 22.5f};
  write_preferences({{"/a b.glb", "/ä.glb"}, look}, file);
  EXPECT_EQ(read_preferences(file).look, look);
  EXPECT_THAT(read_preferences(file).recent, ElementsAre("/a b.glb", "/ä.glb"));
  for (const char* text :
       {"{", "[]", R"({"format": "other", "version": 1})", R"({"format": "ssphh-preferences", "version": 9})",
        R"({"format": "ssphh-preferences", "version": 1, "recent": [3]})"}) {
    write_file(file, std::string_view(text));
    EXPECT_THROW(read_preferences(file), Error) << text;
  }
  EXPECT_THROW(write_preferences({}, "/proc/nowhere/preferences.json"), Error);
}

class Browser : public testing::Test {
 protected:
  Browser() {
    for (const char* folder : {"scenes", "scenes/deep", "scenes/.hidden", "Old"})
      fs::create_directory(dir_ / folder);
    for (const char* file : {"scenes/house.glb", "scenes/Hall.GLB", "scenes/notes.txt", "scenes/house-2.glb",
                             "scenes/deep/x.glb", "scenes/.secret.glb"})
      std::ofstream(dir_ / file) << "x";
  }
  FileBrowser in(const char* folder, const char* name = "") { return {dir_ / folder, {".glb"}, name}; }
  static std::vector<std::string> names(const FileBrowser& browser) {
    std::vector<std::string> out;
    for (const auto& entry : browser.entries()) out.push_back(entry.name + (entry.folder ? "/" : ""));
    return out;
  }
  test::TempDir dir_;
};

TEST_F(Browser, ListsFoldersThenFilesOfTheseKinds) {
  EXPECT_THAT(names(in("scenes")), ElementsAre("deep/", "Hall.GLB", "house-2.glb", "house.glb"));
  EXPECT_THAT(names(in("")), ElementsAre("Old/", "scenes/"));
  const FileBrowser gone = in("scenes/none/below");
  EXPECT_EQ(gone.folder(), dir_ / "scenes") << "the nearest that is there";
}

TEST_F(Browser, TheMarkMovesAndEnterFollowsIt) {
  FileBrowser browser = in("scenes");
  EXPECT_EQ(browser.selected(), -1);
  EXPECT_THROW(browser.choose(), Error) << "nothing is marked";
  browser.move(1);
  EXPECT_EQ(browser.selected(), 0);
  browser.move(-1);
  EXPECT_EQ(browser.selected(), 0);
  browser.move(100);
  EXPECT_EQ(browser.selected(), 3);
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "house.glb");
  browser.select(0);
  EXPECT_EQ(browser.choose(), std::nullopt);
  EXPECT_EQ(browser.folder(), dir_ / "scenes" / "deep");
  EXPECT_EQ(browser.selected(), -1);
  browser.up();
  EXPECT_EQ(browser.folder(), dir_ / "scenes");
  EXPECT_EQ(browser.selected(), 0) << "the folder that it comes from";
  for (int i = 0; i < 20; ++i) browser.up();
  EXPECT_EQ(browser.folder(), "/");
}

TEST_F(Browser, WhatIsTypedIsANameOrAPath) {
  FileBrowser browser = in("scenes");
  browser.type("house.glb");
  EXPECT_EQ(browser.selected(), 3);
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "house.glb");
  browser.type("ha");
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "Hall.GLB") << "its beginning, in whatever case";
  browser.type("zzz.glb");
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "zzz.glb") << "whether there is one is the caller's";
  browser.type("../Old/");
  EXPECT_EQ(browser.choose(), std::nullopt);
  EXPECT_EQ(browser.folder(), dir_ / "Old");
  EXPECT_EQ(browser.typed(), "");
  browser.type((dir_ / "scenes/deep/x.glb").string());
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "deep" / "x.glb");
  browser.up();
  browser.type("scenes");
  EXPECT_EQ(browser.choose(), std::nullopt);
  EXPECT_EQ(browser.folder(), dir_ / "scenes");
}

TEST_F(Browser, TabCompletesAsFarAsAllAgree) {
  FileBrowser browser = in("");
  const auto completed = [&](const std::string& text) {
    browser.type(text), browser.complete();
    return browser.typed();
  };
  EXPECT_EQ(completed("s"), "scenes/");
  EXPECT_EQ(completed("scenes/ho"), "scenes/house");
  EXPECT_EQ(completed("scenes/house-"), "scenes/house-2.glb");
  EXPECT_EQ(completed("scenes/h"), "scenes/h") << "Hall and house";
  EXPECT_EQ(completed("scenes/ha"), "scenes/Hall.GLB");
  EXPECT_EQ(completed("scenes/n"), "scenes/n") << "no file of this kind";
  EXPECT_EQ(completed((dir_ / "scen").string()), (dir_ / "scenes/").string());
}

TEST_F(Browser, AFileThatIsWrittenKeepsItsNameThroughFolders) {
  FileBrowser browser = in("scenes", "rooms.glb");
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "rooms.glb");
  browser.select(0);
  EXPECT_EQ(browser.choose(), std::nullopt);
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "deep" / "rooms.glb");
  browser.select(0);
  EXPECT_EQ(browser.typed(), "x.glb") << "another file's name is taken";
  browser.type("hal");
  browser.up();
  browser.type("hal");
  EXPECT_EQ(browser.choose(), dir_ / "scenes" / "hal") << "a new name may begin as another one does";
}

}  // namespace
}  // namespace ssphh::viewer

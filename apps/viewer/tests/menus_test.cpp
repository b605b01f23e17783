// What files, the bar of time and the menus do.

#include <array>
#include <vector>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene_io/load.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using Menus = PanelStage;
using testing::ElementsAre;

TEST_F(Menus, FilesAreWrittenAndRead) {
  open("Picture");
  click_text("Save scene as?");
  ASSERT_TRUE(app().dialog);
  app().choose_file();
  EXPECT_TRUE(std::filesystem::exists("stage-01.glb"));
  take_probes();
  open("Probes");
  click_text("Save");
  EXPECT_EQ(probes::read_probe_file("probes.sphl").probes.size(), 6u);
  click_text("Open");
  EXPECT_EQ(app().question.then, Question::Then::take_probes) << "baked in no scene";
  app().answer(Answer::stay);
  rest();
  app().times.add("frame", 3);
  open("Times");
  click_text("Save .csv or .json");
  EXPECT_TRUE(std::filesystem::exists("times.csv"));
  click_text("Begin anew");
  EXPECT_TRUE(app().times.stages().empty());
  EXPECT_THAT(app().report.written,
              ElementsAre(testing::EndsWith("/stage-01.glb"), "probes.sphl", "times.csv"));
}

TEST_F(Menus, AFileThatIsThereIsReplacedOnceTheButtonIsPressedAgain) {
  take_probes();
  app().times.add("frame", 3);
  app().add_bookmark();
  const std::vector<std::array<const char*, 4>> buttons = {
      {"Probes", "Save", "Replace", "probes.sphl"},
      {"Camera", "Save", "Replace", "path.json"},
      {"Times", "Save .csv or .json", "Replace the file", "times.csv"}};
  for (const auto& [tab, save, replace, file] : buttons) {
    SCOPED_TRACE(file);
    write_file(file, std::string_view("mine"));
    open(tab);
    click_text(save);
    EXPECT_EQ(read_text_file(file), "mine");
    EXPECT_THAT(app().message, testing::StartsWith(std::string(file) + " is there already"));
    open("Light"), open(tab);
    click_text(replace);
    EXPECT_NE(read_text_file(file), "mine");
    click_text(save);
    EXPECT_TRUE(shows(replace)) << "asked each time";
  }
  app().say("");
  open("Camera");
  EXPECT_FALSE(shows("Replace")) << "another file was asked about";
}

TEST_F(Menus, LightGroupsAtFactor0AreSavedAndCanBeTurnedUpAgain) {
  app().take_document(document("gallery1"));
  const Hash128 lit = scene::scene_hash(app().document.edited());
  app().edit("off", [](Edits& e) { e.groups["cove"] = e.groups["back"] = vec3(0); });
  const Hash128 dark = scene::scene_hash(app().document.edited());
  EXPECT_NE(dark, lit);
  for (const char* file : {"dark.glb", "off.ssphh.json"}) {
    app().save_scene(file);
    EXPECT_EQ(scene::scene_hash(scene_io::load_scene(file)), dark) << file << ": as everybody reads it";
    const Document again = make_document(file, scene_io::load_scene(file, {.keep_dark_light = true}), 0);
    EXPECT_EQ(scene::scene_hash(again.edited()), dark) << file;
    EXPECT_EQ(scene::light_hash(*again.opened), scene::light_hash(scene_io::load_scene(file)))
        << file << ": probes that were baked of it are taken";
    Edits edits = again.edits();
    EXPECT_EQ(edits.groups, app().document.edits().groups) << file;
    for (auto& [group, factor] : edits.groups) factor = vec3(1);
    EXPECT_EQ(scene::scene_hash(edited_scene(*again.opened, edits, 0)), lit) << file;
  }
}

TEST_F(Menus, SnapIsKeptForLaterSessions) {
  options_.preferences = dir_ / "config" / "preferences.json";
  start(1000, 1500);
  EXPECT_FALSE(app().settings.snap);
  app().settings.snap = true, app().settings.snap_angle = 22.5f;
  app().keep_look();
  start(1000, 1500);
  EXPECT_TRUE(app().settings.snap);
  EXPECT_EQ(app().settings.snap_angle, 22.5f);
  options_.settings = {{"snap", "off"}};
  EXPECT_FALSE(start(1000, 1500).settings.snap) << "the command line comes first";
}

TEST_F(Menus, TheBarOfTimePlaysAndShowsWork) {
  rest();
  click_text("Play");
  EXPECT_TRUE(app().settings.play);
  click_text("Stop");
  EXPECT_FALSE(app().settings.play);
  std::atomic<bool> end = false;
  app().job.start("work", [&](const Control& control) -> BackgroundJob::Finish {
    ProgressStage stage(control, "stones", 4, "stones");
    stage.advance(1);
    while (!end && !control.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  });
  while (app().job.status().stage != "stones" || app().job.status().fraction != 0.25)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  app().selection = {};
  open("Probes");
  expect_drawn("work", drawn_listing());
  const DrawnThing gen = text("GEN, VIZ");
  click(gen.from.x + 3, gen.from.y + 6);
  EXPECT_EQ(app().job.status().name, "work") << "one thing at a time";
  rest();
  click_text("Cancel");
  while (app().job.running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  rest();
  EXPECT_TRUE(shows("0 probes"));
  end = true;
}

TEST_F(Menus, MenusDoWhatTheySay) {
  const auto choose = [&](const char* menu, const std::string& item) {
    rest();
    const DrawnThing at = text(menu);
    click(at.from.x + 3, at.from.y + 5);
    frames(3);
    const DrawnThing entry = text(item);
    click(entry.from.x + 3, entry.from.y + 5);
    rest();
  };
  const std::pair<const char*, DebugView> views[] = {{"Direct light only", DebugView::direct},
                                                     {"Indirect light only", DebugView::indirect},
                                                     {"Albedo", DebugView::albedo},
                                                     {"Normals", DebugView::normal},
                                                     {"Shadows", DebugView::shadow},
                                                     {"Chosen SPHL", DebugView::sphl},
                                                     {"Leaked light", DebugView::leak},
                                                     {"All light", DebugView::none}};
  for (const auto& [name, view] : views) {
    choose("View", name);
    EXPECT_EQ(app().settings.debug, view) << name;
  }
  const std::pair<const char*, Show> shows_[] = {
      {"Ground truth only", Show::truth},        {"Wipe between both", Show::wipe},
      {"Absolute difference", Show::absolute},   {"Signed difference", Show::signed_},
      {"Difference in blocks", Show::pixelated}, {"Real time only", Show::realtime}};
  for (const auto& [name, show] : shows_) {
    choose("View", name);
    EXPECT_EQ(app().settings.show, show) << name;
  }
  choose("View", "Probes as balls");
  EXPECT_TRUE(app().settings.balls);
  choose("View", "Lobes");
  EXPECT_TRUE(app().settings.lobes);
  choose("View", "Graph of the hierarchy");
  EXPECT_TRUE(app().settings.graph);
  choose("Help", "Mouse and keys");
  EXPECT_TRUE(app().help);
  app().help = false;
  choose("Edit", "Place an SPHL");
  EXPECT_TRUE(app().place_mode);
  app().selection = {Kind::sphl, 0};
  choose("Edit", "Delete");
  EXPECT_EQ(app().document.edits().sphls.size(), 5u);
  choose("Edit", "Undo delete SPHL");
  EXPECT_EQ(app().document.edits().sphls.size(), 6u);
  choose("Edit", "Redo delete SPHL");
  EXPECT_EQ(app().document.edits().sphls.size(), 5u);
  choose("File", "Save scene");
  choose("File", "Save times of frames");
  choose("File", "Save times of frames");
  EXPECT_FALSE(shows("Save probes as"));
  take_probes();
  choose("File", "Save probes as?");
  press({GLFW_KEY_ENTER});
  const std::string probe_file = (std::filesystem::current_path() / "stage-01.sphl").string();
  EXPECT_THAT(app().report.written, ElementsAre("stage-01.glb", "stage-01.csv", "stage-02.csv", probe_file));
  choose("View", "Panels");
  EXPECT_FALSE(app().panels);
  app().panels = true;
  app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.5f; });
  choose("File", "Open a built-in scene");
  click_text("cornell");
  EXPECT_EQ(app().question.source, "builtin:cornell") << "asked first";
  app().answer(Answer::stay);
  rest();
  choose("File", "Quit");
  EXPECT_TRUE(window_->closed);
}

}  // namespace
}  // namespace ssphh::viewer

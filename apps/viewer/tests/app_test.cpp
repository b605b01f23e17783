// The turns of the App, its time, and what can be done with a document, without a picture.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "app_stage.h"
#include "json_text.h"

namespace ssphh::viewer {
namespace {

class AppTest : public AppStage {
 protected:
  AppTest() { start(400, 300); }
};

TEST_F(AppTest, DrawsWhereSomethingMayHaveChangedAndRestsOtherwise) {
  EXPECT_EQ(app().turn({}), 0);
  EXPECT_EQ(app().turn({}), 0);
  EXPECT_EQ(app().turn({}), 0.5);
  EXPECT_EQ(window_->frames, 3);
  EXPECT_EQ(app().turn({}), 0.5);
  EXPECT_EQ(window_->frames, 3) << "nothing happened";
  window_->touched = true;
  for (int i = 0; i < 5; ++i) app().turn({});
  EXPECT_EQ(window_->frames, 6);
  EXPECT_EQ(app().report.frames, 6);
  app().settings.play = true;
  EXPECT_EQ(app().turn({}), 0);
  app().settings.play = false;
  app().path_plays = true;
  EXPECT_EQ(app().turn({}), 0);
  EXPECT_EQ(window_->frames, 8);
  app().path_plays = false;
  std::atomic<bool> end = false, wrong = false;
  const auto work = [&](const Control&) -> BackgroundJob::Finish {
    while (!end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (wrong) throw Error("work", "is wrong");
    return {};
  };
  app().job.start("work", work);
  EXPECT_EQ(app().turn({}), 0.1);
  window_->touched = true;
  EXPECT_EQ(app().turn({}), 0);
  EXPECT_EQ(app().turn({}), 0);
  EXPECT_EQ(app().turn({}), 0.05);
  EXPECT_FALSE(app().settled());
  end = wrong = true;
  while (app().job.running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  app().turn({});
  EXPECT_TRUE(app().settled());
  EXPECT_EQ(app().message, "work: is wrong");
  EXPECT_TRUE(app().message_is_error);
  EXPECT_EQ(window_->frames, 12);
}

TEST_F(AppTest, FilesThatAreDroppedAreOpened) {
  append(app().bookmarks, {"a", 0, {}, app().view}), append(app().bookmarks, {"b", 0, {}, app().view});
  app().save_path("path.json");
  app().bookmarks = {};
  window_->dropped = {"nothing.sphl", "path.json"};
  app().path_time = 9;
  turn();
  EXPECT_EQ(app().bookmarks.keys.size(), 2u);
  EXPECT_EQ(app().path_time, 0);
  EXPECT_EQ(app().message, "path.json: 2 views");
  EXPECT_FALSE(app().message_is_error);
  window_->dropped = {"nothing.sphl"};
  turn();
  EXPECT_THAT(app().message, testing::HasSubstr("there is no scene for these probes"));
  window_->dropped = {"nothing.sphl.json"};
  turn();
  EXPECT_THAT(app().message, testing::HasSubstr("there is no scene for these probes"));
  load_ = [](const std::string& source) -> scene::Scene { throw Error(source, "asked for"); };
  for (const char* scene : {"a.ssphh.json", "a.glb"}) {
    window_->dropped = {scene};
    turn(), finish_work();
    EXPECT_EQ(app().message, std::string(scene) + ": asked for");
  }
  EXPECT_TRUE(is_probe_file("a.sphl") && is_probe_file("a.sphl.json"));
  EXPECT_FALSE(is_probe_file("a.json") || is_probe_file("sphl.glb"));
}

TEST_F(AppTest, TheSceneIsPlayedThereAndBack) {
  app().document.duration = 1;
  app().settings.play = true;
  app().settings.speed = 0.5f;
  const auto after = [&](double seconds) {
    window_->clock += seconds;
    turn();
    return app().document.time;
  };
  EXPECT_NEAR(after(0.125), 0.0625f, 1e-6f);
  EXPECT_NEAR(after(10), 0.0625f + 0.125f, 1e-6f) << "after a pause no more than a quarter of a second";
  app().document.time = 0.9375f;
  EXPECT_NEAR(after(0.25), 0.9375f, 1e-6f) << "at the end it turns";
  EXPECT_EQ(app().settings.speed, -0.5f);
  EXPECT_NEAR(after(0.25), 0.8125f, 1e-6f);
  app().document.time = 0.0625f;
  EXPECT_NEAR(after(0.25), 0.0625f, 1e-6f) << "and at the beginning";
  EXPECT_EQ(app().settings.speed, 0.5f);
  app().settings.play = false;
  EXPECT_NEAR(after(0.25), 0.0625f, 1e-6f);
  app().settings.play = true;
  app().document.duration = 0;
  EXPECT_NEAR(after(0.25), 0.0625f, 1e-6f);
}

TEST_F(AppTest, ThePathIsPlayedToItsEnd) {
  append(app().bookmarks, {"a", 0, 0.25f, look_at({0, 0, 0}, {0, 0, -1}, 1)});
  append(app().bookmarks, {"b", 0, {}, look_at({1, 0, 0}, {1, 0, -1}, 1)}, 0.5f);
  app().path_plays = true;
  window_->clock += 0.25;
  turn();
  EXPECT_EQ(app().path_time, 0.25f);
  EXPECT_EQ(app().view, at(app().bookmarks, 0.25f).view);
  EXPECT_TRUE(app().path_plays);
  window_->clock += 0.25;
  turn();
  EXPECT_TRUE(app().path_plays);
  EXPECT_EQ(app().view, app().bookmarks.keys[1].view);
  window_->clock += 0.125;
  turn();
  EXPECT_FALSE(app().path_plays);
  app().bookmarks.keys[1].scene_time = 0.25f;
  app().path_time = 0.25f;
  app().path_plays = true;
  turn();
  EXPECT_EQ(app().document.time, 0.25f);
  // An empty path plays nothing, and does not end.
  app().bookmarks = {};
  app().path_plays = true;
  turn();
  EXPECT_EQ(app().path_time, 0.25f);
}

TEST_F(AppTest, BeginsAsItsOptionsSay) {
  EXPECT_EQ(app().view, look_at({4, 3, 6}, {0, 1, 0}, 0.9f));
  EXPECT_TRUE(app().panels);
  EXPECT_EQ(app().report.renderer, "nothing");
  EXPECT_EQ(app().bake_params.path.spp, 8);
  EXPECT_EQ(app().bake_params.face_size, 20);
  EXPECT_EQ(app().fly_speed, 2);
  EXPECT_EQ(app().viewport.width, 1);
  EXPECT_FALSE(app().help || app().place_mode || app().path_plays || app().message_is_error);
  options_.panels = false;
  options_.settings = {{"exposure", "2"}, {"balls", "on"}};
  start(40, 30);
  EXPECT_FALSE(app().panels);
  EXPECT_EQ(app().settings.exposure, 2);
  EXPECT_FALSE(app().settings.auto_exposure);
  EXPECT_TRUE(app().settings.balls);
}

TEST_F(AppTest, WithoutCamerasTheViewIsFound) {
  start(40, 30);
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene.cameras.clear();
  app().take_document(make_document("rooms", std::move(scene), 0));
  const View view = app().view;
  const scene::Bounds& box = app().document.bounds;
  EXPECT_TRUE(glm::all(glm::lessThan(box.min, view.eye)) && glm::all(glm::lessThan(view.eye, box.max)));
  EXPECT_NEAR(view.focus, glm::distance(view.eye, box.center()), 1e-4f);
  app().view.eye = vec3(9);
  app().go_to_camera("");
  EXPECT_EQ(app().view, view);
}

TEST_F(AppTest, ADocumentIsTakenInPlaceOfTheOneBefore) {
  app().selection = {Kind::light, 0};
  probes::ProbeSet set;
  set.probes.resize(2);
  app().light.take(std::move(set), "x");
  app().take_document(document("two-rooms"));
  EXPECT_TRUE(app().light.empty());
  EXPECT_EQ(app().selection, Selection{});
  EXPECT_EQ(app().view, start_view(app().document, ""));
  EXPECT_EQ(window_->title, "builtin:two-rooms – ssphh");
  EXPECT_FLOAT_EQ(app().fly_speed, 0.25f * app().document.bounds.radius());
  EXPECT_THAT(app().camera_names(), testing::ElementsAre("room-a", "room-b"));
  EXPECT_NE(app().picking(), nullptr);
  EXPECT_FALSE(app().settled()) << "nothing is drawn yet";
  scene::Scene tiny;
  app().take_document(make_document("tiny", tiny, 0));
  EXPECT_EQ(app().fly_speed, 2);
  tiny = scene::make_builtin("two-rooms");
  for (scene::Mesh& mesh : tiny.meshes)
    for (vec3& p : mesh.positions) p *= 1e-3f;
  for (scene::Node& node : tiny.nodes) node.local.translation *= 1e-3f;
  app().take_document(make_document("tiny", tiny, 0));
  EXPECT_FLOAT_EQ(app().fly_speed, 0.25f * app().document.bounds.radius()) << "as in a room";
}

TEST_F(AppTest, TimesAreSavedWithWhatTheyAreOf) {
  app().take_document(document("two-rooms"));
  probes::ProbeSet set;
  set.probes.resize(3);
  app().times.add("frame", 2);
  const auto saved = [&] {
    app().save_stats("times.json");
    return test::parse_json(read_text_file("times.json"));
  };
  EXPECT_EQ(saved()["probes"], "0");
  app().light.take(std::move(set), "x");
  const auto json = saved();
  EXPECT_EQ(json["scene"], "builtin:two-rooms");
  EXPECT_EQ(json["renderer"], "nothing");
  EXPECT_EQ(json["picture"], "0x0");
  EXPECT_EQ(json["probes"], "3");
  EXPECT_EQ(json["stages"].size(), 1u);
  app().save_stats("times.csv");
  EXPECT_EQ(read_text_file("times.csv"), app().times.to_csv());
  EXPECT_EQ(app().message, "saved times.csv");
}

TEST_F(AppTest, APointIsWithinARectangleUpToItsFarEdges) {
  const Rect2 r{10, 20, 30, 60};
  EXPECT_TRUE(r.contains(10, 20) && r.contains(39, 79));
  EXPECT_FALSE(r.contains(9, 20) || r.contains(10, 19) || r.contains(40, 20) || r.contains(10, 80));
  EXPECT_EQ(r.aspect(), 0.5f);
  EXPECT_FALSE((Selection{Kind::light, -1}.is(Kind::light)) || (Selection{Kind::light, 0}.is(Kind::sphl)));
  EXPECT_TRUE((Selection{Kind::light, 0}.is(Kind::light)));
}

TEST_F(AppTest, OnlyWhatHasAPlaceMovesAndOnlySphlsAreDeleted) {
  app().take_document(document("two-rooms"));
  EXPECT_EQ(app().selected_position(), std::nullopt);
  app().selection = {Kind::material, 1};
  EXPECT_EQ(app().selected_position(), std::nullopt);
  app().delete_selection();
  app().move_selected({1, 2, 3});
  EXPECT_EQ(app().document.history.undo_name(), "");
  app().selection = {Kind::sphl, 2};
  app().move_selected({1, 2, 3});
  EXPECT_EQ(app().selected_position(), vec3(1, 2, 3));
  EXPECT_EQ(app().document.history.undo_name(), "move doorway");
  app().delete_selection();
  app().add_sphl({4, 5, 6}), app().add_sphl({5, 5, 6});
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 6}));
  app().undo();
  EXPECT_EQ(app().document.edits().sphls.size(), 6u) << "each is a step";
  EXPECT_EQ(app().selection, Selection{});
  app().undo(), app().undo();
  EXPECT_EQ(app().document.edits().sphls.size(), 6u);
  app().undo();
  EXPECT_EQ(app().message, "undone: move doorway");
  app().say("x");
  app().undo();
  EXPECT_EQ(app().message, "x") << "there is nothing to undo";
  app().selection = {Kind::light, 0};
  app().redo();
  EXPECT_EQ(app().selection, (Selection{Kind::light, 0}));
  EXPECT_EQ(app().message, "done again: move doorway");
}

TEST_F(AppTest, FilesOfABuiltinSceneWithParametersHaveNamesThatEverySystemTakes) {
  app().take_document(make_document("builtin:random?seed=7&kind=hall", scene::make_builtin("cornell"), 0));
  EXPECT_EQ(app().free_file(".png"), "random-seed-7-kind-hall-01.png");
}

TEST_F(AppTest, ASceneIsSavedOverItsOwnFileAndNeverOverTheOneThatWasOpened) {
  const std::string input = "rooms-01.glb";
  save_document(document("two-rooms"), input);
  const auto before = read_file(input);
  app().take_document(make_document(input, scene::make_builtin("two-rooms"), 0));
  const auto dim = [&](float value) {
    app().document.edit_at_once("dim", [&](Edits& e) { e.lights[0].intensity = value; });
  };
  dim(1);
  EXPECT_TRUE(app().document.dirty());
  app().save();
  EXPECT_FALSE(app().document.dirty());
  const std::string own = "rooms-01-01.glb";
  EXPECT_EQ(app().document.file, own);
  EXPECT_EQ(app().message, "saved " + own + " in " + std::filesystem::current_path().string());
  const auto first = read_file(own);
  dim(2);
  app().save();
  EXPECT_NE(read_file(own), first);
  EXPECT_FALSE(std::filesystem::exists("rooms-01-02.glb"));
  for (const std::string& name : {input, "./" + input, std::filesystem::absolute(input).string()})
    EXPECT_THROW(app().save_as(name), Error) << name;
  EXPECT_EQ(read_file(input), before);
  app().save_as("other.glb");
  dim(3);
  app().save();
  EXPECT_THAT(app().report.written, testing::ElementsAre(own, own, "other.glb", "other.glb"));
  // Who names it in a script, or has saved there before, means it.
  app().save_scene(input);
  app().save_as(input);
  EXPECT_NE(read_file(input), before);
  app().take_document(document("two-rooms"));
  app().save();
  EXPECT_EQ(app().document.file, "two-rooms-01.glb") << "another document has a file of its own";
}

TEST_F(AppTest, UndoAndRedoKeepWhatIsSelected) {
  app().take_document(document("two-rooms"));
  app().document.edit_at_once("delete SPHL", [](Edits& e) { e.sphls.erase(e.sphls.begin()); });
  app().document.edit_at_once("rename", [](Edits& e) { e.sphls[4].name = "other"; });
  app().selection = {Kind::sphl, 4};
  app().undo();
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 4}));
  app().undo();
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 5})) << "the same one, now behind the restored first";
  app().redo();
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 4}));
  app().undo();
  app().selection = {Kind::sphl, 0};
  app().redo();
  EXPECT_EQ(app().selection, Selection{}) << "it is not there";
  for (const Kind kind : {Kind::light, Kind::material}) {
    app().selection = {kind, 0};
    app().undo();
    EXPECT_EQ(app().selection, (Selection{kind, 0}));
    app().redo();
    EXPECT_EQ(app().selection, (Selection{kind, 0}));
  }
}

}  // namespace
}  // namespace ssphh::viewer

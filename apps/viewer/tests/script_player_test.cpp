// What a script's commands do, one a turn, and the input that they stand for.

#include "script_player.h"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "app_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

class Script_ : public AppStage {
 protected:
  Script_() {
    start(400, 300);
    app().take_document(document("two-rooms"));
  }
  /// Runs one command; the input of the turns after it.
  std::vector<InjectedInput> run(const std::string& line) {
    ScriptPlayer player(parse_script(line, "script"));
    std::vector<InjectedInput> inputs;
    player.next(app());
    while (!player.done() && inputs.size() < 100) inputs.push_back(player.next(app()));
    return inputs;
  }
  std::string error(const std::string& line) {
    try {
      run(line);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  }
  const Edits& edits() { return app().document.edits(); }
};

TEST_F(Script_, CommandsChangeTheState) {
  run("set exposure 1.5");
  EXPECT_EQ(app().settings.exposure, 1.5f);
  run("time 0.5");
  EXPECT_EQ(app().document.time, 0.5f);
  run("time 9");
  EXPECT_EQ(app().document.time, 1);
  run("time -1");
  EXPECT_EQ(app().document.time, 0);
  run("camera room-b");
  EXPECT_EQ(app().view, start_view(app().document, "room-b"));
  const float yfov = app().view.yfov;
  run("view 1 2 3 4 5 7");
  EXPECT_EQ(app().view, look_at({1, 2, 3}, {4, 5, 7}, yfov));
  run("tab Camera");
  EXPECT_EQ(app().open_tab, "Camera");
  run("light lamp intensity 7"), run("light lamp color 0.5 -1 2"), run("light lamp position 1 2 3");
  EXPECT_EQ(edits().lights[0].intensity, 7);
  EXPECT_EQ(edits().lights[0].color, vec3(0.5f, 0, 2));
  EXPECT_EQ(light_position(*edits().lights[0].world), vec3(1, 2, 3));
  EXPECT_EQ(app().document.history.undo_name(), "position of lamp");
  EXPECT_THAT(error("light lamp intensity -7"), HasSubstr("intensity -7 W/sr is not within 0 to 1e+06 W/sr"));
  EXPECT_EQ(edits().lights[0].intensity, 7);
  run("light lamp off");
  EXPECT_FALSE(edits().lights[0].on);
  run("light lamp off"), run("light lamp on");
  EXPECT_TRUE(edits().lights[0].on);
  run("undo");
  EXPECT_FALSE(edits().lights[0].on);
  run("redo");
  EXPECT_TRUE(edits().lights[0].on);
  run("light lamp intensity 1"), run("light lamp intensity 2"), run("undo");
  EXPECT_EQ(edits().lights[0].intensity, 1) << "each command is a step";
  run("add-light spot desk 1 2 1"), run("light desk aim 1 0 1"), run("light desk outer-cone 20");
  EXPECT_EQ(light_position(*edits().lights[1].world), vec3(1, 2, 1));
  EXPECT_EQ(light_direction(*edits().lights[1].world), vec3(0, -1, 0));
  EXPECT_FLOAT_EQ(edits().lights[1].lamp.outer_cone, glm::radians(20.0f));
  EXPECT_THAT(error("add-light spot desk 0 0 0"), HasSubstr("there is a lamp \"desk\" already"));
  run("light desk duplicate"), run("light desk delete");
  ASSERT_EQ(edits().lights.size(), 2u);
  EXPECT_EQ(edits().lights[1].lamp.name, "desk 1");
  run("add-camera corner"), run("view 0 1 0 1 1 1"), run("camera corner");
  EXPECT_EQ(app().view, *edits().cameras.back().view);
  run("group lamp 3");
  EXPECT_EQ(edits().groups.at("lamp"), vec3(3));
  run("group lamp -3");
  EXPECT_EQ(edits().groups.at("lamp"), vec3(0));
  run("material \"" + edits().materials[2].name + "\" 0.25 2 -1");
  EXPECT_EQ(edits().materials[2].base_color, vec3(0.25f, 1, 0));
  run("select light lamp");
  EXPECT_EQ(app().selection, (Selection{Kind::light, 0}));
  run("select sphl doorway");
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 2}));
  run("select material \"" + edits().materials[3].name + "\"");
  EXPECT_EQ(app().selection, (Selection{Kind::material, 3}));
  run("sphl 1 2 3");
  EXPECT_EQ(*edits().sphls[6].position, vec3(1, 2, 3));
  run("time 0.25"), run("bookmark"), run("bookmark");
  EXPECT_EQ(app().bookmarks.keys[1], (CameraKey{"view 2", 2, 0.25f, app().view}));
  run("probes off");
  EXPECT_TRUE(app().light.empty());
  run("quit");
  EXPECT_TRUE(window_->closed);
}

TEST_F(Script_, FilesAreKnownByTheirEndings) {
  run("bookmark"), run("save path.json"), run("save times.csv"), run("save a.stats.json"),
      run("save scene.glb");
  EXPECT_EQ(read_camera_path("path.json"), app().bookmarks);
  EXPECT_THAT(app().report.written,
              testing::ElementsAre("path.json", "times.csv", "a.stats.json", "scene.glb"));
  for (const char* file : {"save a.sphl", "save a.sphl.json"})
    EXPECT_THAT(error(file), HasSubstr("no probes to save"));
  run("screenshot window.png panels");
  EXPECT_FALSE(std::filesystem::exists("window.png")) << "at the end of the next turn";
  app().document.scene = nullptr;
  turn();
  EXPECT_EQ(image::decode_rgba8(read_file("window.png"), "x").rgba, window_->read_frame().rgba);
  EXPECT_EQ(app().message, "wrote window.png");
}

TEST_F(Script_, KeysAreHeldForATurn) {
  const auto inputs = run("key Ctrl+Shift+z");
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_THAT(inputs[0].keys, testing::ElementsAre(GLFW_KEY_Z));
  EXPECT_TRUE(inputs[0].ctrl && inputs[0].shift);
  EXPECT_TRUE(inputs[1].keys.empty() && !inputs[1].mouse);
  const auto plain = run("key F12");
  EXPECT_THAT(plain[0].keys, testing::ElementsAre(GLFW_KEY_F12));
  EXPECT_FALSE(plain[0].ctrl || plain[0].shift);
  EXPECT_TRUE(run("key shift+tab")[0].shift);
}

TEST_F(Script_, TheMouseComesPressesGoesAndLetsGo) {
  using Point = std::array<float, 2>;
  const std::array<bool, 3> none{}, left{true, false, false}, right{false, true, false};
  const auto click = run("click 10 20");
  ASSERT_EQ(click.size(), 4u);
  for (const InjectedInput& input : click) EXPECT_EQ(input.mouse, (Point{10, 20}));
  EXPECT_EQ(click[0].buttons, none);
  EXPECT_EQ(click[1].buttons, left);
  EXPECT_EQ(click[2].buttons, none);
  for (const bool by_right : {false, true}) {
    const auto drag = run(by_right ? "drag 10 20 70 50 right" : "drag 10 20 70 50");
    ASSERT_EQ(drag.size(), 10u);
    EXPECT_EQ(drag[0].mouse, (Point{10, 20}));
    EXPECT_EQ(drag[0].buttons, none);
    for (int i = 0; i <= 6; ++i) {
      EXPECT_EQ(drag[static_cast<std::size_t>(i) + 1].buttons, by_right ? right : left);
      EXPECT_FLOAT_EQ((*drag[static_cast<std::size_t>(i) + 1].mouse)[0], 10 + 10 * static_cast<float>(i));
      EXPECT_FLOAT_EQ((*drag[static_cast<std::size_t>(i) + 1].mouse)[1], 20 + 5 * static_cast<float>(i));
    }
    for (const std::size_t last : {8u, 9u}) {
      EXPECT_EQ(drag[last].mouse, (Point{70, 50}));
      EXPECT_EQ(drag[last].buttons, none);
    }
  }
}

TEST_F(Script_, WaitsForFramesAndForWork) {
  EXPECT_EQ(run("wait 3").size(), 3u);
  EXPECT_EQ(run("screenshot w.png panels").size(), 1u) << "the picture is taken at the end of that turn";
  ScriptPlayer player(parse_script("settle\ntime 1", "script"));
  std::atomic<bool> end = false;
  app().document.scene = nullptr;  // Settled is what has no work, where no scene is shown
  app().job.start("work", [&](const Control&) -> BackgroundJob::Finish {
    while (!end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  });
  app().document.duration = 5;
  for (int i = 0; i < 5; ++i) player.next(app());
  EXPECT_FALSE(player.done());
  EXPECT_EQ(app().document.time, 0);
  end = true;
  while (app().job.running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  app().job.poll();
  for (int i = 0; i < 2; ++i) player.next(app());
  EXPECT_EQ(app().document.time, 1);
  EXPECT_TRUE(player.done());
  EXPECT_TRUE(ScriptPlayer({}).done());
}

TEST_F(Script_, SaysWhatItDoesNotUnderstand) {
  for (const char* form : {"set exposure",
                           "time",
                           "time 1 2",
                           "camera",
                           "view 1 2 3",
                           "tab",
                           "light lamp",
                           "light",
                           "light lamp on off",
                           "light lamp intensity",
                           "light lamp color 1 2",
                           "light lamp position 1 2 3 4",
                           "group lamp",
                           "material a 1 2",
                           "select light",
                           "sphl 1 2",
                           "probes",
                           "gen 1",
                           "viz 1",
                           "key",
                           "key a b",
                           "click 1",
                           "drag 1 2 3",
                           "drag 1 2 3 right",
                           "wait",
                           "screenshot",
                           "save",
                           "screenshot a b",
                           "screenshot a panels c"})
    EXPECT_THAT(error(form), HasSubstr("script: line 1: is not of the form: ")) << form;
  EXPECT_THAT(error("time soon"), HasSubstr("\"soon\" is not a number"));
  EXPECT_THAT(error("light lamb on"), HasSubstr("there is no \"lamb\" (there are: lamp)"));
  EXPECT_THAT(error("select sphl x"), HasSubstr("there are: A west, A east, doorway"));
  EXPECT_THAT(error("select door x"), HasSubstr("\"door\" is none of: light, sphl, material"));
  EXPECT_THAT(error("light lamp dim"),
              HasSubstr("\"dim\" is none of: on, off, delete, duplicate, aim, "
                        "color, profile, turn, pan-tilt, position, intensity, range"));
  EXPECT_THAT(error("group x 1"), HasSubstr("there is no \"x\""));
  EXPECT_THAT(error("material x 1 1 1"), HasSubstr("there is no \"x\""));
  EXPECT_THAT(error("key ctrl+what"), HasSubstr("there is no key \"ctrl+what\""));
  EXPECT_THAT(error("fly"), HasSubstr("there is no command \"fly\""));
  EXPECT_THAT(error("camera nowhere"), HasSubstr("script: line 1: "));
  EXPECT_THAT(error("probes some"), HasSubstr("\"some\" is none of: off, scene, auto"));
  EXPECT_THAT(error("probes auto:0"), HasSubstr("a spacing must be over 0"));
  EXPECT_THAT(error("save path.json"), HasSubstr("no bookmarks to save"));
}

}  // namespace
}  // namespace ssphh::viewer

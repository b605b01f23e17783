// What a click in the picture and a line of the list select, and what stands around it.

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include "gl_stage.h"
#include "model/objects.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

class Click : public AppStage {
 protected:
  Click() {
    options_.panels = false;
    start(400, 300);
    app().take_document(document("two-rooms"));
    app().view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
    frames(2);
  }
  std::string name() {
    return app().selection.is(Kind::object) ? node_name(*app().document.scene, app().selection.index) : "";
  }
};

TEST_F(Click, SelectsWhatIsUnderTheMouse) {
  const View before = app().view;
  click(200, 150);
  ASSERT_TRUE(app().selection.is(Kind::object));
  const rays::RayQuery ray = pixel_ray(before, {0.5f, 0.5f}, 400 / 300.0f);
  const scene::Scene& scene = *app().document.scene;
  const auto body = pick_body(scene, scene::world_matrices(scene, 0), ray);
  const scene::Instance& instance = scene.instances[body->instance];
  EXPECT_EQ(app().selection.index, instance.node);
  EXPECT_EQ(app().selection.material(), scene::instance_material(scene, instance));
  EXPECT_THAT(app().message, testing::StartsWith(name() + ", of "));
  EXPECT_EQ(app().view, before) << "a click moves nothing";
  press({GLFW_KEY_ESCAPE});
  EXPECT_EQ(app().selection, Selection{});
}

TEST_F(Click, ADragTurnsAndSelectsNothing) {
  drag(200, 150, 230, 150);
  EXPECT_EQ(app().selection, Selection{});
  // A hand that is not quite still
  drag(200, 150, 202, 151);
  EXPECT_TRUE(app().selection.is(Kind::object));
  // Out of the house, into the sky
  app().view = look_at({0, 50, 0}, {0, 100, 1}, 1);
  click(200, 150);
  EXPECT_EQ(app().selection, Selection{});
  const View sky = app().view;
  drag(200, 150, 230, 140);
  EXPECT_EQ(app().view, dragged(sky, ViewDrag::orbit, {30, -10}, 300)) << "about the focus as ever";
}

TEST_F(Click, FramesItFromWithinTheRoom) {
  click(200, 150);
  const View before = app().view;
  press({'F'});
  EXPECT_NE(app().view, before);
  EXPECT_TRUE(posed().visible(before.eye, app().view.eye));
  app().selection = {};
  app().view = before;
  press({'F'});
  EXPECT_TRUE(posed().visible(before.eye, app().view.eye)) << "everything, from here";
}

TEST_F(Click, OfThingsInOneMeshTheClickedOneIsFramed) {
  scene::Scene scene;
  scene.nodes.resize(1);
  scene::Mesh mesh;
  for (const float x : {-20.0f, 20.0f}) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (const vec3& p : {vec3(-1, -1, 0), vec3(1, -1, 0), vec3(0, 1, 0)})
      mesh.positions.push_back(p + vec3(x, 0, 0));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.material = 0;
  scene.materials.emplace_back();
  scene.meshes = {mesh};
  scene.instances = {{0, 0, -1, ""}};
  app().take_document(make_document("two.glb", std::move(scene), 0));
  app().view = look_at({20, 0, 8}, {20, 0, 0}, 1);
  frames(2);
  click(200, 150);
  press({'F'});
  EXPECT_NEAR(app().view.eye.x, 20, 1e-3f);
  app().select({Kind::object, 0});
  press({'F'});
  EXPECT_NEAR(app().view.eye.x, 0, 1e-3f) << "all, where it was chosen in the list";
}

class List : public PanelStage {
 protected:
  List() { open("Scene"); }
};

TEST_F(List, SelectsAndShowsWhatIsSelected) {
  const scene::Scene& scene = *app().document.scene;
  const int door = scene.instances[2].node;
  const std::string name = node_name(scene, door);
  click_text(name);
  EXPECT_EQ(app().selection, (Selection{Kind::object, door}));
  EXPECT_EQ(app().message, name);
  // The other way round: what is selected elsewhere is unfolded.
  EXPECT_FALSE(shows("directional"));
  app().selection = {Kind::light, 3};
  rest();
  EXPECT_TRUE(shows(scene.lights[3].name));
  EXPECT_FALSE(shows("A east"));
  app().selection = {Kind::sphl, 1};
  rest();
  EXPECT_TRUE(shows("A east"));
  click_text("A west");
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 0}));
  click_text("Materials (6)");
  EXPECT_TRUE(shows("material 1"));
  click_text("material 1");
  EXPECT_EQ(app().selection, (Selection{Kind::material, 1}));
  expect_drawn("outliner", drawn_listing());
}

TEST_F(List, EveryEntrySelectsWhatItNames) {
  const Edits& edits = app().document.edits();
  const auto click_all = [&](Kind kind, std::size_t count, const auto& name_of_entry) {
    ASSERT_GT(count, 1u);
    app().selection = {kind, static_cast<int>(count) - 1};  // unfolds its part
    for (std::size_t i = 0; i < count; ++i) {
      app().message.clear();
      rest();
      const std::vector<DrawnThing> all = all_things();
      // Below an object of that name
      click_text(name_of_entry(i),
                 static_cast<int>(std::ranges::count(all, name_of_entry(i), &DrawnThing::text)) - 1);
      EXPECT_EQ(app().selection, (Selection{kind, static_cast<int>(i)})) << name_of_entry(i);
    }
  };
  click_all(Kind::light, app().document.scene->lights.size(),
            [&](std::size_t i) { return app().document.scene->lights[i].name; });
  click_all(Kind::sphl, edits.sphls.size(), [&](std::size_t i) { return edits.sphls[i].name; });
  click_all(Kind::material, edits.materials.size(), [&](std::size_t i) {
    const std::string& name = edits.materials[i].name;
    return name.empty() ? fmt::format("material {}", i) : name;
  });
}

TEST_F(List, FindsNames) {
  click_widget("find");
  window_->typed = "WEST";
  rest();
  EXPECT_TRUE(shows("A west"));
  EXPECT_TRUE(shows("B west"));
  EXPECT_FALSE(shows("A east"));
  click_text("B west");
  EXPECT_TRUE(app().selection.is(Kind::sphl));
  click_widget("find");
  for (int i = 0; i < 4; ++i) press({GLFW_KEY_END}), press({GLFW_KEY_BACKSPACE});
}

class Outline : public GlStage {
 protected:
  void prepare() override { options_.settings = {{"exposure", "0"}, {"antialias", "off"}}; }
  void ready() override {
    app().open("builtin:cornell");
    turn(), turn();
  }
  std::vector<float> line() {
    std::vector<float> texels(4 * 64 * 48, -1);
    app().outline()->read(texels, 4);
    return texels;
  }
  void settle() {
    for (int i = 0; i < 5; ++i) app().redraw(), app().turn({});
  }
};

TEST_F(Outline, StandsAroundWhatIsSelected) {
  settle();
  EXPECT_EQ(app().outline(), nullptr);
  const auto picture = app().picture.pixels().rgba;
  const scene::Scene& scene = *app().document.scene;
  const std::vector<mat4> world = scene::world_matrices(scene, 0);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const int node = scene.instances[i].node;
    app().select({Kind::object, node});
    settle();
    ASSERT_NE(app().outline(), nullptr);
    const std::vector<float> texels = line();
    int lines = 0, wrong = 0;
    // By rays: which pixels the body covers, hidden or not
    const auto covers = [&](int x, int y) {
      scene::Scene alone = scene;
      std::erase_if(alone.instances, [&](const scene::Instance& other) { return other.node != node; });
      const vec2 point((static_cast<float>(x) + 0.5f) / 64, (static_cast<float>(y) + 0.5f) / 48);
      return pick_body(alone, world, pixel_ray(app().view, point, 64 / 48.0f)).has_value();
    };
    std::vector<bool> covered(64 * 48);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) covered[64 * y + x] = covers(x, y);
    }
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const auto at = static_cast<std::size_t>(64 * y + x);
        bool beside = false;
        for (int v = -2; v <= 2; ++v) {
          for (int u = -2; u <= 2; ++u) {
            if (u * u + v * v > 5) continue;
            const int nx = std::clamp(x + u, 0, 63), ny = std::clamp(y + v, 0, 47);
            beside = beside || covered[64 * ny + nx];
          }
        }
        const bool drawn = texels[4 * at + 3] > 0.1f;
        lines += drawn;
        wrong += drawn != (beside && !covered[at]);
      }
    }
    EXPECT_GT(lines, 0) << "body " << i;
    EXPECT_LE(wrong, 8 + lines / 5) << "body " << i << ": a pixel's edge may fall on either side";
  }
  EXPECT_EQ(app().picture.pixels().rgba, picture) << "pictures that are written have no line";
  app().select({});
  settle();
  EXPECT_EQ(app().outline(), nullptr);
}

}  // namespace
}  // namespace ssphh::viewer

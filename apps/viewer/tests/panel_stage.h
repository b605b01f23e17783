#pragma once
/// Panels over a scene with a lamp of each kind, an emitter and probes, and a mouse that finds widgets by
/// what stands beside them.

#include "app_stage.h"
#include "drawn.h"

namespace ssphh::viewer {

class PanelStage : public AppStage {
 protected:
  PanelStage() {
    start(1000, 1500);
    scene::Scene scene = scene::make_builtin("two-rooms");
    for (const scene::LightType type :
         {scene::LightType::spot, scene::LightType::directional, scene::LightType::sphere}) {
      const auto node = static_cast<int>(scene.nodes.size());
      scene.nodes.emplace_back().name = "lamp node";
      scene.nodes.back().local.translation = {-1 + 0.5f * static_cast<float>(node % 3), 1, 0};
      scene.lights.emplace_back().name = name_of(type);
      scene.lights.back().node = node, scene.lights.back().type = type;
      scene.lights.back().radius = 0.1f;
      scene.lights.back().intensity = 50;
    }
    scene.materials[1].name = "";
    scene.materials[2].emission = vec3(3, 2, 1);
    app().take_document(make_document("builtin:stage", std::move(scene), 0));
    app().view = look_at({0.5f, 2, 17}, {0, 1, 0}, 1);
    frames(2);
  }

  /// Fixed probes at the scene's SPHLs, each with an edge to those before it.
  void take_probes() {
    probes::ProbeSet set;
    set.degree = 2;
    for (const SphlEdit& sphl : app().document.edits().sphls) {
      probes::Probe& probe = set.probes.emplace_back();
      const auto i = static_cast<float>(set.probes.size());
      probe.name = sphl.name;
      probe.position = app()
                           .document.scene->nodes[app().document.scene->sphls[set.probes.size() - 1].node]
                           .local.translation;
      sh::RadianceSh light(2);
      for (int k = 0; k < 9; ++k) light[k] = vec3(1, -0.5f, 0.25f * i) / static_cast<float>(k + 1);
      for (int from = 0; from + 1 < static_cast<int>(set.probes.size()); ++from)
        probe.edges.push_back({from, std::pow(0.2f, i) * static_cast<float>(from + 1), light, {}});
      probe.groups.push_back({{}, light});
    }
    set.light_groups.push_back({"all"});
    visible_.assign(set.probes.size(), 1);
    visible_[1] = visible_[4] = 0;
    app().light.take(std::move(set), "file.sphl");
  }

  void open(const char* tab) {
    app().open_tab = tab;
    rest();
  }
  /// Frames with the mouse far away from everything.
  void rest() {
    for (int i = 0; i < 3; ++i) mouse(-100, -100);
  }

  std::vector<DrawnThing> all_things() {
    std::vector<DrawnThing> all;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) {
      for (const DrawnThing& thing : drawn_things(*data.CmdLists[i])) all.push_back(thing);
    }
    return all;
  }
  /// The n-th text of this kind.
  DrawnThing text(const std::string& wanted, int n = 0) {
    for (const DrawnThing& thing : all_things()) {
      if (thing.text == wanted && n-- == 0) return thing;
    }
    ADD_FAILURE() << "there is no \"" << wanted << '"';
    return {};
  }
  bool shows(const std::string& wanted) {
    for (const DrawnThing& thing : all_things()) {
      if (thing.text.find(wanted) != std::string::npos) return true;
    }
    return false;
  }
  /// The n-th frame of a widget in the row that begins with a text, itself the m-th of its kind.
  DrawnThing widget(const std::string& label, int n = 0, int m = 0) {
    const DrawnThing at = text(label, m);
    for (const DrawnThing& thing : all_things()) {
      const bool frame = thing.text.empty() && thing.color == 0x303032ff && thing.from.x > at.from.x &&
                         thing.from.y < at.from.y + 6 && thing.to.y > at.from.y + 6;
      if (frame && n-- == 0) return thing;
    }
    ADD_FAILURE() << "there is no widget beside " << label;
    return {};
  }

  void click_text(const std::string& wanted, int n = 0) {
    const DrawnThing at = text(wanted, n);
    click(at.from.x + 3, at.from.y + 6);
    rest();
  }
  /// Left of a text, as a tick box stands.
  void click_left_of(const std::string& wanted) {
    const DrawnThing at = text(wanted);
    click(at.from.x - 15, at.from.y + 6);
    rest();
  }
  void click_widget(const std::string& label) {
    const DrawnThing at = widget(label);
    click(at.from.x + 8, 0.5f * (at.from.y + at.to.y));
    rest();
  }
  /// What a slider gives at both its ends.
  template <class Value>
  void expect_ends(const std::string& label, const Value& value, float low, float high, int m = 0) {
    rest();
    const DrawnThing at = widget(label, 0, m);
    const float y = 0.5f * (at.from.y + at.to.y), x = 0.5f * (at.from.x + at.to.x);
    drag(x, y, at.to.x + 50, y);
    EXPECT_FLOAT_EQ(static_cast<float>(value()), high) << label;
    drag(x, y, at.from.x - 50, y);
    EXPECT_FLOAT_EQ(static_cast<float>(value()), low) << label;
    rest();
  }
  /// Drags in a field of a number, by pixels to the right.
  void pull(const std::string& label, float pixels, int n = 0) {
    rest();
    const DrawnThing at = widget(label, n);
    const float y = 0.5f * (at.from.y + at.to.y), x = 0.5f * (at.from.x + at.to.x);
    drag(x, y, x + pixels, y);
    rest();
  }
};

}  // namespace ssphh::viewer

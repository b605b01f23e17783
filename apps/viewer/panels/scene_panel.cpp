#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "model/objects.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// What the panel remembers: which selection it has shown, and the tree of which scene.
struct Outliner {
  char filter[128] = "";
  Selection shown;
  const scene::Scene* scene = nullptr;
  BodyTree tree;
  bool scrolls = false;  ///< the selection came from elsewhere: bring it into sight
};

bool passes(const Outliner& o, const std::string& name) {
  const std::string_view wanted = o.filter;
  const auto same = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(name.begin(), name.end(), wanted.begin(), wanted.end(), same) != name.end();
}

void entry(App& app, const Outliner& o, const Selection& self, const std::string& name) {
  if (!passes(o, name)) return;
  ImGui::PushID(self.index);
  const bool selected = app.selection == self;
  if (ImGui::Selectable(name.c_str(), selected)) app.select(self);
  if (selected && o.scrolls) ImGui::SetScrollHereY();
  ImGui::PopID();
}

bool holds(const Outliner& o, int node, int wanted) {
  return std::ranges::any_of(o.tree.children[node],
                             [&](int child) { return child == wanted || holds(o, child, wanted); });
}

void draw_node(App& app, const Outliner& o, int node) {
  const auto i = static_cast<std::size_t>(node);
  const std::string name = node_name(*app.document.scene, node);
  const std::vector<int>& children = o.tree.children[i];
  const bool selected = app.selection.is(Kind::object) && app.selection.index == node;
  // Where names are looked for the list is flat.
  const bool flat = o.filter[0] != 0;
  if (flat && !(o.tree.body[i] && passes(o, name))) {
    for (const int child : children) draw_node(app, o, child);
    return;
  }
  if (o.scrolls && app.selection.is(Kind::object) && holds(o, node, app.selection.index))
    ImGui::SetNextItemOpen(true);
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth;
  if (children.empty() || flat) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (selected) flags |= ImGuiTreeNodeFlags_Selected;
  ImGui::PushID(node);
  const bool open = ImGui::TreeNodeEx(name.c_str(), flags);
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen() && o.tree.body[i])
    app.select({Kind::object, node});
  if (selected && o.scrolls) ImGui::SetScrollHereY();
  if (open || flat) {
    for (const int child : children) draw_node(app, o, child);
  }
  if (open && !(flags & ImGuiTreeNodeFlags_NoTreePushOnOpen)) ImGui::TreePop();
  ImGui::PopID();
}

/// A part of the list under its heading with a number.
template <class Draw>
void part(const Outliner& o, const char* name, Kind kind, const Selection& selected, std::size_t count,
          const Draw& draw) {
  if (o.scrolls && selected.kind == kind) ImGui::SetNextItemOpen(true);
  const std::string label = fmt::format("{} ({})###{}", name, count, name);
  if (!ImGui::CollapsingHeader(label.c_str(), kind == Kind::object || o.filter[0] != 0
                                                  ? ImGuiTreeNodeFlags_DefaultOpen
                                                  : ImGuiTreeNodeFlags_None))
    return;
  ImGui::PushID(name);
  draw();
  ImGui::PopID();
}

}  // namespace

void draw_scene_panel(App& app) {
  static Outliner o;
  const scene::Scene& scene = *app.document.scene;
  if (o.scene != &scene) o.scene = &scene, o.tree = body_tree(scene), o.shown = {};
  o.scrolls = !(app.selection == o.shown);
  o.shown = app.selection;

  row("find");
  ImGui::InputText("##find", o.filter, sizeof o.filter);
  ImGui::BeginChild("outline");
  const Edits& edits = app.document.edits();
  const auto bodies = static_cast<std::size_t>(std::ranges::count(o.tree.body, true));
  part(o, "Objects", Kind::object, app.selection, bodies, [&] {
    for (const int root : o.tree.roots) draw_node(app, o, root);
  });
  part(o, "Lamps", Kind::light, app.selection, scene.lights.size(), [&] {
    for (int i = 0; i < static_cast<int>(scene.lights.size()); ++i)
      entry(app, o, {Kind::light, i}, scene.lights[i].name);
  });
  part(o, "SPHLs", Kind::sphl, app.selection, edits.sphls.size(), [&] {
    for (int i = 0; i < static_cast<int>(edits.sphls.size()); ++i)
      entry(app, o, {Kind::sphl, i}, edits.sphls[i].name);
  });
  part(o, "Materials", Kind::material, app.selection, edits.materials.size(), [&] {
    for (int i = 0; i < static_cast<int>(edits.materials.size()); ++i) {
      const std::string& name = edits.materials[i].name;
      entry(app, o, {Kind::material, i}, name.empty() ? fmt::format("material {}", i) : name);
    }
  });
  ImGui::EndChild();
  o.shown = app.selection;
}

}  // namespace ssphh::viewer

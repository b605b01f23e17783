// What is selected: found in the picture, outlined, brought into sight.

#include <fmt/format.h>

#include <ssphh/rays/posed_world.h>

#include "app.h"
#include "model/framing.h"
#include "model/lengths.h"
#include "model/objects.h"

namespace ssphh::viewer {
namespace {

std::string material_name(const Edits& edits, int material) {
  const std::string& name = edits.materials[material].name;
  return name.empty() ? fmt::format("material {}", material) : name;
}

std::vector<int> instances_of(const scene::Scene& scene, const Selection& selection) {
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(scene.instances.size()); ++i) {
    const scene::Instance& instance = scene.instances[i];
    const bool chosen =
        selection.is(Kind::object)
            ? instance.node == selection.index
            : selection.is(Kind::material) && scene::instance_material(scene, instance) == selection.index;
    if (chosen) out.push_back(i);
  }
  return out;
}

}  // namespace

void App::select(const Selection& selected) {
  selection = selected;
  clicked_ = {};
  const auto i = static_cast<std::size_t>(selected.index);
  if (selected.is(Kind::light)) say(document.scene->lights[i].name);
  if (selected.is(Kind::sphl)) say(document.edits().sphls[i].name);
  if (selected.is(Kind::material)) say(material_name(document.edits(), selected.index));
  if (selected.is(Kind::object)) {
    const std::string name = node_name(*document.scene, selected.index);
    const int material = selected.of_material;
    say(material < 0 ? name : fmt::format("{}, of {}", name, material_name(document.edits(), material)));
  }
  redraw();
}

void App::select_on_ray(const rays::RayQuery& ray) {
  const scene::Scene& scene = *document.scene;
  const auto picked = pick_body(scene, scene::world_matrices(scene, document.time), ray);
  if (!picked) return select({});
  const scene::Instance& instance = scene.instances[picked->instance];
  select({Kind::object, instance.node, scene::instance_material(scene, instance)});
  clicked_ = part_bounds(scene, scene::world_matrices(scene, document.time), *picked);
}

void App::frame_selection() {
  const std::vector<mat4> world = scene::world_matrices(*document.scene, document.time);
  scene::Bounds bounds = document.bounds;
  if (const auto position = selected_position()) {
    bounds = {};
    const float around = 5 * lengths_of(document.bounds).least;
    bounds.add(*position - around), bounds.add(*position + around);
  } else if (selection.is(Kind::object)) {
    bounds = node_bounds(*document.scene, world, selection.index);
    // Of things far apart that are one mesh the one that was clicked.
    if (!clicked_.empty() && clicked_.radius() < 0.5f * bounds.radius()) bounds = clicked_;
  } else if (selection.is(Kind::material)) {
    bounds = material_bounds(*document.scene, world, selection.index);
  }
  view = framed_within(view, bounds, viewport.aspect(), rays::PosedWorld(*picking_, document.time));
  path_plays = false;
  redraw();
}

const gl::Texture* App::outline() const {
  return screen.outline && !outline_gl->empty() ? &outline_gl->picture() : nullptr;
}

void App::draw_outline() {
  if (!selection.is(Kind::object) && !selection.is(Kind::material)) return screen.outline.reset();
  if (!screen.drawn) return;
  const bool same_bodies = screen.outline && screen.outline->first.selection == selection;
  const DrawnWith now{screen.drawn->view, {}, selection, picture.width(), picture.height()};
  if (same_bodies && screen.outline->first.view == now.view && screen.outline->first.width == now.width &&
      screen.outline->first.height == now.height && screen.outline->second == document.time)
    return;
  // Surfaces hide bodies by the depth of the pane's own frame.
  if (rendered_ != place) return screen.drawn.reset();
  if (!outline_gl) outline_gl = std::make_unique<OutlineGl>();
  if (!same_bodies) outline_gl->set(*document.scene, instances_of(*document.scene, selection));
  outline_gl->draw(scene::world_matrices(*document.scene, document.time), renderer_->depth_texture(),
                   renderer_->view_projection(), now.width, now.height);
  screen.outline = {now, document.time};
  redraw();
}

}  // namespace ssphh::viewer

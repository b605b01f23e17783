#include "marks.h"

#include <algorithm>
#include <cmath>

#include <ssphh/methods/method_list.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::viewer {
namespace {

sketch::Sketch marks_of_methods(const MarksParams& params, const trace::SharedGeometry& geometry,
                                const Control& control) {
  sketch::Sketch marks;
  std::vector<std::string> made;
  for (const methods::Drawing first : params.what) {
    const std::string name = method_drawing(first);
    if (std::ranges::count(made, name) > 0) continue;
    made.push_back(name);
    const methods::MethodEntry& entry = methods::find_method(name);
    const trace::TransportScene source(geometry, *params.scene);
    const auto method = entry.make({*params.scene, source}, {entry.name, entry.parameters}, control);
    method->update(rays::lighting_at(source, params.time), control);
    for (const methods::Drawing what : params.what)
      if (method_drawing(what) == name) marks += method->drawing(what);
  }
  return marks;
}

}  // namespace

const char* method_drawing(methods::Drawing what) {
  const auto has_it = [&](const methods::MethodEntry& entry) {
    return std::ranges::count(entry.drawings, what) > 0;
  };
  return std::ranges::find_if(methods::all_methods(), has_it)->name;
}

void Marks::draw(MarksParams given) {
  picture_ = {};
  const auto shared = std::make_shared<MarksParams>(std::move(given));
  job_.start("marks", [this, shared, found = found_](const Control& control) -> BackgroundJob::Finish {
    MarksParams& params = *shared;
    const trace::SharedGeometry geometry =
        params.geometry ? params.geometry : trace::geometry_of(params.scene);
    std::shared_ptr<const Found> now = found;
    if (!now || now->what != params.what)
      now = std::make_shared<const Found>(Found{params.what, marks_of_methods(params, geometry, control)});
    sketch::Sketch all = params.own;
    all += now->marks;
    trace::RenderParams render;
    render.width = params.picture.width, render.height = params.picture.height;
    render.camera = params.camera;
    if (params.camera.camera.orthographic) render.projection = trace::Projection::orthographic;
    pipeline::draw_marks(params.picture, all, geometry, *params.scene, params.time, render,
                         std::exp2(-params.tone.exposure), control);
    return [this, now, picture = image::to_display(params.picture, params.tone)] {
      found_ = now;
      picture_ = picture;
    };
  });
}

void Marks::clear() {
  job_.cancel();
  picture_ = {};
}

}  // namespace ssphh::viewer

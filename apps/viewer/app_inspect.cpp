// The pixel inspector, and views of before.

#include <algorithm>

#include "app.h"

namespace ssphh::viewer {

void App::inspect(const vec2& point) {
  const InspectedAt now{point,           view,          document.time, document.history.serial(),
                        screen.pictures, picking_.get()};
  if (!inspection || !inspected_ || !(*inspected_ == now)) {
    inspected_ = now;
    inspection = Inspection{};
    inspection->point = point;
    const rays::RayQuery ray = pixel_ray(view, point, viewport.aspect());
    inspection->surface = inspect_surface(*document.scene, document.edits(), document.time, ray);
    if (inspection->surface && !light.empty() && settings.lookup == probes::LookupMethod::irradiance) {
      const rays::PosedWorld world(*picking_, document.time);
      try {
        probes::LookupParams params = light.lookup_params(settings);
        params.weights.method = settings.weights;
        inspection->light = inspect_light(
            light.set(), params, {inspection->surface->position, inspection->surface->face_normal, false},
            [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
      } catch (const Error&) {
        // A bake that is under way has no light yet.
        inspection->light = {};
      }
    }
  }
  const auto pixel = [&](const image::Image& image) -> std::optional<vec3> {
    if (image.width != picture.width() || image.height != picture.height() || image.pixels.empty()) return {};
    const auto x = static_cast<int>(point.x * static_cast<float>(image.width)),
               y = static_cast<int>((1 - point.y) * static_cast<float>(image.height));
    return image.rgb(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
  };
  inspection->radiance = screen.awaits_picture() ? inspection->radiance : pixel(picture.linear());
  const ReferenceImage& truth = reference.image();
  inspection->truth = needs_truth(settings) && truth.color ? pixel(*truth.color) : std::nullopt;
}

void App::toggle_inspector() {
  inspecting = !inspecting;
  pinned.reset();
  inspection.reset();
  redraw();
}

void App::note_view() {
  if (drag.what == Drag::What::none && !path_plays) views.note(view, window.seconds());
}

void App::view_back() {
  const std::optional<View> before = views.back(view);
  if (!before) return say("there is no earlier view");
  view = *before;
  path_plays = false;
  redraw();
}

void App::view_forward() {
  const std::optional<View> next = views.forward(view);
  if (!next) return say("there is no later view");
  view = *next;
  path_plays = false;
  redraw();
}

void App::view_along(const vec3& direction) {
  views.keep(view);
  view = seen_along(view, direction);
  path_plays = false;
  redraw();
}

void App::toggle_orthographic() {
  views.keep(view);
  view = with_other_projection(view);
  redraw();
}

}  // namespace ssphh::viewer

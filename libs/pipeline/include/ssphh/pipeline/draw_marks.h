#pragma once
/// Draws marks in the world over a picture of a scene.

#include <ssphh/image/image.h>
#include <ssphh/sketch/sketch.h>
#include <ssphh/trace/render_state.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::pipeline {

/// `picture` was rendered with these parameters, of the scene posed at `time`, in any projection; `white` is
/// the radiance that is shown as 1. What surfaces hide is dimmed; glass hides nothing. Throws Error for a
/// picture of another size; Cancelled.
void draw_marks(image::Image& picture, const sketch::Sketch& marks, const trace::SharedGeometry& geometry,
                const scene::Scene& scene, float time, const trace::RenderParams& params, float white,
                const Control& control = {});

}  // namespace ssphh::pipeline

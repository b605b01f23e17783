#pragma once
/// `ssphh render`: a picture of a scene.

#include <array>
#include <functional>
#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/image.h>
#include <ssphh/pipeline/method_figures.h>

#include "options/render_options.h"

namespace ssphh::app {

using pipeline::MethodFigures;

/// What the real-time renderer tells of its frame.
struct GlFigures {
  std::string renderer;            ///< as OpenGL calls itself
  int samples = 0;                 ///< per pixel
  methods::MethodNumbers numbers;  ///< of the method's light on the GPU
};

struct RenderResult {
  image::Image picture;           ///< linear radiance, with what is drawn over it
  std::array<double, 3> mean{};   ///< of the picture before that, per channel
  std::optional<float> exposure;  ///< EV of what was tone mapped; none: nothing was
  double seconds = 0;             ///< of the picture, without reading the scene and writing files
  int passes = 0;                 ///< that the picture holds; this and the next two are 0 by OpenGL
  std::uint64_t paths = 0, rays = 0;
  std::optional<MethodFigures> method;   ///< of a method that was made for the picture
  std::optional<farm::FarmReport> farm;  ///< of a farm that made the picture
  std::optional<GlFigures> gl;           ///< where OpenGL drew the picture
  std::size_t marks = 0;                 ///< lines, discs, boxes, balls and lobes that were drawn over it
  std::uint64_t geometry_builds = 0;     ///< acceleration structures that were built
};

/// Makes the picture and writes the files. When asked to stop after the first pass it leaves OUTPUT.state for
/// the next call with `resume`, says so in the log and throws Cancelled. Warns in the log about a scene
/// without lights, which a studio lights. Throws Error for options that exclude each other (before anything
/// else), for files that cannot be read or written, for unknown names of methods, parameters, cameras and
/// places, for probes of another scene, for an OUTPUT.state of another picture, for a farm that cannot be
/// reached and where OpenGL fails.
RenderResult run_render(const RenderOptions& options, const Control& control = {});

/// `render --backend gl`: one frame of the real-time renderer, samples on a square grid. Throws Error for
/// options that it has no answer to.
RenderResult render_gl(const RenderOptions& options, const Control& control);

/// Draws over a picture that shows this radiance as 1.
using DrawOver = std::function<void(image::Image& picture, float white)>;

/// Ends a picture of these parameters with write_rendered(). Without a geometry one is built where there are
/// marks.
void draw_and_write(RenderResult& result, const RenderOptions& options, const sketch::Sketch& marks,
                    trace::SharedGeometry geometry, const scene::Scene& scene,
                    const trace::RenderParams& params, const Control& control);

/// What both backends end with: writes the picture as the options say, with what is drawn over it, and finds
/// its exposure and mean.
void write_rendered(RenderResult& result, const RenderOptions& options, const DrawOver& over = {});

json::Value to_json(const RenderResult& result, const RenderOptions& options);
std::string to_text(const RenderResult& result, const RenderOptions& options);

}  // namespace ssphh::app

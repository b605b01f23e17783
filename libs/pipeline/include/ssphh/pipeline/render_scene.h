#pragma once
/// A picture of a scene: where it is looked at from, and what finds its indirect light.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/render_state.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::pipeline {

/// What the camera sees, or the whole sphere around it: equirectangular, or as a strip of 6×1 faces.
enum class PictureProjection { camera, equirect, cube };
constexpr auto enum_table(PictureProjection) {
  using enum PictureProjection;
  return std::to_array<EnumName<PictureProjection>>(
      {{camera, "camera"}, {equirect, "equirect"}, {cube, "cube"}});
}
trace::Projection projection_of(PictureProjection projection, const scene::Camera& camera);

/// The camera of that name, or the scene's first; study::default_view() of a scene that has none, by its
/// geometry where that has been built already.
scene::CameraPose camera_of(const scene::Scene& scene, const std::string& name, float time,
                            trace::SharedGeometry geometry = {});

/// What finds indirect light.
struct LightFinder {
  std::string method = "path";               ///< path, or one of methods::all_methods()
  std::vector<std::string> parameters = {};  ///< of the method, as NAME=VALUE
  const probes::ProbeSet* probes = nullptr;  ///< of method ssphh; null: it makes some for the picture
  std::string probes_name = {};              ///< of their file, for messages
  probes::LookupSpec lookup = {};            ///< of the probes
};

/// Throws Error for probes and parameters that the method does not take.
void check_method(const std::string& method, bool with_parameters, bool with_probes);

/// Throws Error, with the methods that could, where the method, or its made probes, has nothing of that to
/// draw.
void check_drawings(const std::string& method, bool with_probes, std::span<const methods::Drawing> drawings);

/// What there is to draw of a method made for the picture. Warns in the log where there is nothing of that.
sketch::Sketch drawn_of(const methods::Method& method, std::span<const methods::Drawing> drawings);
/// What there is to draw of made probes: their hierarchy.
sketch::Sketch drawn_of(const probes::ProbeSet& set, std::span<const methods::Drawing> drawings);

/// Adds passes to `state`, as trace::PathTracer::render does, of the scene posed at `time`. Returns what a
/// method took that was made for the picture; none for the others. Marks of `drawings` go to `drawn`; `see`
/// is told of each pass. Throws Error for unknown methods and parameters, for weights that the probes do not
/// have, and as the method does; Cancelled.
std::optional<MethodFigures> render_scene(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                          float time, const LightFinder& finder,
                                          const trace::RenderParams& params, trace::RenderState& state,
                                          const Control& control = {},
                                          std::span<const methods::Drawing> drawings = {},
                                          sketch::Sketch* drawn = nullptr, const trace::SeePass& see = {});

}  // namespace ssphh::pipeline

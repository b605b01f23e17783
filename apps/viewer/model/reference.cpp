#include "reference.h"

#include <optional>

#include <ssphh/methods/method_list.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::viewer {

void Reference::start(const ReferenceParams& params) {
  image_ = {};
  job_.start(params.method == "path" ? "path tracing" : params.method,
             [this, params](const Control& control) -> BackgroundJob::Finish {
               const trace::SharedGeometry geometry =
                   params.geometry ? params.geometry : trace::geometry_of(params.scene);
               const trace::PathTracer tracer(geometry, *params.scene, params.time);
               trace::RenderParams render;
               render.width = params.width;
               render.height = params.height;
               render.camera = params.camera;
               if (params.camera.camera.orthographic) render.projection = trace::Projection::orthographic;
               render.path = {.max_depth = params.max_depth, .passes = 0, .spp = 1, .seed = 0};
               std::optional<trace::TransportScene> source;
               std::unique_ptr<methods::Method> method;
               if (params.method != "path") {
                 const methods::MethodEntry& entry = methods::find_method(params.method);
                 source.emplace(geometry, *params.scene);
                 method = entry.make({*params.scene, *source}, {entry.name, entry.parameters}, control);
                 method->update(rays::lighting_at(*source, params.time), control);
               }
               trace::RenderState state;
               const ProgressStage stage(control, "samples per pixel",
                                         static_cast<std::uint64_t>(params.passes), "spp");
               for (int pass = 1; pass <= params.passes; ++pass) {
                 control.check();
                 render.path.passes = pass;
                 const Control quiet{nullptr, control.cancel};
                 if (method) {
                   tracer.render_with(method->light(), render, state, quiet);
                 } else {
                   tracer.render(render, state, quiet);
                 }
                 ReferenceImage image;
                 image.color = std::make_shared<const image::Image>(trace::resolve(state.color, pass));
                 image.indirect = std::make_shared<const image::Image>(trace::resolve(state.indirect, pass));
                 image.passes = pass;
                 control.progress->advance(1);
                 job_.hand_over([this, image] { image_ = image; });
               }
               return {};
             });
}

void Reference::clear() {
  job_.cancel();
  image_ = {};
}

}  // namespace ssphh::viewer

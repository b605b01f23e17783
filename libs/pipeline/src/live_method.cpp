#include <ssphh/core/stopwatch.h>
#include <ssphh/pipeline/live_method.h>

namespace ssphh::pipeline {

LiveMethod::LiveMethod(const std::string& name, const std::vector<std::string>& settings,
                       trace::SharedGeometry geometry, const scene::Scene& scene, const Control& control,
                       bool keep_direct)
    : source_(std::move(geometry), scene) {
  const methods::MethodEntry& entry = methods::find_method(name);
  const methods::MethodParameters parameters(name, entry.parameters, settings);
  const Stopwatch watch;
  method_ = entry.make({scene, source_, keep_direct}, parameters, control);
  bake_seconds_ = watch.seconds();
}

void LiveMethod::update(const scene::LightingState& state, const Control& control) {
  const Stopwatch watch;
  method_->update(state, control);
  update_seconds_ = watch.seconds();
}

MethodFigures LiveMethod::figures() const {
  return {bake_seconds_, update_seconds_, method_->memory(), method_->numbers()};
}

}  // namespace ssphh::pipeline

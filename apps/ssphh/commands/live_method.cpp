#include "commands/live_method.h"

namespace ssphh::app {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

LiveMethod::LiveMethod(const std::string& name, const std::vector<std::string>& settings,
                       trace::SharedGeometry geometry, const scene::Scene& scene, const Control& control)
    : source_(std::move(geometry), scene) {
  const methods::MethodEntry& entry = methods::find_method(name);
  const methods::MethodParameters parameters(name, entry.parameters, settings);
  const Clock::time_point start = Clock::now();
  method_ = entry.make({scene, source_}, parameters, control);
  bake_seconds_ = seconds_since(start);
}

void LiveMethod::update(const scene::LightingState& state, const Control& control) {
  const Clock::time_point start = Clock::now();
  method_->update(state, control);
  update_seconds_ = seconds_since(start);
}

MethodFigures LiveMethod::figures() const {
  return {bake_seconds_, update_seconds_, method_->memory(), method_->numbers()};
}

}  // namespace ssphh::app

#include "commands/live_method.h"

#include <fmt/format.h>

namespace ssphh::app {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string bytes_text(std::size_t bytes) {
  const auto count = static_cast<double>(bytes);
  if (count < 1e4) return fmt::format("{} B", bytes);
  return count < 1e6 ? fmt::format("{:.1f} KB", count / 1e3) : fmt::format("{:.1f} MB", count / 1e6);
}

}  // namespace

LiveMethod::LiveMethod(const std::string& name, const std::vector<std::string>& settings,
                       trace::SharedGeometry geometry, const scene::Scene& scene, const Control& control)
    : source_(std::move(geometry), scene) {
  const gi::MethodEntry& entry = gi::find_method(name);
  const gi::MethodParameters parameters(name, entry.parameters, settings);
  const Clock::time_point start = Clock::now();
  method_ = entry.make({scene, source_}, parameters, control);
  bake_seconds_ = seconds_since(start);
}

void LiveMethod::update(const scene::LightingState& state, const Control& control) {
  const Clock::time_point start = Clock::now();
  method_->update(state, control);
  update_seconds_ = seconds_since(start);
}

json::Value LiveMethod::json() const {
  const gi::MethodMemory memory = method_->memory();
  json::Value object = {{"bake_seconds", bake_seconds_},
                        {"update_seconds", update_seconds_},
                        {"lookup_bytes", memory.lookup},
                        {"update_bytes", memory.update}};
  for (const auto& [name, value] : method_->numbers()) object[name] = value;
  return object;
}

std::string LiveMethod::text() const {
  const gi::MethodMemory memory = method_->memory();
  std::string text =
      fmt::format("bake {:.2f} s, update {:.3g} ms, {} to look up, {} more to follow changes", bake_seconds_,
                  1e3 * update_seconds_, bytes_text(memory.lookup), bytes_text(memory.update));
  for (const auto& [name, value] : method_->numbers()) text += fmt::format(", {} {:.6g}", name, value);
  return text;
}

}  // namespace ssphh::app

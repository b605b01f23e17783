#include <fmt/format.h>

#include <ssphh/pipeline/method_figures.h>

namespace ssphh::pipeline {
namespace {

std::string bytes_text(std::size_t bytes) {
  const auto count = static_cast<double>(bytes);
  if (count < 1e4) return fmt::format("{} B", bytes);
  return count < 1e6 ? fmt::format("{:.1f} KB", count / 1e3) : fmt::format("{:.1f} MB", count / 1e6);
}

}  // namespace

json::Value to_json(const MethodFigures& figures) {
  json::Value object = {{"bake_seconds", figures.bake_seconds},
                        {"update_seconds", figures.update_seconds},
                        {"lookup_bytes", figures.memory.lookup},
                        {"update_bytes", figures.memory.update}};
  for (const auto& [name, value] : figures.numbers) object[name] = value;
  return object;
}

std::string to_text(const MethodFigures& figures) {
  std::string text = fmt::format("bake {:.2f} s, update {:.3g} ms, {} to look up, {} more to follow changes",
                                 figures.bake_seconds, 1e3 * figures.update_seconds,
                                 bytes_text(figures.memory.lookup), bytes_text(figures.memory.update));
  for (const auto& [name, value] : figures.numbers) text += fmt::format(", {} {:.6g}", name, value);
  return text;
}

}  // namespace ssphh::pipeline

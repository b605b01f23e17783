#include <cstddef>
#include <cstdint>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/overlay.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh;
  static const LogSink silent = set_log_sink([](LogLevel, const std::string&) {});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    scene::Scene scene;
    scene.nodes.resize(1);
    scene.nodes[0].name = "a";
    scene.materials.resize(1);
    scene_io::apply_overlay(scene, text, "/nonexistent/fuzz.ssphh.json");
    scene::validate(scene);
    scene_io::overlay_scene(text, "/nonexistent/fuzz.ssphh.json");
  } catch (const Error&) {
  }
  return 0;
}

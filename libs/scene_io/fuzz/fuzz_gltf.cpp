#include <cstddef>
#include <cstdint>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh;
  static const LogSink silent = set_log_sink([](LogLevel, const std::string&) {});
  try {
    scene::Scene scene = scene_io::load_gltf(std::as_bytes(std::span(data, size)), "/nonexistent/fuzz.glb");
    scene::validate(scene);
    scene::world_matrices(scene, 0.5f);
  } catch (const Error&) {
  }
  return 0;
}

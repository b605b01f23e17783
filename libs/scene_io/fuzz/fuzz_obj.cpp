#include <cstddef>
#include <cstdint>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/obj.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh;
  static const LogSink silent = set_log_sink([](LogLevel, const std::string&) {});
  try {
    scene::Scene scene =
        scene_io::load_obj({reinterpret_cast<const char*>(data), size}, "/nonexistent/fuzz.obj");
    scene::validate(scene);
  } catch (const Error&) {
  }
  return 0;
}

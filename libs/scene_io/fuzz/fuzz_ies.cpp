#include <cstddef>
#include <cstdint>

#include <ssphh/core/error.h>
#include <ssphh/scene_io/ies.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh;
  try {
    const scene::PhotometricTable table =
        scene_io::ies_from_text({reinterpret_cast<const char*>(data), size}, "fuzz.ies");
    const auto profile = std::make_shared<const scene::PhotometricTable>(table);
    // What was read once is written and read as it was.
    if (scene_io::ies_from_text(scene_io::ies_to_text({"fuzz", profile}), "again") != table) __builtin_trap();
  } catch (const Error&) {
  }
  return 0;
}

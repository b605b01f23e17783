/// The runtime on arbitrary bytes: a file is refused, or looked up without harm. The first byte: bit 0 signs
/// the file and tells its true size, so that the fuzzer reaches what lies behind these; the next 24 a place
/// and a normal.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <ssphh/runtime/cooked_file.h>
#include <ssphh/runtime/runtime.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 25) return 0;
  ssphh_runtime_place place;
  std::memcpy(&place, data + 1, sizeof place);
  std::vector<std::uint8_t> file(data + 25, data + size);  // aligned as malloc does
  if (data[0] & 1 && file.size() >= sizeof(ssphh_cooked_header)) {
    file.resize(file.size() / 8 * 8);
    ssphh_cooked_header header;
    std::memcpy(&header, file.data(), sizeof header);
    std::memcpy(header.magic, SSPHH_COOKED_MAGIC, sizeof header.magic);
    header.version = SSPHH_COOKED_VERSION;
    header.header_size = sizeof header;
    header.file_size = file.size();
    std::memcpy(file.data(), &header, sizeof header);
    header.checksum = ssphh_cooked_checksum(file.data(), file.size());
    std::memcpy(file.data(), &header, sizeof header);
  }
  std::size_t needed = 0;
  if (ssphh_runtime_size_needed(file.data(), file.size(), &needed) != SSPHH_RUNTIME_OK) return 0;
  std::vector<std::uint8_t> memory(needed);
  ssphh_runtime* runtime = nullptr;
  if (ssphh_runtime_open(file.data(), file.size(), memory.data(), memory.size(), &runtime) !=
      SSPHH_RUNTIME_OK)
    return 0;
  float rgb[3];
  for (const unsigned flags : {0u, 1u}) {
    ssphh_runtime_irradiance(runtime, flags, place.position, place.normal, rgb);
    ssphh_runtime_irradiance_batch(runtime, flags, &place, 1, rgb);
    for (const float e : rgb)
      if (!(e >= 0)) __builtin_trap();
  }
  if (ssphh_runtime_swap_light(runtime, file.data(), file.size()) != SSPHH_RUNTIME_OK) __builtin_trap();
  return 0;
}

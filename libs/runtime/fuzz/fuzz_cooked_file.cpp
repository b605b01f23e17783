/// The runtime on arbitrary bytes: a file is refused, or looked up without harm. The first byte chooses: bit
/// 0, bytes are a file whose magic, sizes and checksum are mended, so that the fuzzer reaches what lies
/// behind these; bit 1, they are places and values of words that change in a whole file, which is signed
/// again. The next 24 are a place and a normal.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <ssphh/runtime/cooked_file.h>

#include "../../../tests/support/cooked_room.h"

namespace {

using Bytes = std::vector<std::byte>;  // aligned as malloc does

void sign(Bytes& file) {
  const std::uint64_t sum = ssphh_cooked_checksum(file.data(), file.size());
  std::memcpy(file.data() + offsetof(ssphh_cooked_header, checksum), &sum, sizeof sum);
}

void mend(Bytes& file) {
  if (file.size() < sizeof(ssphh_cooked_header)) return;
  file.resize(file.size() / 8 * 8);
  ssphh_cooked_header header;
  std::memcpy(&header, file.data(), sizeof header);
  std::memcpy(header.magic, SSPHH_COOKED_MAGIC, sizeof header.magic);
  header.version = SSPHH_COOKED_VERSION;
  header.header_size = sizeof header;
  header.file_size = file.size();
  std::memcpy(file.data(), &header, sizeof header);
  sign(file);
}

const Bytes& whole_file() {
  using namespace ssphh::test;
  static const Bytes whole = cook_two_rooms(set_of_two_rooms(OnSurfaces::records, 1), 8);
  return whole;
}

Bytes changed(const Bytes& changes) {
  Bytes file = whole_file();
  for (std::size_t i = 0; i + 8 <= changes.size(); i += 8) {
    std::uint32_t at;
    std::memcpy(&at, changes.data() + i, sizeof at);
    std::memcpy(file.data() + at % (file.size() / 4) * 4, changes.data() + i + 4, 4);
  }
  sign(file);
  return file;
}

}  // namespace

/// Cooks before inputs are timed.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  whole_file();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 25) return 0;
  ssphh_runtime_place place;
  std::memcpy(&place, data + 1, sizeof place);
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  Bytes file(bytes + 25, bytes + size);
  if (data[0] & 2) {
    file = changed(file);
  } else if (data[0] & 1) {
    mend(file);
  }
  std::size_t needed = 0;
  if (ssphh_runtime_size_needed(file.data(), file.size(), &needed) != SSPHH_RUNTIME_OK) return 0;
  Bytes memory(needed);
  ssphh_runtime* runtime = nullptr;
  if (ssphh_runtime_open(file.data(), file.size(), memory.data(), memory.size(), &runtime) !=
      SSPHH_RUNTIME_OK)
    return 0;
  float rgb[3];
  for (const unsigned flags : {0u, 1u}) {
    ssphh_runtime_irradiance(runtime, flags, place.position, place.normal, rgb);
    for (const float e : rgb)
      if (!(e >= 0)) __builtin_trap();
  }
  if (ssphh_runtime_swap_light(runtime, file.data(), file.size()) != SSPHH_RUNTIME_OK) __builtin_trap();
  return 0;
}

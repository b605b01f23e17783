/// Both probe readers on arbitrary bytes: an Error or a valid set, nothing else. The first byte chooses the
/// reader; for the binary one, bit 1 mends size and checksum, so that the fuzzer reaches what lies behind
/// them, in a file with packed light if bit 2 is set.

#include <cstring>

#include <ssphh/core/hash.h>
#include <ssphh/probes/probe_file.h>

namespace {

std::vector<std::byte> with_header(std::span<const std::byte> payload, std::uint32_t version) {
  std::vector<std::byte> file(36);
  std::memcpy(file.data(), "SPHL\r\n\x1a\n", 8);
  const std::uint64_t size = payload.size();
  const ssphh::Hash128 sum = ssphh::Hasher().bytes(payload).finish();
  std::memcpy(file.data() + 8, &version, 4);
  std::memcpy(file.data() + 12, &size, 8);
  std::memcpy(file.data() + 20, &sum.high, 8);
  std::memcpy(file.data() + 28, &sum.low, 8);
  file.insert(file.end(), payload.begin(), payload.end());
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh::probes;
  if (size == 0) return 0;
  const std::span bytes(reinterpret_cast<const std::byte*>(data + 1), size - 1);
  try {
    if (data[0] & 1) {
      const ProbeSet set =
          probes_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "input");
      const std::string text = probes_to_json(set);
      if (probes_to_json(probes_from_json(text, "output")) != text) __builtin_trap();
    } else {
      const std::uint32_t version = data[0] & 4 ? packed_probe_file_version : probe_file_version;
      const ProbeSet set = probes_from_binary(
          data[0] & 2 ? with_header(bytes, version) : std::vector(bytes.begin(), bytes.end()), "input");
      if (probes_from_binary(probes_to_binary(set), "output") != set) __builtin_trap();
    }
  } catch (const ssphh::Error&) {
    return 0;
  }
  return 0;
}

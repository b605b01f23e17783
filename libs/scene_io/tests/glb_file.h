#pragma once
/// GLB files taken apart, so that a test changes them and puts them together again.

#include <span>

#include <ssphh/core/json.h>

#include "glb_builder.h"

namespace ssphh::test {

struct GlbFile {
  json::Value json;
  std::vector<std::byte> binary;  ///< of buffer 0

  explicit GlbFile(std::span<const std::byte> file) {
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, 4);
    json = json::parse({reinterpret_cast<const char*>(file.data()) + 20, length}, "test.glb");
    const auto rest = file.subspan(20 + length + 8);
    binary.assign(rest.begin(), rest.end());
  }

  std::vector<std::byte> write() {
    json["buffers"][std::size_t{0}]["byteLength"] = binary.size();
    return GlbBuilder::container(json::print(json), binary);
  }

  /// Appends bytes at a multiple of four; where they begin.
  std::size_t append(std::span<const std::byte> bytes) {
    binary.resize((binary.size() + 3) / 4 * 4);
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return binary.size() - bytes.size();
  }

  /// The bytes of a view of buffer 0.
  std::vector<std::byte> view(std::size_t index) const {
    const json::Value& v = json["bufferViews"][index];
    const auto begin = v.contains("byteOffset") ? static_cast<std::ptrdiff_t>(v["byteOffset"].number()) : 0;
    const auto length = static_cast<std::ptrdiff_t>(v["byteLength"].number());
    return {binary.begin() + begin, binary.begin() + begin + length};
  }
};

}  // namespace ssphh::test

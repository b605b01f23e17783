#pragma once
/// Buffer views that meshoptimizer has packed: EXT_meshopt_compression and KHR_meshopt_compression.

#include "gltf_document.h"

namespace ssphh::scene_io {

/// How a packed view is stored.
struct PackedView {
  enum class Mode { attributes, triangles, indices };
  enum class Filter { none, octahedral, quaternion, exponential };
  int buffer = 0;
  std::uint64_t begin = 0, length = 0;  ///< bytes of that buffer
  std::uint64_t count = 0, stride = 0;  ///< elements of so many bytes, unpacked
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};

/// The extension of a buffer view that has one, its sizes checked against the file: the elements fill the
/// view and the packed bytes lie within their buffer. Throws Error for what the extension forbids.
std::optional<PackedView> packed_view(const GltfDocument& document, const json::Cursor& view);

/// The bytes of a packed view, which `data` holds packed. Takes count × stride bytes. Throws Error for
/// damaged data and for versions that the library does not read.
std::vector<std::byte> unpack(const PackedView& packed, std::span<const std::byte> data,
                              const json::Cursor& view);

}  // namespace ssphh::scene_io

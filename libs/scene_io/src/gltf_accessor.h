#pragma once
/// glTF accessors decoded to floats and indices: strides, normalised integers, sparse values, bounds.

#include "gltf_document.h"

namespace ssphh::scene_io {

/// count × components floats, row-major.
struct FloatArray {
  std::size_t count = 0;
  int components = 1;
  std::vector<float> values;

  const float* operator[](std::size_t i) const {
    return values.data() + i * static_cast<std::size_t>(components);
  }
};

/// Bytes of one element by componentType and type; fails for unknown ones.
std::uint64_t accessor_element_bytes(const json::Cursor& accessor);

/// Decodes an accessor whose number of components lies in [min_components, max_components]. Throws Error for
/// anything out of bounds and for NaN or infinite values. 16 components: a 4 × 4 matrix, column by column.
FloatArray read_floats(GltfDocument& document, int accessor, int min_components, int max_components);

/// Decodes an accessor of unsigned scalars.
std::vector<std::uint32_t> read_indices(GltfDocument& document, int accessor);

}  // namespace ssphh::scene_io

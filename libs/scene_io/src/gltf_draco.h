#pragma once
/// Primitives that Draco has packed: KHR_draco_mesh_compression.

#include <map>

#include "gltf_accessor.h"

namespace ssphh::scene_io {

/// What stands for a primitive's indices and for those of its attributes that are packed.
struct DracoPrimitive {
  std::vector<std::uint32_t> indices;  ///< of triangles, three for each
  std::map<std::string, FloatArray> attributes;

  /// nullptr where that attribute is not packed.
  const FloatArray* find(const std::string& name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? nullptr : &found->second;
  }
};

/// The packed data of a primitive that has some. The counts that it announces are compared with the
/// primitive's accessors and charged before Draco takes memory for them. Throws Error for damaged data, for
/// bitstreams other than the 2.2 that the extension asks for, and where attributes differ from their
/// accessors.
std::optional<DracoPrimitive> read_draco(GltfDocument& document, const json::Cursor& primitive);

}  // namespace ssphh::scene_io

#pragma once
/// Small glTF files made in memory.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace ssphh::test {

/// Collects binary data, buffer views and accessors.
class GlbBuilder {
 public:
  /// One bufferView, at a multiple of four bytes; its index.
  template <class T>
  int view(const std::vector<T>& values, const std::string& more = {}) {
    const std::size_t offset = binary_.size(), size = values.size() * sizeof(T);
    binary_.resize(offset + ((size + 3) & ~std::size_t{3}));
    if (size > 0) std::memcpy(binary_.data() + offset, values.data(), size);
    views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}}}", separator(views_),
                          offset, size, more);
    return next_view_++;
  }

  /// A view whose bytes come from `extension` of EXT_meshopt_compression; its index.
  int packed_view(std::size_t size, std::size_t stride, const std::string& extension) {
    views_ += fmt::format(
        "{}{{\"buffer\":0,\"byteLength\":{},\"byteStride\":{},\"extensions\":{{\"EXT_meshopt_compression\":{}"
        "}}}}",
        separator(views_), size, stride, extension);
    return next_view_++;
  }

  /// Bytes of the buffer so far.
  std::size_t size() const { return binary_.size(); }

  /// An accessor of these members; its index.
  int accessor(const std::string& members) {
    accessors_ += fmt::format("{}{{{}}}", separator(accessors_), members);
    return next_accessor_++;
  }

  /// A view and the accessor of all of it; the accessor's index.
  template <class T>
  int add(const std::vector<T>& values, int component_type, const std::string& type, std::size_t count,
          const std::string& more = {}) {
    return accessor(fmt::format("\"bufferView\":{},\"componentType\":{},\"type\":\"{}\",\"count\":{}{}",
                                view(values), component_type, type, count, more));
  }

  /// `members`: the JSON's other members, such as "\"nodes\":[…]".
  std::string json(const std::string& members) const {
    return fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":{}}}],\"bufferViews\":[{}],"
        "\"accessors\":[{}],{}}}",
        binary_.size(), views_, accessors_, members);
  }

  std::vector<std::byte> glb(const std::string& members) const { return container(json(members), binary_); }

  static std::vector<std::byte> container(std::string json, const std::vector<std::byte>& binary) {
    json.resize((json.size() + 3) & ~std::size_t{3}, ' ');
    std::vector<std::byte> out;
    const auto u32 = [&](std::size_t v) {
      for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::byte>((v >> (8 * i)) & 0xff));
    };
    u32(0x46546c67), u32(2), u32(12 + 8 + json.size() + 8 + binary.size());
    u32(json.size()), u32(0x4e4f534a);
    for (const char c : json) out.push_back(static_cast<std::byte>(c));
    u32(binary.size()), u32(0x004e4942);
    out.insert(out.end(), binary.begin(), binary.end());
    return out;
  }

 private:
  static const char* separator(const std::string& list) { return list.empty() ? "" : ","; }

  int next_view_ = 0, next_accessor_ = 0;
  std::string views_, accessors_;
  std::vector<std::byte> binary_;
};

/// A triangle with indices, texture coordinates, an animation, a light, a camera and an SPHL: some of
/// everything.
inline std::vector<std::byte> rich_glb() {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);  // 0 positions
  b.add<std::uint16_t>({0, 1, 2}, 5123, "SCALAR", 3);          // 1 indices
  b.add<std::uint8_t>({0, 0, 255, 0, 0, 255, 0, 0}, 5121, "VEC2", 3,
                      ",\"normalized\":true");        // 2 uv (stride below)
  b.add<float>({0, 1}, 5126, "SCALAR", 2);            // 3 times
  b.add<float>({0, 0, 0, 1, 2, 3}, 5126, "VEC3", 2);  // 4 translations
  return b.glb(
      "\"scene\":0,\"scenes\":[{\"name\":\"rich\",\"nodes\":[0,3]}],"
      "\"nodes\":[{\"name\":\"root\",\"children\":[1,2],\"scale\":[-1,1,1]},"
      "{\"name\":\"tri\",\"mesh\":0,\"translation\":[1,0,0],\"extras\":{\"light_group\":\"panel\"}},"
      "{\"name\":\"SPHL-a\",\"translation\":[0,2,0],\"extras\":{\"sphl\":{\"radius\":0.25}}},"
      "{\"name\":\"lamp\",\"camera\":0,\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
      "\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2},"
      "\"indices\":1,"
      "\"material\":0}]}],"
      "\"materials\":[{\"name\":\"glow\",\"emissiveFactor\":[1,0.5,0],\"doubleSided\":true,"
      "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,0.125,0.75],\"metallicFactor\":0.5,"
      "\"roughnessFactor\":0.25},\"alphaMode\":\"BLEND\","
      "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":4}}}],"
      "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.1}}],"
      "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}],"
      "\"samplers\":[{\"input\":3,\"output\":4}]}],"
      "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_materials_emissive_strength\"],"
      "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"name\":\"lamp\","
      "\"intensity\":7,"
      "\"spot\":{\"innerConeAngle\":0.1,\"outerConeAngle\":0.2}}]}}");
}

}  // namespace ssphh::test

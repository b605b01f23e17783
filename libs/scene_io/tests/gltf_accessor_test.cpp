// Accessors of every component type: normalised or not, tight or strided, replaced in part or wholly
// (sparse).

#include <cstring>
#include <optional>

#include <gtest/gtest.h>

#include <ssphh/scene_io/gltf.h>

#include "glb_builder.h"

namespace ssphh::scene_io {
namespace {

using test::GlbBuilder;

/// glTF 2.0, 3.6.2.2 and 3.11: integers stand for themselves or, normalised, for a share of the largest.
struct Component {
  const char* name;
  int code;
  std::size_t bytes;
  long long lowest, largest;  ///< 0, 0: float
  bool is_float() const { return largest == 0; }
};

constexpr Component components[] = {{"byte", 5120, 1, -128, 127},
                                    {"unsigned byte", 5121, 1, 0, 255},
                                    {"short", 5122, 2, -32768, 32767},
                                    {"unsigned short", 5123, 2, 0, 65535},
                                    {"unsigned int", 5125, 4, 0, 4294967295},
                                    {"float", 5126, 4, 0, 0}};

/// Six vertices are two triangles, which keeps all of them.
constexpr int vertex_count = 6;
using Values = std::vector<double>;  // as the file holds them, three a vertex

/// Different in every place, with both ends of the range.
Values values_of(const Component& component, int count, int seed) {
  Values values;
  for (int i = 0; i < 3 * count; ++i) {
    const double share = static_cast<double>((37 * (i + seed)) % 101) / 101;
    const auto low = static_cast<double>(component.lowest), high = static_cast<double>(component.largest);
    values.push_back(component.is_float() ? 8 * share - 3 : std::floor(low + share * (high - low)));
  }
  if (!component.is_float()) {
    values[1] = static_cast<double>(component.lowest);
    values[2] = static_cast<double>(component.largest);
  }
  return values;
}

/// Little-endian, `lead` bytes ahead and each vertex in `stride` bytes; what lies between is 0x5a.
std::vector<std::uint8_t> encoded(const Component& component, const Values& values, std::size_t lead,
                                  std::size_t stride) {
  std::vector<std::uint8_t> bytes(lead + values.size() / 3 * stride, 0x5a);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint8_t* to = bytes.data() + lead + i / 3 * stride + i % 3 * component.bytes;
    const auto f = static_cast<float>(values[i]);
    if (component.is_float()) {
      std::memcpy(to, &f, 4);
      continue;
    }
    const auto integer = static_cast<long long>(values[i]);
    for (std::size_t b = 0; b < component.bytes; ++b)
      to[b] = static_cast<std::uint8_t>((static_cast<unsigned long long>(integer) >> (8 * b)) & 0xff);
  }
  return bytes;
}

double decoded(const Component& component, double value, bool normalized) {
  if (!normalized || component.is_float()) return value;
  return std::max(value / static_cast<double>(component.largest), -1.0);
}

enum class Base { none, tight, strided };

/// Members of a sparse accessor that replaces two elements; both views begin with bytes that do not count.
std::string sparse_member(GlbBuilder& builder, const Component& component, const Values& values,
                          const std::vector<int>& places, const Component& index) {
  std::vector<std::uint8_t> indices(4, 0x5a);
  for (const int place : places)
    for (std::size_t b = 0; b < index.bytes; ++b)
      indices.push_back(static_cast<std::uint8_t>(b == 0 ? place : 0));
  const int index_view = builder.view(indices);
  const int value_view = builder.view(encoded(component, values, 8, 3 * component.bytes));
  return fmt::format(
      ",\"sparse\":{{\"count\":{},\"indices\":{{\"bufferView\":{},\"componentType\":{},\"byteOffset\":4}},"
      "\"values\":{{\"bufferView\":{},\"byteOffset\":8}}}}",
      places.size(), index_view, index.code, value_view);
}

std::vector<vec3> positions_read(GlbBuilder& builder) {
  const auto glb = builder.glb(
      "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]");
  return load_gltf(glb, "test.glb").meshes.at(0).positions;
}

void expect_decoded(const Component& component, bool normalized, Base base, bool sparse) {
  SCOPED_TRACE(fmt::format("{}{}, base {}{}", normalized ? "normalised " : "", component.name,
                           base == Base::none    ? "absent"
                           : base == Base::tight ? "tight"
                                                 : "strided",
                           sparse ? ", sparse" : ""));
  GlbBuilder builder;
  Values wanted(3 * vertex_count, 0);
  std::string members =
      fmt::format("\"componentType\":{},\"type\":\"VEC3\",\"count\":{}", component.code, vertex_count);
  if (base != Base::none) {
    wanted = values_of(component, vertex_count, 1);
    const std::size_t stride = base == Base::tight ? 3 * component.bytes : 3 * component.bytes / 4 * 4 + 8;
    const std::string more = base == Base::tight ? "" : fmt::format(",\"byteStride\":{}", stride);
    const int view = builder.view(encoded(component, wanted, 12, stride), more);
    members += fmt::format(",\"bufferView\":{},\"byteOffset\":12", view);
  }
  if (normalized) members += ",\"normalized\":true";
  if (sparse) {
    const Values replaced = values_of(component, 2, 29);
    // Each type of index in turn: unsigned byte, short and int.
    const Component& index = components[component.bytes == 1 ? 1 : component.bytes == 2 ? 3 : 4];
    members += sparse_member(builder, component, replaced, {1, 4}, index);
    std::copy(replaced.begin(), replaced.begin() + 3, wanted.begin() + 3);
    std::copy(replaced.begin() + 3, replaced.end(), wanted.begin() + 12);
  }
  builder.accessor(members);
  const std::vector<vec3> positions = positions_read(builder);
  ASSERT_EQ(positions.size(), static_cast<std::size_t>(vertex_count));
  for (int i = 0; i < 3 * vertex_count; ++i) {
    const double value = decoded(component, wanted[i], normalized);
    EXPECT_FLOAT_EQ(positions[i / 3][i % 3], static_cast<float>(value))
        << "vertex " << i / 3 << " component " << i % 3;
  }
}

TEST(GltfAccessor, EveryComponentTypeIsDecodedWhateverItsStride) {
  for (const Component& component : components) {
    for (const bool normalized : {false, true}) {
      for (const Base base : {Base::tight, Base::strided}) expect_decoded(component, normalized, base, false);
    }
  }
}

TEST(GltfAccessor, SparseValuesReplaceElementsAndAreDecodedAsTheyAre) {
  for (const Component& component : components) {
    for (const bool normalized : {false, true}) {
      for (const Base base : {Base::none, Base::tight, Base::strided})
        expect_decoded(component, normalized, base, true);
    }
  }
}

TEST(GltfAccessor, SparseIndicesReplaceCorners) {
  GlbBuilder builder;
  builder.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 3, 4}, 5126, "VEC3", 4);
  const int view = builder.view<std::uint16_t>({0, 1, 2, 0, 1, 2}),
            places = builder.view<std::uint8_t>({2, 5}), values = builder.view<std::uint16_t>({3, 0});
  builder.accessor(fmt::format(
      "\"bufferView\":{},\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6,\"sparse\":{{\"count\":2,"
      "\"indices\":{{\"bufferView\":{},\"componentType\":5121}},\"values\":{{\"bufferView\":{}}}}}",
      view, places, values));
  const auto glb = builder.glb(
      "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
      "\"indices\":1}]}]");
  const scene::Mesh mesh = load_gltf(glb, "test.glb").meshes.at(0);
  EXPECT_EQ(mesh.triangles, (std::vector<uvec3>{{0, 1, 3}, {0, 1, 0}}));
}

}  // namespace
}  // namespace ssphh::scene_io

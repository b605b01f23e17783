#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "gltf_export_parts.h"

namespace ssphh::scene_io {
namespace {

constexpr int component_float = 5126, component_u16 = 5123, component_u32 = 5125;

// GLB counts bytes in 32 bits; the header and the JSON chunk need room as well.
constexpr std::uint64_t max_binary = 0xf0000000;

json::Value accessor(int buffer_view, int component, std::size_t count, const char* type) {
  return {{"bufferView", buffer_view}, {"componentType", component}, {"count", count}, {"type", type}};
}

}  // namespace

json::Value number(float value) {
  if (!std::isfinite(value)) throw Error("glTF export", "a number of the scene is NaN or infinite");
  const double shortest = std::strtod(fmt::format("{}", value).c_str(), nullptr);
  // Reading rounds twice, to double and to float; keep the exact value in the rare case that this matters.
  return static_cast<float>(shortest) == value ? shortest : static_cast<double>(value);
}

json::Value numbers(std::span<const float> values) {
  json::Value array = json::Value::array();
  for (const float v : values) array.push_back(number(v));
  return array;
}

json::Value numbers(const vec3& v) {
  return numbers(std::span(&v.x, 3));
}

int push(json::Value& array, json::Value value) {
  array.push_back(std::move(value));
  return static_cast<int>(array.size()) - 1;
}

void add_extension(GltfExport& out, json::Value& object, const std::string& name, json::Value value) {
  object["extensions"][name] = std::move(value);
  out.extensions.insert(name);
}

int add_buffer_view(GltfExport& out, std::span<const std::byte> bytes, int target) {
  if (bytes.size() > max_binary - std::min<std::uint64_t>(max_binary, out.binary.size())) {
    throw Error("glTF export", "the scene is larger than a GLB file can be (4 GiB)");
  }
  json::Value view = {{"buffer", 0}, {"byteOffset", out.binary.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  out.binary.insert(out.binary.end(), bytes.begin(), bytes.end());
  out.binary.resize((out.binary.size() + 3) / 4 * 4);
  return push(out.buffer_views, std::move(view));
}

int add_float_accessor(GltfExport& out, std::span<const float> values, int components, bool bounds,
                       int target) {
  static constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto stride = static_cast<std::size_t>(components);
  json::Value result = accessor(add_buffer_view(out, std::as_bytes(values), target), component_float,
                                values.size() / stride, types[components - 1]);
  if (bounds) {
    std::vector<float> low(stride, std::numeric_limits<float>::infinity()), high(stride, -low[0]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % stride] = std::min(low[i % stride], values[i]);
      high[i % stride] = std::max(high[i % stride], values[i]);
    }
    result["min"] = numbers(low);
    result["max"] = numbers(high);
  }
  return push(out.accessors, std::move(result));
}

int add_index_accessor(GltfExport& out, std::span<const uvec3> triangles, std::size_t vertex_count) {
  constexpr int target = 34963;
  const std::size_t count = 3 * triangles.size();
  // 65535 itself means "restart" to some readers.
  if (vertex_count > 65535) {
    return push(out.accessors, accessor(add_buffer_view(out, std::as_bytes(triangles), target), component_u32,
                                        count, "SCALAR"));
  }
  std::vector<std::uint16_t> corners;
  corners.reserve(count);
  for (const uvec3& t : triangles) {
    for (int c = 0; c < 3; ++c) corners.push_back(static_cast<std::uint16_t>(t[c]));
  }
  return push(out.accessors,
              accessor(add_buffer_view(out, std::as_bytes(std::span<const std::uint16_t>(corners)), target),
                       component_u16, count, "SCALAR"));
}

}  // namespace ssphh::scene_io

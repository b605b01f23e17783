#include "ply.h"

#include <bit>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::scene_io {
namespace {

static_assert(std::endian::native == std::endian::little,
              "PLY files are written as the numbers lie in memory");

template <class T>
void append(std::vector<std::byte>& out, const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::vector<std::byte> encode_ply(const scene::Mesh& mesh, std::span<const vec2> uv,
                                  std::span<const vec3> colors) {
  if (mesh.positions.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(mesh.name, "has more vertices than a PLY file can number", "split the mesh");
  }
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      mesh.positions.size());
  if (!mesh.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!uv.empty()) header += "property float u\nproperty float v\n";
  if (!colors.empty()) header += "property float r\nproperty float g\nproperty float b\n";
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                        mesh.triangles.size());

  std::vector<std::byte> out;
  out.reserve(header.size() + 44 * mesh.positions.size() + 13 * mesh.triangles.size());
  const auto text = std::as_bytes(std::span(header));
  out.insert(out.end(), text.begin(), text.end());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append(out, mesh.positions[i]);
    if (!mesh.normals.empty()) append(out, mesh.normals[i]);
    if (!uv.empty()) append(out, uv[i]);
    if (!colors.empty()) append(out, colors[i]);
  }
  for (const uvec3& t : mesh.triangles) {
    append(out, std::uint8_t{3});
    append(out, t);
  }
  return out;
}

}  // namespace ssphh::scene_io

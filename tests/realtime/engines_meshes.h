#pragma once
/// A scene's meshes as an engine may have them in OpenGL: all in one buffer, vertices of every mesh laid out
/// otherwise, indices as small as they can be.

#include <cstring>
#include <vector>

#include <ssphh/gl/buffer.h>
#include <ssphh/realtime/mesh_buffers.h>
#include <ssphh/scene/scene.h>

namespace ssphh::test {

class EnginesMeshes {
 public:
  explicit EnginesMeshes(const scene::Scene& scene) {
    for (int m = 0; m < static_cast<int>(scene.meshes.size()); ++m) add(scene.meshes[m], m);
    buffer_ = gl::Buffer(std::span<const std::byte>(bytes_));
    for (realtime::MeshBuffers& mesh : meshes) {
      for (gl::VertexSource* source : sources(mesh)) {
        if (source->stride != 0) source->buffer = buffer_.id();
      }
      mesh.indices.buffer = buffer_.id();
    }
  }
  static std::vector<gl::VertexSource*> sources(realtime::MeshBuffers& mesh) {
    return {&mesh.positions, &mesh.normals, &mesh.tangents, &mesh.uvs[0], &mesh.uvs[1], &mesh.colors};
  }
  std::size_t size() const { return bytes_.size(); }

  std::vector<realtime::MeshBuffers> meshes;

 private:
  std::size_t grow(std::size_t bytes) {
    bytes_.resize(bytes_.size() + bytes, std::byte{0x5a});
    return bytes_.size() - bytes;
  }
  /// Of all vertices, so far apart, from `offset` on.
  template <class T>
  void put(gl::VertexSource& source, const std::vector<T>& values, std::size_t offset, std::size_t stride) {
    if (values.empty()) return;
    source.offset = offset, source.stride = stride;
    for (std::size_t i = 0; i < values.size(); ++i)
      std::memcpy(&bytes_[offset + i * stride], &values[i], sizeof(T));
  }
  template <class T>
  void put_indices(gl::IndexSource& source, const scene::Mesh& mesh) {
    source.offset = grow(4 + 3 * mesh.triangles.size() * sizeof(T)) + 4;
    T* to = reinterpret_cast<T*>(&bytes_[source.offset]);
    for (const uvec3& t : mesh.triangles) {
      for (int c = 0; c < 3; ++c) *to++ = static_cast<T>(t[c]);
    }
    grow(3 - (bytes_.size() + 3) % 4);
  }
  void add(const scene::Mesh& mesh, int index) {
    realtime::MeshBuffers& to = meshes.emplace_back();
    to.mesh = index;
    const std::size_t count = mesh.positions.size();
    // Attributes side by side, or one after the other
    const bool interleaved = index % 2 == 0;
    std::size_t at = interleaved ? grow(count * (84 + 4)) : 0;
    const auto each = [&](gl::VertexSource& source, const auto& values, std::size_t bytes) {
      put(source, values, interleaved ? at : grow(count * bytes), interleaved ? 84 + 4 : bytes);
      at += bytes;
    };
    each(to.normals, mesh.normals, 12);
    each(to.uvs[1], mesh.uvs[1], 8);
    each(to.colors, mesh.colors, 16);
    each(to.positions, mesh.positions, 12);
    each(to.uvs[0], mesh.uvs[0], 8);
    each(to.tangents, mesh.tangents, 16);
    to.indices.type = count <= 256 ? gl::Index::u8 : count <= 65536 ? gl::Index::u16 : gl::Index::u32;
    if (to.indices.type == gl::Index::u8) put_indices<std::uint8_t>(to.indices, mesh);
    if (to.indices.type == gl::Index::u16) put_indices<std::uint16_t>(to.indices, mesh);
    if (to.indices.type == gl::Index::u32) put_indices<std::uint32_t>(to.indices, mesh);
  }

  std::vector<std::byte> bytes_;
  gl::Buffer buffer_;
};

}  // namespace ssphh::test

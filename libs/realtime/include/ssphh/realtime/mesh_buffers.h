#pragma once
/// Meshes that an engine has in OpenGL already, for Renderer's constructor.

#include <array>

#include <ssphh/gl/vertex_array.h>

namespace ssphh::realtime {

/// A mesh of the scene where the engine keeps it, in its own buffers; nothing of it is uploaded. Vertices,
/// triangles and their order are the scene's, whose copy lamps, bounds and methods ask: drawn is what the
/// buffers hold. Each attribute that the scene's mesh has must be given, and no other. Several meshes may lie
/// in one buffer; triangles are left out of shadow maps in runs of 1500 in the engine's order, which should
/// keep together what lies together.
struct MeshBuffers {
  int mesh = 0;                           ///< of scene::Scene::meshes
  gl::VertexSource positions{};           ///< 3 numbers
  gl::VertexSource normals{};             ///< 3 numbers; buffer 0: none, as in what follows
  gl::VertexSource tangents{};            ///< 4 numbers: xyz and handedness
  std::array<gl::VertexSource, 2> uvs{};  ///< 2 numbers
  gl::VertexSource colors{};              ///< 4 numbers, linear
  gl::IndexSource indices{};              ///< 3 for each triangle, counted from the first vertex
};

}  // namespace ssphh::realtime

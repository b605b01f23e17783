#pragma once
/// Meshes of simple bodies, with smooth unit normals and texture coordinates in TEXCOORD_0 (v points down).
/// Triangles are counter-clockwise seen from outside. All bodies are closed: after welding equal positions,
/// every edge is shared by two triangles.

#include <functional>
#include <span>

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Parallelogram corner, corner + u, corner + u + v, corner + v; front toward u × v. Not closed.
Mesh make_quad(const vec3& corner, const vec3& u, const vec3& v);

/// Flat convex or star-shaped polygon from its corners (counter-clockwise from the front) and a triangulation
/// of them; texture coordinates in metres. Not closed.
Mesh make_polygon(std::span<const vec3> corners, std::span<const uvec3> triangles);

/// Axis-parallel box with flat normals: 12 triangles.
Mesh make_box(const vec3& min, const vec3& max);

/// Around the origin, axis y: 2·segments·(rings − 1) triangles, vertices on the sphere. segments ≥ 3, rings
/// ≥ 2.
Mesh make_sphere(float radius, int segments = 64, int rings = 32);

/// Around the y axis through the origin; 2·segments·sides triangles.
Mesh make_torus(float major_radius, float minor_radius, int segments = 96, int sides = 32);

/// Body of revolution about y: `profile` holds (radius, y) from bottom to top, both ends at radius 0. Two
/// equal consecutive points are not allowed; corners sharper than 30° get flat normals on each side.
Mesh make_lathe(std::span<const vec2> profile, int segments = 48);

/// Upright on the plane y = 0.
Mesh make_cylinder(float radius, float height, int segments = 48);
Mesh make_cone(float radius, float height, int segments = 48);

/// Classical column with base, tapered shaft and capital, upright on y = 0.
Mesh make_column(float radius, float height, int segments = 48);

/// Tube of circular section along curve(t), t in [0, 1], in `segments` pieces, with a frame that does not
/// twist (Wang et al., Computation of Rotation Minimizing Frames, 2008). A closed curve has curve(0) =
/// curve(1); an open one gets flat caps.
Mesh make_tube(const std::function<vec3(float)>& curve, bool closed, float radius, int segments, int sides);

/// (p, q) torus knot: p turns around the y axis, q through the hole. Coprime p, q.
Mesh make_torus_knot(int p, int q, float major_radius, float minor_radius, float tube_radius,
                     int segments = 512, int sides = 24);

/// Spiral around the y axis from (radius_bottom, 0, 0) to height `height`, in `turns` turns.
Mesh make_spiral(float radius_bottom, float radius_top, float height, float turns, float tube_radius,
                 int segments = 400, int sides = 20);

/// The same surface seen from the other side: triangles turned, normals negated.
Mesh flipped(Mesh mesh);

/// Positions times `m`, normals and tangents with it; triangles turned when `m` mirrors.
Mesh transformed(Mesh mesh, const mat4& m);

/// Adds the triangles of `part`. Both meshes must have the same optional arrays.
void append(Mesh& mesh, const Mesh& part);

}  // namespace ssphh::scene

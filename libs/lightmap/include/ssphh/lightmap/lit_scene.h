#pragma once
/// A scene whose still surfaces have the coordinates of a lightmap.

#include <ssphh/lightmap/layout.h>
#include <ssphh/scene/scene.h>

namespace ssphh::lightmap {

/// The scene with a mesh of its own for each instance that has charts, whose second texture coordinates lead
/// into the atlas (from its upper left corner), vertices parted at the charts' borders. Meshes without charts
/// have no second coordinates, unless a texture takes them. A texture that took the second set takes the
/// first, where they now are. Triangles without area are left out. Throws Error where charts and layout are
/// not of the scene.
scene::Scene with_lightmap(scene::Scene scene, std::span<const Chart> charts, const Layout& layout);

}  // namespace ssphh::lightmap

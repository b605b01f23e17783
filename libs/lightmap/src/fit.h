#pragma once
/// Whether charts, layouts and scenes belong together, before anything is looked up in them.

#include <span>

#include <ssphh/lightmap/layout.h>
#include <ssphh/scene/scene.h>

namespace ssphh::lightmap {

/// Throws Error for a place that does not lie in an atlas of that size with its gutter.
void require_places(std::span<const PlacedChart> places, int width, int height, const char* where);
/// Throws Error as that, for a scene that scene::check_indices() refuses, and for charts of another one.
void require_fit(const scene::Scene& scene, std::span<const Chart> charts, const Layout& layout,
                 const char* where);

}  // namespace ssphh::lightmap

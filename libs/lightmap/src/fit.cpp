#include "fit.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>

namespace ssphh::lightmap {

void require_places(std::span<const PlacedChart> places, int width, int height, const char* where) {
  require(width > 0 && width <= most_size && height > 0 && height <= most_size, where,
          "the atlas has no size that there can be");
  const glm::ivec2 size(width, height);
  for (const PlacedChart& place : places) {
    require(glm::all(glm::greaterThanEqual(place.first, glm::ivec2(gutter))) &&
                glm::all(glm::greaterThan(place.count, glm::ivec2(0))) &&
                glm::all(glm::lessThanEqual(place.first, size)) &&
                glm::all(glm::lessThanEqual(place.count, size)) &&
                glm::all(glm::lessThanEqual(place.first + place.count + gutter, size)),
            where, "a chart lies outside of the atlas");
    require(!std::isnan(place.scale.x) && !std::isnan(place.scale.y), where, "a chart's scale is no number");
  }
}

void require_fit(const scene::Scene& scene, std::span<const Chart> charts, const Layout& layout,
                 const char* where) {
  scene::check_indices(scene);
  require(charts.size() == layout.places.size(), where, "the layout is of other charts");
  require_places(layout.places, layout.width, layout.height, where);
  for (const Chart& chart : charts) {
    require(chart.instance < scene.instances.size(), where, "the charts are of another scene");
    const std::size_t triangles = scene.meshes[scene.instances[chart.instance].mesh].triangles.size();
    require(std::ranges::all_of(chart.triangles,
                                [&](const FlatTriangle& flat) { return flat.triangle < triangles; }),
            where, "the charts are of another scene");
  }
}

}  // namespace ssphh::lightmap

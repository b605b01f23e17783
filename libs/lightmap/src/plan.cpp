#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/lightmap/plan.h>

#include "coarsen.h"

namespace ssphh::lightmap {

Plan plan_lightmap(scene::Scene scene, float time, const ChartParams& params, const LayoutParams& layout,
                   const Control& control) {
  constexpr float texels_to_distance = 48;
  Charts charts = make_charts(scene, time, params, {}, control);
  if (charts.charts.empty() && !charts.notes.empty())
    throw Error("lightmap", fmt::format("{}", fmt::join(charts.notes, "; ")));
  if (!charts.charts.empty() && !is_dense_enough(charts.charts, layout)) {
    const float near = texels_to_distance / layout.density.value_or(enough_density);
    std::optional<Coarsened> found = coarsen(scene, time, charts.own, near, control);
    Charts wider = found ? make_charts(found->scene, time, params, found->halvings, control) : Charts{};
    // A density that does not fit even so is refused by the charts that the scene has.
    if (found && (!layout.density || is_dense_enough(wider.charts, layout))) {
      charts = std::move(wider);
      charts.notes.push_back(
          fmt::format("texels are up to {} times as wide on {:.4g} m² that are {:g} m or more from all else",
                      1 << found->most_halvings, found->area, 2 * near));
      scene = std::move(found->scene);
    }
  }
  Layout placed = lay_out(charts.charts, layout);
  return {std::move(scene), std::move(charts), std::move(placed)};
}

}  // namespace ssphh::lightmap

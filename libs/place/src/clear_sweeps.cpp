#include <optional>

#include <ssphh/core/parallel.h>
#include <ssphh/place/sweep.h>

#include "draft.h"
#include "relocate.h"

namespace ssphh::place {

void clear_sweeps(const PlaceContext& context, std::vector<Draft>& drafts, PlaceCounts& counts) {
  const Sweep sweep(context.source, context.rules.clearance);
  if (!sweep.any()) return;
  const float clearance = context.rules.clearance;
  std::vector<std::optional<Relocated>> moved(drafts.size());
  std::vector<std::uint8_t> swept(drafts.size(), 0);
  parallel_for(
      drafts.size(), 8,
      [&](std::size_t i) {
        if (drafts[i].kind == PlaceKind::manual || !sweep.passes(drafts[i].position, clearance)) return;
        swept[i] = 1;
        moved[i] = sidestep(context.source, drafts[i].position, context.rules, 0.5f * drafts[i].spacing,
                            [&](const vec3& p) { return !sweep.passes(p, clearance); });
      },
      context.control);

  std::vector<Draft> kept;
  geometry::NearGrid grid(context.spacing);
  const auto keep = [&](const Draft& draft) { grid.add(draft.position), kept.push_back(draft); };
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (swept[i] == 0) keep(drafts[i]);
  }
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (swept[i] == 0) continue;
    const bool useful = moved[i] && grid.near(moved[i]->position, 0.5f * drafts[i].spacing).empty();
    if (!useful) {
      ++counts.swept;
      continue;
    }
    ++counts.relocated;
    drafts[i].position = moved[i]->position;
    drafts[i].site = moved[i]->site;
    keep(drafts[i]);
  }
  drafts = std::move(kept);
}

}  // namespace ssphh::place

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/place/place.h>
#include <ssphh/place/sweep.h>
#include <ssphh/probes/probe_limits.h>

#include "draft.h"
#include "regions.h"
#include "spacing_search.h"

namespace ssphh::place {
namespace {

constexpr float relative_clearance = 0.1f;
constexpr double places_per_probe = 64;  ///< candidates that are looked at before a spacing is refused
constexpr int search_steps = 14;
constexpr std::size_t sparse_places = 48;  ///< for what lies around the regions

[[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) {
  throw Error("probe placement", problem, hint);
}

void check(const PlaceParams& p) {
  if (!(p.spacing >= 0) || !std::isfinite(p.spacing) || p.spacing > probes::limits::coordinate) {
    fail(fmt::format("the spacing must be a number of metres over 0, not {:g}", p.spacing));
  }
  if (p.count < 0) fail(fmt::format("the number of probes must be positive, not {}", p.count));
  if (!(p.clearance > 0) || !std::isfinite(p.clearance)) {
    fail(fmt::format("the clearance must be a number of metres over 0, not {:g}", p.clearance));
  }
  if (p.levels < 0 || p.levels > 3) fail(fmt::format("the levels must be 0..3, not {}", p.levels));
  if (p.max_probes < 1 || static_cast<std::size_t>(p.max_probes) > probes::limits::placed) {
    fail(fmt::format("the largest number of probes must be 1..{}, not {}", probes::limits::placed,
                     p.max_probes));
  }
  if (p.count > p.max_probes) {
    fail(fmt::format("{} probes are more than the {} that are allowed", p.count, p.max_probes),
         "ask for fewer, or raise the limit");
  }
  const auto manual = static_cast<int>(p.manual.size());
  if (p.count > 0 && p.count < manual) {
    fail(fmt::format("{}, and the scene has {} SPHLs of its own, which are kept",
                     counted(p.count, "probe was asked for", "probes were asked for"), manual),
         "ask for more, or use --probes scene");
  }
  for (const scene::ProbePlace& place : p.manual) {
    if (!is_finite(place.position) || !std::isfinite(place.radius) || place.radius <= 0) {
      throw Error("SPHL \"" + place.name + "\"", "its position must be finite and its radius positive");
    }
  }
  for (const vec3& place : p.interest) {
    if (!is_finite(place)) fail("a camera or lamp has a position that is not finite");
  }
}

/// A placement that may still change.
struct Attempt {
  Lattice lattice;
  SiteRules rules;
  std::vector<Draft> drafts;
  std::vector<PlacedEdge> edges;
  PlaceCounts counts;
};

/// A few probes for the open rest around the regions: its light hardly differs from place to place.
std::vector<Draft> sparse_drafts(const rays::TransportSource& source, const PlaceParams& params,
                                 const Regions& regions, const SiteRules& rules, PlaceCounts& counts,
                                 const Control& control) {
  const scene::Bounds bounds = source.part_bounds(0);
  float spacing = max_component(bounds.max - bounds.min);
  const auto places = [&](float s) { return lattice_places(widened(bounds, s), s); };
  while (places(0.9f * spacing) <= double{sparse_places}) spacing *= 0.9f;
  PlaceParams sparse = params;
  sparse.manual.clear();
  sparse.levels = 0;
  const PlaceContext context{source, sparse, control, rules, spacing};
  const Lattice lattice = choose_lattice(source, bounds, spacing, rules, control);
  std::vector<Draft> drafts = grid_drafts(context, lattice, counts);
  counts.redundant += std::erase_if(drafts, [&](const Draft& draft) {
    return std::ranges::any_of(regions.boxes, [&](const auto& box) { return inside(box, draft.position); });
  });
  return drafts;
}

/// None when that would be more candidates or probes than the limits allow.
std::optional<Attempt> attempt(const rays::TransportSource& source, const PlaceParams& params,
                               const Regions& regions, float spacing, float back_limit,
                               const Control& control) {
  double places = 0;
  for (const scene::Bounds& box : regions.boxes) places += lattice_places(widened(box, spacing), spacing);
  if (places > places_per_probe * params.max_probes) return std::nullopt;
  Attempt a;
  a.rules = {std::min(params.clearance, relative_clearance * spacing), back_limit};
  const PlaceContext context{source, params, control, a.rules, spacing};
  PlaceParams others = params;
  others.manual.clear();
  for (const scene::Bounds& region : regions.boxes) {
    const bool first = &region == &regions.boxes[0];
    const Lattice lattice = choose_lattice(source, region, spacing, a.rules, control);
    const PlaceContext own{source, first ? params : others, control, a.rules, spacing};
    std::vector<Draft> drafts = grid_drafts(own, lattice, a.counts);
    if (first) a.lattice = lattice;
    std::ranges::move(drafts, std::back_inserter(a.drafts));
  }
  if (regions.open_rest && params.count == 0)
    std::ranges::move(sparse_drafts(source, params, regions, a.rules, a.counts, control),
                      std::back_inserter(a.drafts));
  // Memory and time for edges are taken only for what may become a placement.
  if (a.drafts.size() > 8 * static_cast<std::size_t>(params.max_probes)) return std::nullopt;
  add_passages(context, a.drafts, link(context, a.drafts), a.counts);
  clear_sweeps(context, a.drafts, a.counts);
  a.edges = link(context, a.drafts);
  if (a.drafts.empty()) return a;
  const std::vector<bool> keep = reachable(context, a.drafts, a.edges);
  a.counts.unreachable = static_cast<std::size_t>(std::ranges::count(keep, false));
  filter(a.drafts, a.edges, keep);
  if (a.drafts.size() > static_cast<std::size_t>(params.max_probes) && params.count == 0) return std::nullopt;
  return a;
}

/// Looks for a spacing that gives low..high probes; else the smallest number over `low`, else the largest
/// there is.
Attempt search(const rays::TransportSource& source, const PlaceParams& params, const Regions& regions,
               std::size_t low, std::size_t high, float back_limit, const Control& control) {
  // Of a box as large as all regions together.
  double volume = 0;
  for (const scene::Bounds& box : regions.boxes) volume += volume_of(box);
  const scene::Bounds& largest = regions.boxes[0];
  const double grown = volume_of(largest) > 0 ? std::cbrt(volume / volume_of(largest)) : 1;
  const vec3 extent = static_cast<float>(grown) * (largest.max - largest.min);
  if (!(max_component(extent) > 0)) fail("the scene's surfaces are a single point");
  const double most_places =
      places_per_probe * std::min(static_cast<double>(high), static_cast<double>(params.max_probes));
  SpacingSearch spacings(extent, low, high, most_places);
  std::optional<Attempt> best;
  for (int step = 0; step < search_steps; ++step) {
    std::optional<Attempt> now = attempt(source, params, regions, spacings.spacing(), back_limit, control);
    const std::size_t count = now ? now->drafts.size() : high + 1;
    if (now && (!best || spacings.prefers(count, best->drafts.size()))) best = std::move(now);
    if (!spacings.go_on(count)) break;
  }
  if (!best)
    fail("the scene has too many places for probes to choose from", "give a spacing, --probes auto:METRES");
  return std::move(*best);
}

Attempt place_in(const rays::TransportSource& source, const PlaceParams& params, const Regions& regions,
                 float back_limit, const Control& control) {
  if (params.spacing > 0) {
    std::optional<Attempt> found = attempt(source, params, regions, params.spacing, back_limit, control);
    if (!found) {
      fail(fmt::format("a spacing of {:g} m gives more than {} probes", params.spacing, params.max_probes),
           "use a larger spacing, or --probes N for a number of probes");
    }
    return std::move(*found);
  }
  std::size_t low = static_cast<std::size_t>(params.count), high = low + low / 5;
  if (params.count == 0) {
    const std::size_t shares = regions.structures, rest = regions.open_rest ? sparse_places : 0;
    const auto most = static_cast<std::size_t>(params.max_probes);
    low = std::min(100 * shares + rest, most);
    high = std::min(200 * shares + rest, most);
  }
  return search(source, params, regions, low, high, back_limit, control);
}

/// The box of a body that fills it, as a crate does, and as much again for what is around the body.
scene::Bounds around(scene::Bounds box) {
  const float margin = 0.5f * max_component(box.max - box.min);
  box.min -= margin, box.max += margin;
  return box;
}

Placement finish(const rays::TransportSource& source, Attempt&& a) {
  Placement placement;
  placement.origin = a.lattice.origin;
  placement.spacing = a.lattice.spacing;
  placement.clearance = a.rules.clearance;
  placement.back_limit = a.rules.back_limit;
  placement.counts = a.counts;
  placement.edges = std::move(a.edges);
  const Sweep sweep(source, a.rules.clearance);
  if (sweep.any()) {
    for (PlacedEdge& edge : placement.edges) {
      edge.moving = sweep.separates(a.drafts[edge.a].position, a.drafts[edge.b].position);
    }
  }
  int number = 0;
  for (Draft& draft : a.drafts) {
    PlacedProbe probe;
    const bool manual = draft.kind == PlaceKind::manual;
    probe.name = manual ? std::move(draft.name) : fmt::format("auto {}", ++number);
    probe.position = draft.position;
    // A tenth of the spacing, and not into a wall.
    probe.radius = manual ? draft.radius : std::min(0.1f * draft.spacing, 0.8f * draft.site.nearest);
    probe.kind = draft.kind;
    probe.spacing = draft.spacing;
    probe.reach = draft.reach;
    probe.clearance = draft.site.nearest;
    placement.probes.push_back(std::move(probe));
  }
  if (a.rules.back_limit >= 1) {
    placement.warnings.emplace_back(
        "cameras, lamps or SPHLs see mostly backs of surfaces, so bodies are not told from rooms; if the "
        "surfaces are wound the wrong way round, turn them");
  }
  return placement;
}

}  // namespace

PlaceParams place_params(const scene::Scene& scene, float time) {
  PlaceParams params;
  params.manual = scene::sphl_places(scene, time);
  for (const scene::ProbePlace& place : params.manual) params.interest.push_back(place.position);
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  const auto add = [&](int node) { params.interest.emplace_back(world[node][3]); };
  for (const scene::Camera& camera : scene.cameras) add(camera.node);
  for (const scene::Light& light : scene.lights) {
    if (light.type != scene::LightType::directional) add(light.node);
  }
  return params;
}

Placement place_probes(const rays::TransportSource& source, const PlaceParams& params,
                       const Control& control) {
  check(params);
  lattice_box(source, 0);  // throws where nothing stands still
  const float back_limit = calibrated_back_limit(source, params.interest);
  const auto placed_in = [&](const Regions& regions) {
    return place_in(source, params, regions, back_limit, control);
  };
  Attempt chosen = placed_in(detail_regions(source, control));
  if (chosen.drafts.empty()) chosen = placed_in({{around(source.part_bounds(0))}});
  if (chosen.drafts.empty()) {
    fail("no place is left that is neither inside a body nor too close to a surface",
         "use a smaller spacing, or place SPHLs by hand");
  }
  if (params.count > 0) {
    const auto count = static_cast<std::size_t>(params.count);
    if (chosen.drafts.size() < count) {
      fail(fmt::format("only {} probes of {} find a place", chosen.drafts.size(), count),
           params.spacing > 0 ? "use a smaller spacing" : "ask for fewer");
    }
    chosen.counts.surplus = chosen.drafts.size() - count;
    filter(chosen.drafts, chosen.edges, most_spread(chosen.drafts, chosen.edges, count));
  }
  return finish(source, std::move(chosen));
}

}  // namespace ssphh::place

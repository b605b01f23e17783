#include "options/place_options.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/counted.h>

#include "results/json_values.h"

namespace ssphh::app {
namespace {

std::size_t count_of(const place::Placement& placement, place::PlaceKind kind) {
  return static_cast<std::size_t>(
      std::ranges::count_if(placement.probes, [&](const auto& probe) { return probe.kind == kind; }));
}

}  // namespace

void add_place_options(Command command, PlaceOptions& options, bool files) {
  const Command placement = command.under("Placement");
  placement
      .option("--probes", options.probes,
              std::string(files ? "A probe file, for its places; or " : "") +
                  "scene: the scene's SPHLs; auto: find places, some 100 to 200; auto:METRES: with this "
                  "spacing; N: the N most spread ones. SPHLs of the scene are kept. Default: scene if it "
                  "has SPHLs, else auto")
      .check(
          [files](const std::string& text) -> std::string {
            if (files && pipeline::is_probe_file({.probes = text})) return {};
            return pipeline::places_problem(text);
          },
          files ? "FILE|scene|auto|auto:METRES|N" : "scene|auto|auto:METRES|N");
  placement.option("--clearance", options.clearance, "Least distance of a placed probe from surfaces [m]")
      .positive();
  placement.option("--refine", options.levels, "Times that the spacing may be halved near surfaces, 0..3")
      .range(0, 3);
  placement
      .option("--max-probes", options.max_probes,
              "Most probes that may be placed; over 65536 are for a folder of tiles (`bake -o NAME.tiles`)")
      .range(1, 1 << 21);
}

json::Value place_json(const PlaceResult& result) {
  const place::Placement& p = result.placement;
  const place::PlaceCounts& c = p.counts;
  const auto moving = std::ranges::count_if(p.edges, [](const auto& edge) { return edge.moving; });
  return {{"probes", p.probes.size()},
          {"manual", count_of(p, place::PlaceKind::manual)},
          {"refined", count_of(p, place::PlaceKind::refined)},
          {"passages", count_of(p, place::PlaceKind::passage)},
          {"spacing", p.spacing},
          {"clearance", p.clearance},
          {"origin", to_json(p.origin)},
          {"candidates", c.candidates},
          {"removed",
           {{"total", c.removed()},
            {"inside", c.inside},
            {"too_close", c.too_close},
            {"open_air", c.open_air},
            {"redundant", c.redundant},
            {"swept", c.swept},
            {"unreachable", c.unreachable},
            {"surplus", c.surplus}}},
          {"relocated", c.relocated},
          {"edges", p.edges.size()},
          {"edges_behind_moving_parts", moving},
          {"warnings", p.warnings},
          {"seconds", result.seconds}};
}

std::string place_text(const PlaceResult& result) {
  const place::Placement& p = result.placement;
  const place::PlaceCounts& c = p.counts;
  return fmt::format(
      "placed {} in {:.2f} s, {:.3g} m apart: {} manual, {} near surfaces, {} in passages; {}\n"
      "of {} {} were removed: {} inside bodies, {} too close to a surface, {} in open air, {} beside "
      "others, {} in a moving part's way, {} out of sight of cameras, lamps and SPHLs, {} more than asked "
      "for; {} moved",
      counted(p.probes.size(), "probe"), result.seconds, p.spacing, count_of(p, place::PlaceKind::manual),
      count_of(p, place::PlaceKind::refined), count_of(p, place::PlaceKind::passage),
      counted(p.edges.size(), "edge"), counted(c.candidates, "place"), c.removed(), c.inside, c.too_close,
      c.open_air, c.redundant, c.swept, c.unreachable, c.surplus, c.relocated);
}

}  // namespace ssphh::app

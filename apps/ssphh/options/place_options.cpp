#include "options/place_options.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/trace/transport_scene.h>

#include "results/json_values.h"

namespace ssphh::app {
namespace {

/// Sets spacing or count. Returns what is wrong with the text; empty: nothing.
std::string parse(const std::string& text, place::PlaceParams& params) {
  constexpr std::string_view prefix = "auto:";
  if (text == "scene" || text == "auto") return {};
  if (text.starts_with(prefix)) {
    const std::string_view metres = std::string_view(text).substr(prefix.size());
    params.spacing = parse_number<float>(metres).value_or(0);
    if (params.spacing > 0) return {};
    return fmt::format("\"{}\" is no spacing: give metres over 0, as in auto:0.7", metres);
  }
  params.count = parse_number<int>(text).value_or(0);
  if (params.count > 0) return {};
  return fmt::format("\"{}\" is none of: scene, auto, auto:METRES, a number of probes over 0", text);
}

std::size_t count_of(const place::Placement& placement, place::PlaceKind kind) {
  return static_cast<std::size_t>(
      std::ranges::count_if(placement.probes, [&](const auto& probe) { return probe.kind == kind; }));
}

}  // namespace

bool is_probe_file(const PlaceOptions& options) {
  return options.probes.ends_with(".sphl") || options.probes.ends_with(".sphl.json");
}

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
            if (files && is_probe_file({.probes = text})) return {};
            place::PlaceParams ignored;
            return parse(text, ignored);
          },
          files ? "FILE|scene|auto|auto:METRES|N" : "scene|auto|auto:METRES|N");
  placement.option("--clearance", options.clearance, "Least distance of a placed probe from surfaces [m]")
      .positive();
  placement.option("--refine", options.levels, "Times that the spacing may be halved near surfaces, 0..3")
      .range(0, 3);
  placement.option("--max-probes", options.max_probes, "Most probes that may be placed").range(1, 65536);
}

std::optional<PlaceResult> place_for(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                     float time, const PlaceOptions& options, const std::string& fallback,
                                     const Control& control) {
  place::PlaceParams params = place::place_params(scene, time);
  std::string probes = options.probes.empty() ? fallback : options.probes;
  if (probes.empty()) {
    probes = params.manual.empty() ? "auto" : "scene";
    if (params.manual.empty()) log_info("the scene has no SPHLs, so --probes auto finds places");
  }
  if (probes == "scene") return std::nullopt;
  parse(probes, params);
  params.clearance = options.clearance;
  params.levels = options.levels;
  params.max_probes = options.max_probes;

  const Stopwatch watch;
  const trace::TransportScene source(geometry, scene);
  PlaceResult result;
  result.placement = place::place_probes(source, params, control);
  result.seconds = watch.seconds();
  for (const std::string& warning : result.placement.warnings) log_warning("{}", warning);
  return result;
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
      "placed {} probes in {:.2f} s, {:.3g} m apart: {} manual, {} near surfaces, {} in passages; {} edges\n"
      "of {} places {} were removed: {} inside bodies, {} too close to a surface, {} in open air, {} beside "
      "others, {} in a moving part's way, {} out of sight of cameras, lamps and SPHLs, {} more than asked "
      "for; {} moved",
      p.probes.size(), result.seconds, p.spacing, count_of(p, place::PlaceKind::manual),
      count_of(p, place::PlaceKind::refined), count_of(p, place::PlaceKind::passage), p.edges.size(),
      c.candidates, c.removed(), c.inside, c.too_close, c.open_air, c.redundant, c.swept, c.unreachable,
      c.surplus, c.relocated);
}

}  // namespace ssphh::app

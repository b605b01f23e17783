#include "quality.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/bake/effort.h>
#include <ssphh/core/require_named.h>

namespace ssphh::viewer {
namespace {

QualityEffort of_bake(bake::Quality quality, const transport::TransportParams& own) {
  const bake::Effort effort = bake::effort_of(quality);
  QualityEffort out{effort.spp, bake::BakeParams{}.face_size, own, effort.records};
  out.transport.directions = effort.directions;
  out.transport.link_rays = effort.link_rays;
  out.transport.surfels_per_radius = effort.surfels_per_radius;
  out.transport.most_surfels = effort.most_surfels;
  return out;
}

std::string count_text(double count) {
  if (count >= 1e6) return fmt::format("{:.1f} million", count / 1e6);
  if (count >= 1e4) return fmt::format("{:.0f} thousand", count / 1e3);
  return fmt::format("{:.0f}", count);
}

/// No line of a narrow panel ends between a number and its unit: the blanks are no-break ones.
std::string time_text(double seconds) {
  if (seconds < 1) return "under a second";
  return seconds < 120 ? fmt::format("some\u00a0{:.0f}\u00a0s", seconds)
                       : fmt::format("some\u00a0{:.0f}\u00a0min", seconds / 60);
}

}  // namespace

QualityEffort effort_of(Quality quality, const transport::TransportParams& own) {
  require_named("quality of the window", quality);
  switch (quality) {
    case Quality::window:
      break;
    case Quality::draft:
      return of_bake(bake::Quality::draft, own);
    case Quality::good:
      return of_bake(bake::Quality::good, own);
    case Quality::best:
      return of_bake(bake::Quality::best, own);
  }
  // For looking at: a twentieth of the work of `ssphh bake`.
  return {8, 20, own, transport::usual_records};
}

std::vector<bake::BakeParams> passes_of(const bake::BakeParams& fine) {
  const auto work = [](const bake::BakeParams& p) { return p.face_size * p.face_size * p.path.spp; };
  bake::BakeParams coarse = fine;
  coarse.face_size = std::max(8, fine.face_size / 2);
  coarse.path.spp = std::max(1, fine.path.spp / 8);
  if (8 * work(coarse) > work(fine)) return {fine};
  return {coarse, fine};
}

double paths_per_probe(const bake::BakeParams& params) {
  double paths = 0;
  for (const bake::BakeParams& pass : passes_of(params))
    paths += 6.0 * pass.face_size * pass.face_size * pass.path.spp;
  return paths;
}

LightCost cost_of(Quality quality, const LightKnown& known) {
  const QualityEffort effort = effort_of(quality, known.transport);
  bake::BakeParams gen;
  gen.path.spp = effort.spp, gen.face_size = effort.face_size;
  const auto probes = static_cast<double>(known.probes);
  LightCost cost;
  cost.paths = paths_per_probe(gen) * std::max(probes, 1.0);
  if (known.probes > 0 && known.paths_per_second > 0) cost.seconds = cost.paths / known.paths_per_second;
  const transport::TransportParams &asked = effort.transport, &made = known.transport;
  cost.surfels = asked.most_surfels;
  if (!(known.surfels > 0)) return cost;
  const double finer = static_cast<double>(asked.surfels_per_radius / made.surfels_per_radius);
  cost.surfels = std::min(known.surfels * finer * finer, std::max<double>(asked.most_surfels, known.surfels));
  const auto rays = [&](double surfels, const transport::TransportParams& p) {
    return surfels * p.link_rays + probes * p.directions;
  };
  cost.bytes = bake::network_bytes(cost.surfels, rays(cost.surfels, asked));
  cost.live_seconds = known.live_seconds * rays(cost.surfels, asked) / rays(known.surfels, made);
  return cost;
}

std::string cost_text(Quality quality, const LightKnown& known) {
  const LightCost cost = cost_of(quality, known);
  std::string text = fmt::format("GEN: {} paths", count_text(cost.paths));
  if (known.probes == 0) text += " a probe";
  if (cost.seconds > 0) text += ", with VIZ " + time_text(cost.seconds);
  text += fmt::format("\nlive: up to {} surfels", count_text(cost.surfels));
  if (cost.bytes > 0) text += fmt::format(", {:.1f}\u00a0GB", cost.bytes / 1e9);
  if (cost.live_seconds > 0) text += ", " + time_text(cost.live_seconds);
  return text;
}

}  // namespace ssphh::viewer

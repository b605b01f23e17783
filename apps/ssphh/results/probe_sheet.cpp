#include "results/probe_sheet.h"

#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/probes/hier.h>

#include "results/light_table.h"

namespace ssphh::app {
namespace {

ProbeSheet sheet_of(const std::vector<LightColumn>& columns, const std::vector<std::string>& names,
                    std::vector<std::string> rows, int width, float exposure) {
  LightTable table = light_table(columns, width, exposure);
  ProbeSheet sheet{{}, std::move(rows), std::move(table.image)};
  for (std::size_t c = 0; c < names.size(); ++c) sheet.columns.push_back({names[c], table.exposures[c]});
  return sheet;
}

const probes::Probe& probe_of(const probes::ProbeSet& set, const std::string& name, std::size_t& index) {
  std::vector<std::string> names;
  for (index = 0; index < set.probes.size(); ++index) {
    if (set.probes[index].name == name) return set.probes[index];
    names.push_back(set.probes[index].name);
  }
  throw Error("--edges " + name, "there is no such probe", nearest_hint(name, names));
}

}  // namespace

ProbeSheet probe_sheet(const probes::ProbeSet& set, int width, float exposure) {
  if (set.probes.empty()) throw Error("probe preview", "the file holds no probes");
  // Self and sum share an exposure, so that they can be compared.
  const std::size_t last = set.hierarchy ? 2 : 0;
  std::vector<LightColumn> columns = {{{}, last}};
  std::vector<std::string> names = {"self"}, rows;
  for (const probes::Probe& probe : set.probes) {
    columns[0].lights.push_back(&probe.self);
    rows.push_back(probe.name);
  }
  if (set.hierarchy) {
    columns.insert(columns.end(), {{{}, 1}, {{}, last}});
    names.insert(names.end(), {"neighbour", "sum"});
    for (const sh::RadianceSh& light : set.hierarchy->neighbor) columns[1].lights.push_back(&light);
    for (const sh::RadianceSh& light : set.hierarchy->sum) columns[2].lights.push_back(&light);
  }
  return sheet_of(columns, names, std::move(rows), width, exposure);
}

ProbeSheet edge_sheet(const probes::ProbeSet& set, const std::string& name, int width, float exposure) {
  std::size_t index = 0;
  const probes::Probe& probe = probe_of(set, name, index);
  if (!set.hierarchy)
    throw Error("--edges " + name, "the file holds no hierarchy", "run `ssphh hier` on it first");
  const probes::Hierarchy& h = *set.hierarchy;
  const std::vector<int> order = probes::select_neighbors(probe, {h.op, h.neighbors, h.threshold});
  if (order.empty()) throw Error("--edges " + name, "HIER took none of the probe's neighbours");

  std::vector<sh::RadianceSh> products, sums;
  for (const int e : order) {
    const probes::Edge& edge = probe.edges[e];
    sh::RadianceSh product(set.degree);
    probes::add_neighbor(product, edge, set.probes[edge.from].self, h.op);
    sums.push_back(sums.empty() ? probe.self : sums.back());
    sums.back() += product;
    products.push_back(std::move(product));
  }
  sums.back() = h.sum[index];  // added up in HIER's order, to the bit

  constexpr std::size_t sum = 4;
  std::vector<LightColumn> columns = {{{}, sum}, {{}, 1}, {{}, sum}, {{}, 3}, {{}, sum}};
  std::vector<std::string> rows;
  for (std::size_t r = 0; r < order.size(); ++r) {
    const probes::Edge& edge = probe.edges[order[r]];
    const probes::Probe& from = set.probes[edge.from];
    const sh::RadianceSh* lights[] = {&probe.self, &edge.h, &from.self, &products[r], &sums[r]};
    const bool last = r + 1 == order.size();
    const std::string labels[] = {
        "S of " + name, fmt::format("H {} > {}, P {:.3g}", from.name, name, edge.transfer),
        "S of " + from.name, "H x S of " + from.name,
        last ? "S' of " + name : fmt::format("S + {} of {} products", r + 1, order.size())};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      columns[c].lights.push_back(lights[c]);
      columns[c].labels.push_back(labels[c]);
    }
    rows.push_back(from.name);
  }
  return sheet_of(columns, {"self", "response", "neighbour", "product", "sum"}, std::move(rows), width,
                  exposure);
}

}  // namespace ssphh::app

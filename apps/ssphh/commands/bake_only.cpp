#include "commands/bake_only.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/scene/query.h>

namespace ssphh::app {
namespace {

/// "7" or "12-19".
void add_range(std::string_view text, const BakeOnly& only, std::size_t count,
               std::set<std::uint32_t>& which) {
  const std::string option = "--only-probes " + only.probes;
  const std::size_t dash = std::min(text.find('-'), text.size());
  const auto first = parse_number<std::uint32_t>(text.substr(0, dash));
  const auto last = dash < text.size() ? parse_number<std::uint32_t>(text.substr(dash + 1)) : first;
  if (!first || !last || *last < *first)
    throw Error(option, fmt::format("\"{}\" is no index and no range of them", text),
                "it is a list like 3,7,12-19");
  if (*last >= count)
    throw Error(option, fmt::format("there is no probe {}: they are numbered 0 to {}", *last, count - 1));
  for (std::uint32_t i = *first; i <= *last; ++i) which.insert(which.end(), i);
}

std::vector<std::uint32_t> listed(const BakeOnly& only, std::size_t count) {
  std::set<std::uint32_t> which;
  const std::string_view text = only.probes;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    add_range(text.substr(at, comma - at), only, count, which);
    at = comma + 1;
  }
  return {which.begin(), which.end()};
}

std::vector<std::uint32_t> within(const std::vector<float>& b, const probes::ProbeSet& set) {
  const std::string option = fmt::format("--only-box {},{},{},{},{},{}", b[0], b[1], b[2], b[3], b[4], b[5]);
  const scene::Bounds box{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  if (!glm::all(glm::lessThan(box.min, box.max)))
    throw Error(option, "it is no box", "it is x0,y0,z0,x1,y1,z1, the lower corner first");
  std::vector<std::uint32_t> which;
  scene::Bounds all;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const vec3& p = set.probes[i].position;
    all.add(p);
    if (glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max)))
      which.push_back(static_cast<std::uint32_t>(i));
  }
  if (which.empty())
    throw Error(option, "no probe stands in it",
                fmt::format("the probes stand in {:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g}", all.min.x,
                            all.min.y, all.min.z, all.max.x, all.max.y, all.max.z));
  return which;
}

std::vector<std::uint32_t> named(const std::vector<std::string>& lights, const probes::ProbeSet& set) {
  std::vector<std::string> names;
  for (const probes::LightGroup& group : set.light_groups) names.push_back(group.name);
  std::set<std::uint32_t> which;
  for (const std::string& light : lights) {
    const auto found = std::ranges::find(names, light);
    if (found == names.end())
      throw Error("--only-lights " + light, "the scene has no light group of this name",
                  nearest_hint(light, names));
    which.insert(static_cast<std::uint32_t>(found - names.begin()));
  }
  return {which.begin(), which.end()};
}

}  // namespace

void add_only_options(const Command& command, BakeOnly& only) {
  const Option probes =
      command.option("--only-probes", only.probes,
                     "3,7,12-19: bake these probes, numbered from 0 as `probe info` lists them, and the "
                     "surface records nearest to them, whatever has changed; all others keep their bits");
  command
      .option("--only-box", only.box, "x0,y0,z0,x1,y1,z1: the same for the probes that stand in this box [m]")
      .separated_by(',')
      .values(6)
      .excludes(probes);
  command
      .option("--only-lights", only.lights,
              "GROUP[,...]: bake the light of these light groups alone; that of the others keeps its bits")
      .separated_by(',');
}

bake::LightScope light_scope(const BakeOnly& only, const probes::ProbeSet& set) {
  bake::LightScope scope;
  if (!only.probes.empty()) scope.probes = listed(only, set.probes.size());
  if (!only.box.empty()) scope.probes = within(only.box, set);
  if (!only.lights.empty()) scope.groups = named(only.lights, set);
  return scope;
}

}  // namespace ssphh::app

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/probe_export/target.h>

namespace ssphh::probe_export {

probes::ProbeSet only_group(probes::ProbeSet set, const std::string& group) {
  std::vector<std::string> known;
  for (const probes::LightGroup& g : set.light_groups) known.push_back(g.name);
  if (std::ranges::find(known, group) == known.end()) throw Error("light group", none_of(group, known));
  if (set.hierarchy)
    throw Error("light group " + group, "the set has a hierarchy, which holds the sum of all groups",
                "export the file from before `ssphh hier`");
  for (probes::LightGroup& g : set.light_groups)
    if (g.name != group) g.scale = vec3(0);
  probes::merge_groups(set);
  return set;
}

std::vector<std::string> lost(const probes::ProbeSet& set, const Target& target, bool posed) {
  std::vector<std::string> lines;
  const auto say = [&](bool whether, std::string line) {
    if (whether) lines.push_back(std::move(line));
  };
  say(set.degree > target.degree,
      fmt::format("bands {} to {} of the probes' light", target.degree + 1, set.degree));
  std::vector<std::string> groups;
  for (const probes::LightGroup& g : set.light_groups) {
    if (g.scale != vec3(0)) groups.push_back(g.name);
  }
  say(groups.size() > 1, fmt::format("light groups apart: {} are summed", fmt::join(groups, ", ")));
  const std::vector<std::string> baked = probes::baked_groups(set);
  say(!baked.empty(),
      fmt::format("direct light of baked groups is within ({}): switch their lamps off in the "
                  "engine",
                  fmt::join(baked, ", ")));
  say(set.surface && !set.surface->points.empty(),
      counted(set.surface ? set.surface->points.size() : 0, "surface record") +
          ": still surfaces get the probes' light");
  say(set.fitted.has_value(), "fitted weights of surface points");
  say(probes::edge_count(set) > 0,
      counted(probes::edge_count(set), "edge between probes", "edges between probes"));
  say(set.hierarchy.has_value(), "the hierarchy apart: neighbours' light is in the sum");
  say(!posed, fmt::format("other poses than that at {:g} s", set.generator.time));
  say(!target.hides, "visibility: the engine does not ask what stands between a point and what lights it");
  return lines;
}

}  // namespace ssphh::probe_export

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/gi/methods/table.h>

#include "entries.h"

namespace ssphh::gi {

std::span<const MethodEntry> method_table() {
  static const std::vector<MethodEntry> table = {
      methods::direct_entry(), methods::ambient_entry(),
      methods::ssphh_entry(),  methods::irradiance_volume_entry(),
      methods::prt_entry(),    methods::vpl_entry(),
      methods::vct_entry(),    methods::ddgi_entry(),
  };
  return table;
}

const MethodEntry& find_method(const std::string& name) {
  std::string names;
  for (const MethodEntry& entry : method_table()) {
    if (name == entry.name) return entry;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  }
  throw Error("method " + name, "there is no such method", "choose one of " + names);
}

std::vector<mat4> part_poses(const scene::TransportSource& source, float time) {
  std::vector<mat4> poses;
  for (int part = 0; part < source.part_count(); ++part) poses.push_back(source.part_pose(part, time));
  return poses;
}

}  // namespace ssphh::gi

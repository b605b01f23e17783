#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/methods/method_list.h>

namespace ssphh::methods {

std::span<const MethodEntry> all_methods() {
  static const std::vector<MethodEntry> methods = method_entries();
  return methods;
}

const MethodEntry& find_method(const std::string& name) {
  std::string names;
  for (const MethodEntry& entry : all_methods()) {
    if (name == entry.name) return entry;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  }
  throw Error("method " + name, "there is no such method", "choose one of " + names);
}

std::vector<mat4> part_poses(const rays::TransportSource& source, float time) {
  std::vector<mat4> poses;
  for (int part = 0; part < source.part_count(); ++part) poses.push_back(source.part_pose(part, time));
  return poses;
}

}  // namespace ssphh::methods

#pragma once
/// All methods. To add one: a folder under src/methods/, a line in table.cpp, a page in docs/methods/.

#include <memory>
#include <span>
#include <string>

#include <ssphh/gi/methods/method.h>
#include <ssphh/gi/methods/parameters.h>

namespace ssphh::gi {

struct MethodEntry {
  const char* name;
  const char* about;  ///< one line
  std::vector<MethodParameter> parameters;
  /// Bakes whatever the method keeps for all frames. Throws Error for a scene that the method cannot do.
  std::unique_ptr<Method> (*make)(const MethodScene& scene, const MethodParameters& parameters,
                                  const Control& control);
  bool has_light_data = false;  ///< Method::light_data() gives some: OpenGL can draw it
};

std::span<const MethodEntry> method_table();

/// Throws Error with the names that there are.
const MethodEntry& find_method(const std::string& name);

}  // namespace ssphh::gi

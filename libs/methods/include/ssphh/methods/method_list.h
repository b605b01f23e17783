#pragma once
/// All methods. To add one: a folder beside src/ whose namespace has `MethodEntry entry()`, as
/// examples/toy_method does outside of the tree of libs/.

#include <memory>
#include <span>
#include <string>

#include <ssphh/methods/method.h>
#include <ssphh/methods/parameters.h>

namespace ssphh::methods {

/// What is known of a method before it is made.
struct MethodEntry {
  const char* name;
  const char* about;  ///< what it does, in one line
  std::vector<MethodParameter> parameters;
  /// Bakes whatever the method keeps for all frames. Throws Error for a scene that the method cannot do.
  std::unique_ptr<Method> (*make)(const MethodScene& scene, const MethodParameters& parameters,
                                  const Control& control);
  bool has_light_data = false;         ///< Method::light_data() gives some: OpenGL can draw it
  std::vector<Drawing> drawings = {};  ///< of what Method::drawing() gives marks
};

/// Makes the list of what entry() of each method's folder says; written by CMake (ssphh_method_entries).
std::vector<MethodEntry> method_entries();

/// The same list, made once for the whole program.
std::span<const MethodEntry> all_methods();

/// The method of that name. Throws Error with the names that there are where none has it.
const MethodEntry& find_method(const std::string& name);

}  // namespace ssphh::methods

#pragma once
/// A script's input on its way to ImGui.

#include "window.h"

namespace ssphh::viewer {

class Injection {
 public:
  /// Gives the input to the current ImGui context before its next frame; keys of the frame before are let go.
  void apply(const InjectedInput& input);

 private:
  std::vector<int> held_keys_;
};

/// GLFW's number of a key by its name: "f1", "h", "escape", "space", "left"; none for an unknown one.
std::optional<int> key_by_name(const std::string& name);

}  // namespace ssphh::viewer

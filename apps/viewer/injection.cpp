#include "injection.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace ssphh::viewer {

void Injection::apply(const InjectedInput& injected) {
  ImGuiIO& io = ImGui::GetIO();
  for (const int key : held_keys_) io.KeysDown[key] = false;
  // Modifiers are let go with the keys they were held for.
  if (!injected.keys.empty() || !held_keys_.empty()) io.KeyCtrl = injected.ctrl, io.KeyShift = injected.shift;
  held_keys_ = injected.keys;
  for (const int key : held_keys_) io.KeysDown[key] = true;
  if (injected.mouse) {
    io.MousePos = {(*injected.mouse)[0], (*injected.mouse)[1]};
    for (std::size_t b = 0; b < injected.buttons.size(); ++b) io.MouseDown[b] = injected.buttons[b];
  }
}

std::optional<int> key_by_name(const std::string& name) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::pair<const char*, int> named[] = {{"escape", GLFW_KEY_ESCAPE}, {"space", GLFW_KEY_SPACE},
                                                      {"tab", GLFW_KEY_TAB},       {"enter", GLFW_KEY_ENTER},
                                                      {"delete", GLFW_KEY_DELETE}, {"left", GLFW_KEY_LEFT},
                                                      {"right", GLFW_KEY_RIGHT},   {"up", GLFW_KEY_UP},
                                                      {"down", GLFW_KEY_DOWN},     {"home", GLFW_KEY_HOME}};
  for (const auto& [text, key] : named) {
    if (lower == text) return key;
  }
  if (lower.size() == 1 && std::isalnum(static_cast<unsigned char>(lower[0])))
    return std::toupper(static_cast<unsigned char>(lower[0]));  // GLFW's letters and digits are ASCII.
  if (lower.size() >= 2 && lower.size() <= 3 && lower[0] == 'f') {
    const int number = std::atoi(lower.c_str() + 1);
    if (number >= 1 && number <= 12) return GLFW_KEY_F1 + number - 1;
  }
  return {};
}

}  // namespace ssphh::viewer

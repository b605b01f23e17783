#pragma once
/// A GLFW window with OpenGL 4.5 core and Dear ImGui; nothing of this project's scenes or light.

#include <array>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace ssphh::viewer {

/// Input that a script gives in place of the user's.
struct InjectedInput {
  std::optional<std::array<float, 2>> mouse;  ///< pixels from the upper left; kept until it is none
  std::array<bool, 3> buttons{};              ///< left, right, middle
  std::vector<int> keys;                      ///< GLFW's numbers, held in the next frame
  bool ctrl = false, shift = false;
};

class Window {
 public:
  /// Throws Error when there is no display or no OpenGL 4.5. The context is current afterwards.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool should_close() const;
  void close();
  void set_title(const std::string& title);

  /// Handles what the user did. Waits up to `timeout` seconds for that; 0: not at all.
  void events(double timeout);
  /// Since the last call: whether anything happened that may change what is shown.
  bool take_input();
  /// Files dropped on the window since the last call.
  std::vector<std::string> take_dropped();

  /// Pixels of the frame buffer.
  int width() const { return width_; }
  int height() const { return height_; }

  /// From here to end_frame() ImGui's functions may be called.
  void begin_frame(const InjectedInput& injected);
  /// Draws the user interface over what is in the frame buffer.
  void end_frame();
  void show_frame();

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  int width_ = 0, height_ = 0;
  bool input_ = true;
  std::vector<std::string> dropped_;
  std::vector<int> held_keys_;  ///< injected into the last frame
};

/// GLFW's number of a key by its name: "f1", "h", "escape", "space", "left"; none for an unknown one.
std::optional<int> key_by_name(const std::string& name);

}  // namespace ssphh::viewer

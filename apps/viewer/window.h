#pragma once
/// A window with Dear ImGui in it, and input that a script gives in place of the user's.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/image/io.h>

namespace ssphh::viewer {

/// Input that a script gives in place of the user's.
struct InjectedInput {
  std::optional<std::array<float, 2>> mouse;  ///< pixels from the upper left; kept until it is none
  std::array<bool, 3> buttons{};              ///< left, right, middle
  std::vector<int> keys;                      ///< GLFW's numbers, held in the next frame
  bool ctrl = false, shift = false;
};

/// What the viewer asks of a window: a test stands in for one without a display.
class Window {
 public:
  Window() = default;
  virtual ~Window() = default;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  virtual bool should_close() const = 0;
  virtual void close() = 0;
  /// Takes close(), or what the user did for it, back.
  virtual void keep_open() = 0;
  virtual void set_title(const std::string& title) = 0;

  /// Handles what the user did. Waits up to `timeout` seconds for that; 0: not at all.
  virtual void events(double timeout) = 0;
  /// Since the last call: whether anything happened that may change what is shown.
  virtual bool take_input() = 0;
  /// Files dropped on the window since the last call.
  virtual std::vector<std::string> take_dropped() = 0;

  /// Pixels of the frame buffer.
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// OpenGL's name of what draws.
  virtual std::string renderer() const = 0;
  /// Since some moment that stays the same.
  virtual double seconds() const = 0;

  /// From here to end_frame() ImGui's functions may be called.
  virtual void begin_frame(const InjectedInput& injected) = 0;
  /// Draws the user interface into the frame buffer.
  virtual void end_frame() = 0;
  /// What end_frame() has drawn, row 0 on top.
  virtual image::Rgba8 read_frame() const = 0;
  virtual void show_frame() = 0;
};

}  // namespace ssphh::viewer

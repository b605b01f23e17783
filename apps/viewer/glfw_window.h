#pragma once
/// A GLFW window with OpenGL 4.5 core and Dear ImGui; nothing of this project's scenes or light.

#include "injection.h"
#include "input_queue.h"
#include "window.h"

struct GLFWwindow;

namespace ssphh::viewer {

class GlfwWindow : public Window {
 public:
  /// Throws Error when there is no display or no OpenGL 4.5. The context is current afterwards.
  GlfwWindow(const std::string& title, int width, int height);
  ~GlfwWindow() override;

  bool should_close() const override;
  void close() override;
  void keep_open() override;
  void set_title(const std::string& title) override;
  void events(double timeout) override;
  bool take_input() override;
  std::vector<std::string> take_dropped() override;
  int width() const override { return width_; }
  int height() const override { return height_; }
  std::string renderer() const override;
  double seconds() const override;
  void begin_frame(const InjectedInput& injected) override;
  void end_frame() override;
  image::Rgba8 read_frame() const override;
  void show_frame() override;

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  int width_ = 0, height_ = 0;
  bool input_ = true;
  std::vector<std::string> dropped_;
  InputQueue queue_;
  Injection injection_;
};

}  // namespace ssphh::viewer

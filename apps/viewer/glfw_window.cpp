#include "glfw_window.h"

#include <algorithm>
#include <utility>

// Includes OpenGL's headers otherwise, which belong to the module gl.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <ssphh/core/error.h>
#include <ssphh/gl/context.h>
#include <ssphh/gl/framebuffer.h>

#include "style.h"

namespace ssphh::viewer {
namespace {

std::string glfw_error;

void on_error(int, const char* message) {
  glfw_error = message;
}

[[noreturn]] void no_window(const std::string& problem) {
  const std::string reason = glfw_error.empty() ? "" : ": " + glfw_error;
  throw Error("view", problem + reason,
              "the viewer needs a display with OpenGL 4.5; on a machine without one, run it under xvfb-run, "
              "or draw pictures with `ssphh render`");
}

}  // namespace

/// What GLFW calls; it finds the window by its user pointer.
struct GlfwWindow::Callbacks {
  static GlfwWindow& of(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
  }

  static void install(GLFWwindow* window) {
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
      of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + count);
      of(w).input_ = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).input_ = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).input_ = true; });
    // A repeat is no event, but a key that is held may do something in a new frame.
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
      if (action != GLFW_REPEAT) of(w).queue_.key(key, action == GLFW_PRESS);
      of(w).input_ = true;
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) { of(w).queue_.character(code); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
      of(w).queue_.wheel(static_cast<float>(x), static_cast<float>(y));
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
      of(w).queue_.button(button, action == GLFW_PRESS);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
      of(w).queue_.mouse(static_cast<float>(x), static_cast<float>(y));
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
      ImGui_ImplGlfw_CursorEnterCallback(w, entered);
      of(w).input_ = true;
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
      ImGui_ImplGlfw_WindowFocusCallback(w, focused);
      of(w).input_ = true;
    });
  }
};

GlfwWindow::GlfwWindow(const std::string& title, int width, int height) {
  glfwSetErrorCallback(on_error);
  if (!glfwInit()) no_window("there is no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  // No larger than the screen.
  int x = 0, y = 0, most_wide = 0, most_high = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
    glfwGetMonitorWorkarea(monitor, &x, &y, &most_wide, &most_high);
  if (most_wide > 0 && most_high > 0)
    width = std::min(width, most_wide), height = std::min(height, most_high);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    no_window("cannot open a window with OpenGL 4.5");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // No file is left behind in the user's folder.
  float x_scale = 1, y_scale = 1;
  glfwGetWindowContentScale(window_, &x_scale, &y_scale);
  const float scale = std::max(x_scale, 1.0f);
  load_font(scale);
  apply_look(scale);
  ImGui_ImplGlfw_InitForOpenGL(window_, false);
  ImGui_ImplOpenGL3_Init("#version 450");
  Callbacks::install(window_);
  glfwGetFramebufferSize(window_, &width_, &height_);
}

GlfwWindow::~GlfwWindow() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool GlfwWindow::should_close() const {
  return glfwWindowShouldClose(window_);
}

void GlfwWindow::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void GlfwWindow::keep_open() {
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

void GlfwWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void GlfwWindow::events(double timeout) {
  if (timeout > 0) {
    glfwWaitEventsTimeout(timeout);
  } else {
    glfwPollEvents();
  }
  glfwGetFramebufferSize(window_, &width_, &height_);
}

std::string GlfwWindow::renderer() const {
  return gl::Context::adopt_current().info().renderer;
}

double GlfwWindow::seconds() const {
  return glfwGetTime();
}

bool GlfwWindow::take_input() {
  // What waits in the queue needs frames as what is new does.
  return std::exchange(input_, false) || !queue_.empty();
}

std::vector<std::string> GlfwWindow::take_dropped() {
  return std::exchange(dropped_, {});
}

void GlfwWindow::begin_frame(const InjectedInput& injected) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  queue_.give(ImGui::GetIO());
  injection_.apply(injected);
  ImGui::NewFrame();
}

void GlfwWindow::end_frame() {
  const gl::Rect whole{0, 0, width_, height_};
  gl::bind_framebuffer(0, whole);
  gl::clear_color(0, 0.07f, 0.07f, 0.075f, 1);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

image::Rgba8 GlfwWindow::read_frame() const {
  return {width_, height_, gl::read_pixels(0, {0, 0, width_, height_})};
}

void GlfwWindow::show_frame() {
  glfwSwapBuffers(window_);
}

}  // namespace ssphh::viewer

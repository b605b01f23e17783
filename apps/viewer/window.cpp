#include "window.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

// Includes OpenGL's headers otherwise, which belong to the module gl.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <ssphh/core/error.h>

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
struct Window::Callbacks {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

  static void install(GLFWwindow* window) {
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
      of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + count);
      of(w).input_ = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).input_ = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).input_ = true; });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int, int, int, int) { of(w).input_ = true; });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { of(w).input_ = true; });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { of(w).input_ = true; });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { of(w).input_ = true; });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { of(w).input_ = true; });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { of(w).input_ = true; });
  }
};

Window::Window(const std::string& title, int width, int height) {
  glfwSetErrorCallback(on_error);
  if (!glfwInit()) no_window("there is no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    no_window("cannot open a window with OpenGL 4.5");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  Callbacks::install(window_);

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // No file is left behind in the user's folder.
  float x_scale = 1, y_scale = 1;
  glfwGetWindowContentScale(window_, &x_scale, &y_scale);
  apply_style(std::max(x_scale, 1.0f));
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // Keeps our callbacks and calls them.
  ImGui_ImplOpenGL3_Init("#version 450");
  glfwGetFramebufferSize(window_, &width_, &height_);
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::should_close() const {
  return glfwWindowShouldClose(window_);
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::events(double timeout) {
  if (timeout > 0) {
    glfwWaitEventsTimeout(timeout);
  } else {
    glfwPollEvents();
  }
  glfwGetFramebufferSize(window_, &width_, &height_);
}

bool Window::take_input() {
  return std::exchange(input_, false);
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(dropped_, {});
}

void Window::begin_frame(const InjectedInput& injected) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  for (const int key : held_keys_) io.KeysDown[key] = false;
  held_keys_ = injected.keys;
  for (const int key : held_keys_) io.KeysDown[key] = true;
  if (injected.mouse) {
    io.MousePos = {(*injected.mouse)[0], (*injected.mouse)[1]};
    for (std::size_t b = 0; b < injected.buttons.size(); ++b) io.MouseDown[b] = injected.buttons[b];
  }
  if (!injected.keys.empty()) io.KeyCtrl = injected.ctrl, io.KeyShift = injected.shift;
  ImGui::NewFrame();
}

void Window::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show_frame() {
  glfwSwapBuffers(window_);
}

std::optional<int> key_by_name(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
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

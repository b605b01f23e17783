#pragma once
/// The viewer's App in a window that nobody sees: ImGui without a display, OpenGL without a window, a clock
/// that stands still until a test moves it.

#include <cmath>
#include <filesystem>
#include <optional>
#include <thread>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <ssphh/scene/builtin.h>

#include "app.h"
#include "injection.h"
#include "input.h"
#include "input_queue.h"
#include "model/framing.h"
#include "model/pick.h"
#include "overlay.h"
#include "panels/panels.h"
#include "style.h"
#include "temp_dir.h"

namespace ssphh::viewer {

/// ImGui's own font, so that what is drawn does not depend on the fonts of a machine; with a scale that of a
/// screen so dense.
class StillWindow : public Window {
 public:
  StillWindow(int width, int height, float scale = 0) : width_(width), height_(height) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    if (scale > 0) load_font(scale);
    ImGui::GetIO().Fonts->Build();
    // What ImGui itself does with keys while text is typed, as ImGui_ImplGlfw tells it.
    constexpr std::pair<int, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                            {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                            {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                            {ImGuiKey_Escape, GLFW_KEY_ESCAPE}};
    for (const auto& [key, number] : keys) ImGui::GetIO().KeyMap[key] = number;
    apply_look(scale > 0 ? scale : 1);
  }
  ~StillWindow() override { ImGui::DestroyContext(); }

  bool should_close() const override { return closed; }
  void close() override { closed = true; }
  void keep_open() override { closed = false; }
  void set_title(const std::string& text) override { title = text; }
  void events(double timeout) override { waits.push_back(timeout), clock += timeout; }
  bool take_input() override { return std::exchange(touched, false) || !queue.empty(); }
  std::vector<std::string> take_dropped() override { return std::exchange(dropped, {}); }
  int width() const override { return width_; }
  int height() const override { return height_; }
  std::string renderer() const override { return "nothing"; }
  double seconds() const override { return clock += tick; }
  void begin_frame(const InjectedInput& input) override {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
    io.DeltaTime = 0.2f;  // No click follows another so soon that both are a double one.
    queue.give(io);
    injection_.apply(input);
    if (wheel != 0) io.MouseWheel = std::exchange(wheel, 0.0f);
    for (const char c : typed) io.AddInputCharacter(static_cast<unsigned char>(c));
    typed.clear();
    ImGui::NewFrame();
  }
  void end_frame() override { ImGui::Render(); }
  image::Rgba8 read_frame() const override { return {2, 1, {1, 2, 3, 255, 4, 5, 6, 255}}; }
  void show_frame() override { ++frames; }

  bool closed = false, touched = false;
  InputQueue queue;
  std::string title, typed;
  float wheel = 0;
  int frames = 0;
  std::vector<std::string> dropped;
  std::vector<double> waits;
  mutable double clock = 100;
  double tick = 0;  ///< seconds from one look at the clock to the next

 private:
  int width_, height_;
  Injection injection_;
};

/// Scenes and panels without OpenGL: what the real-time picture would show is left out.
class AppStage : public testing::Test {
 protected:
  AppStage() {
    std::filesystem::current_path(dir_.path());
    load_ = [](const std::string& source) {
      return scene::make_builtin(source.substr(source.find(':') + 1));
    };
  }
  ~AppStage() override {
    app_.reset();
    window_.reset();
    std::filesystem::current_path(before_);
  }

  /// An App without a scene.
  App& start(int width, int height, float scale = 0) {
    app_.reset();
    window_.reset();
    window_.emplace(width, height, scale);
    app_.emplace(
        *window_, options_, [this](const std::string& source) { return load_(source); }, show_);
    return *app_;
  }
  App& app() { return *app_; }
  Document document(const std::string& name) {
    return make_document("builtin:" + name, scene::make_builtin(name), 0);
  }

  /// A frame as App::turn() has it, without the picture of the scene.
  void frame(const InjectedInput& input = {}, float seconds = 0) {
    window_->begin_frame(input);
    handle_input(*app_, seconds);
    draw_panels(*app_);
    if (app_->scene_open()) draw_overlay(*app_, visible_);
    window_->end_frame();
  }
  /// A whole turn of App, which has no scene open or OpenGL to draw it.
  double turn(const InjectedInput& input = {}) {
    app_->redraw();
    return app_->turn(input);
  }
  /// Waits until nothing is under way in the background, and takes it over.
  void finish_work() {
    while (!app_->job.idle() || !app_->job.status().error.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      app_->take_work();
    }
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  void press(std::vector<int> keys, bool ctrl = false, bool shift = false) {
    InjectedInput input;
    input.keys = std::move(keys), input.ctrl = ctrl, input.shift = shift;
    frame(input), frame();
  }
  /// The mouse at a point with these buttons held.
  void mouse(float x, float y, std::array<bool, 3> buttons = {}) {
    InjectedInput input;
    input.mouse = {x, y}, input.buttons = buttons;
    frame(input);
  }
  void click(float x, float y, int button = 0) { drag(x, y, x, y, button); }
  void drag(float x, float y, float to_x, float to_y, int button = 0) {
    std::array<bool, 3> down{};
    down[button] = true;
    mouse(x, y), mouse(x, y), mouse(x, y, down), mouse(to_x, to_y, down), mouse(to_x, to_y), frame();
  }

  /// `before` as a drag from one point of the picture to another leaves it: turned about what stands under
  /// the first.
  View orbited_by(const View& before, const vec2& from, const vec2& to) const {
    const Rect2& r = app_->viewport;
    const vec2 point((from.x - r.x) / r.width, 1 - (from.y - r.y) / r.height);
    const auto surface =
        pick_surface(*app_->picking(), app_->document.time, pixel_ray(before, point, r.aspect()));
    const vec2 turn = -0.005f * (to - from);
    return surface ? orbited_within(before, surface->position, turn.x, turn.y, posed())
                   : orbited(before, turn.x, turn.y);
  }
  rays::PosedWorld posed() const { return {*app_->picking(), app_->document.time}; }

  test::TempDir dir_;
  std::filesystem::path before_ = std::filesystem::current_path();
  ViewerOptions options_;
  LoadScene load_;
  ShowElsewhere show_;
  std::optional<StillWindow> window_;
  std::optional<App> app_;
  std::vector<unsigned char> visible_;
};

}  // namespace ssphh::viewer

#pragma once
/// An App that draws, in a context without a window.

#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "app_stage.h"
#include "gl_context.h"
#include "script_player.h"

namespace ssphh::viewer {

/// Skips where there is no OpenGL.
class GlStage : public AppStage {
 protected:
  void SetUp() override {
    try {
      context_.emplace(gl::Context::headless());
    } catch (const Error& e) {
      GTEST_SKIP() << e.what();
    }
    options_.panels = false;
    prepare();
    start(size_.x, size_.y);
    ready();
  }
  void TearDown() override { app_.reset(); }

  bool software() const { return context_->info().software; }

  glm::ivec2 size_{64, 48};  ///< of the window, pixels

  /// Sets options, and the size, before the App starts.
  virtual void prepare() = 0;
  /// After it has.
  virtual void ready() = 0;

  /// Turns until `done`, however slow the machine is; a minute is too long.
  template <class Done, class Turn>
  bool turn_until(const Done& done, const Turn& one) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return false;
      window_->clock += 0.05;
      one();
      if (app().job.running() || app().reference.status().running)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  /// The script, until all that it asked for has settled.
  void play(const std::string& text) {
    ScriptPlayer player(parse_script(text + "\nsettle", "script"));
    turn_until([&] { return player.done(); }, [&] { app().turn(player.next(app())); });
    EXPECT_TRUE(player.done()) << text;
  }

 private:
  std::optional<gl::Context> context_;
};

}  // namespace ssphh::viewer

#pragma once
/// An App that draws, in a context without a window.

#include <optional>

#include "app_stage.h"
#include "gl_context.h"

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
    start(64, 48);
    ready();
  }
  void TearDown() override { app_.reset(); }

  /// Sets options before the App starts.
  virtual void prepare() = 0;
  /// After it has.
  virtual void ready() = 0;

 private:
  std::optional<gl::Context> context_;
};

}  // namespace ssphh::viewer

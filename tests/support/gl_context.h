#pragma once

#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/gl/context.h>

namespace ssphh::test {

/// One headless context for all tests of a program, which are skipped where there is no OpenGL at all.
class WithGl : public testing::Test {
 protected:
  void SetUp() override {
    static std::string missing;
    static std::optional<gl::Context> context = [] {
      try {
        return std::optional<gl::Context>(gl::Context::headless());
      } catch (const Error& e) {
        missing = e.what();
        return std::optional<gl::Context>();
      }
    }();
    if (!context) GTEST_SKIP() << missing;
    context->make_current();
    gl_ = &*context;
  }
  gl::Context& gl() { return *gl_; }

 private:
  gl::Context* gl_ = nullptr;
};

}  // namespace ssphh::test

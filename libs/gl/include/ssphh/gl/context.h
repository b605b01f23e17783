#pragma once
/// An OpenGL 4.5 core context: a headless one of our own, or one that a window has made current.

#include <memory>
#include <string>

#include <ssphh/core/held.h>

namespace ssphh::gl {

struct ContextInfo {
  std::string renderer, version;
  bool software = false;  ///< llvmpipe and its like: timer queries lie, so times are taken after glFinish
};

/// All objects of this module belong to the context that was current when they were made, and must be used
/// and destroyed while it is. Not for use from two threads at a time.
class Context {
 public:
  /// By EGL, without a window: the first GPU that offers OpenGL 4.5 core, else a software renderer. Current
  /// on this thread afterwards. Throws Error that lists what was tried when there is none.
  static Context headless();
  /// Whatever context is current on this thread, e.g. a GLFW window's; it stays the caller's. OpenGL's
  /// messages go on to the debug callback that was there, which is put back at the end. Throws Error when
  /// none is current, or when it is older than OpenGL 4.5.
  static Context adopt_current();

  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const ContextInfo& info() const;
  /// Makes a headless context current on this thread; an adopted one is the window's business.
  void make_current();

  /// Throws Error with the driver's messages when OpenGL reported an error since the last call.
  void throw_on_error(const std::string& where);
  /// Leaves out what was reported so far: somebody else's errors. They are logged.
  void forget_errors();

 private:
  std::string take_errors();
  struct Data;
  explicit Context(std::unique_ptr<Data> data);
  Held<Data> data_;
};

}  // namespace ssphh::gl

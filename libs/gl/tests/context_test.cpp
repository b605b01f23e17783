/// Contexts of our own and adopted ones: what they say of the driver, and what it reports to them.

#include <cstdlib>
#include <optional>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <ssphh/core/log.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/texture.h>

#include "error_message.h"
#include "gl_context.h"

namespace ssphh::gl {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// Messages logged while it lives.
class Logged {
 public:
  Logged() {
    before_ = set_log_sink([this](LogLevel, const std::string& message) { messages.push_back(message); });
  }
  ~Logged() { set_log_sink(before_); }
  Logged(const Logged&) = delete;
  Logged& operator=(const Logged&) = delete;
  std::vector<std::string> messages;

 private:
  LogSink before_;
};

/// A message of the application's own, which takes the way of the driver's.
void insert(GLenum type, GLenum severity, const std::string& text) {
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, severity, static_cast<GLsizei>(text.size()),
                       text.data());
}
void insert_error(const std::string& text) {
  insert(GL_DEBUG_TYPE_ERROR, GL_DEBUG_SEVERITY_HIGH, text);
}
void make_an_error() {
  glEnable(GL_TEXTURE_2D + 7777);
}

class GlContext : public test::WithGl {
 protected:
  void TearDown() override {
    if (IsSkipped()) return;
    gl().make_current();
    gl().forget_errors();
  }
};

std::string text(GLenum name) {
  return reinterpret_cast<const char*>(glGetString(name));
}
int integer(GLenum name) {
  GLint value = -1;
  glGetIntegerv(name, &value);
  return value;
}

/// Where there is no context all other tests are skipped: one that was made and is not given would silence
/// them.
TEST(GlContextHeadless, IsGivenUnlessEachDeviceHasAProblem) {
  const std::string said = test::message_of([] { Context::headless(); });
  EXPECT_THAT(said, Not(AnyOf(HasSubstr(": ,"), HasSubstr(": )"))));
}

TEST_F(GlContext, SaysWhatTheDriverSays) {
  const auto& [renderer, version, software] = gl().info();
  EXPECT_EQ(renderer, text(GL_RENDERER));
  EXPECT_EQ(version, text(GL_VERSION));
  EXPECT_EQ(software,
            renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos);
  EXPECT_FALSE(ContextInfo().software);
}

TEST_F(GlContext, OfOurOwnIsACoreOneThatReportsItsErrors) {
  EXPECT_GE(epoxy_gl_version(), 45);
  EXPECT_EQ(integer(GL_CONTEXT_PROFILE_MASK), GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_NE(integer(GL_CONTEXT_FLAGS) & GL_CONTEXT_FLAG_DEBUG_BIT, 0);
  EXPECT_TRUE(glIsEnabled(GL_DEBUG_OUTPUT));
  EXPECT_TRUE(glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS)) << "an error is known when its call returns";
  EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), EGL_NO_SURFACE);
}

TEST_F(GlContext, ErrorsAreToldOnceAllTogetherWithThePlace) {
  insert_error("first");
  insert_error("second");
  EXPECT_EQ(test::message_of([&] { gl().throw_on_error("drawing"); }),
            "drawing: OpenGL reports: first; second");
  EXPECT_NO_THROW(gl().throw_on_error("drawing"));
  make_an_error();
  EXPECT_THAT(test::message_of([&] { gl().throw_on_error("here"); }), StartsWith("here: OpenGL reports: "));
  EXPECT_NO_THROW(gl().throw_on_error("here")) << "nor by its number";
}

TEST_F(GlContext, DriverThatReportsNothingIsAsked) {
  glDisable(GL_DEBUG_OUTPUT);
  make_an_error();
  glEnable(GL_DEBUG_OUTPUT);
  EXPECT_EQ(test::message_of([&] { gl().throw_on_error("here"); }), "here: OpenGL reports: error 0x0500");
}

TEST_F(GlContext, NoMoreErrorsAreKeptThanAPersonReads) {
  // The last one that still begins below 4096 characters is told
  for (int i = 0; i < 64; ++i) insert_error(std::string(62, static_cast<char>('0' + i)));
  const std::string all = test::message_of([&] { gl().throw_on_error("x"); });
  EXPECT_THAT(all, testing::EndsWith("; " + std::string(62, '0' + 63)));
  for (int i = 0; i < 70; ++i) insert_error(std::string(62, 'a'));
  insert_error("beyond");
  const std::string most = test::message_of([&] { gl().throw_on_error("x"); });
  EXPECT_EQ(most.size(), std::string("x: OpenGL reports: ").size() + 65 * 62 + 64 * 2);
}

TEST_F(GlContext, ForgottenErrorsAreLogged) {
  const Logged log;
  insert_error("somebody else's");
  gl().forget_errors();
  EXPECT_THAT(log.messages, ElementsAre("OpenGL reported before: somebody else's"));
  EXPECT_NO_THROW(gl().throw_on_error("x"));
  gl().forget_errors();
  EXPECT_EQ(log.messages.size(), 1u);
}

TEST_F(GlContext, WarningsOfWeightAreLoggedAndNoErrors) {
  const Logged log;
  insert(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_HIGH, "slow");
  insert(GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DEBUG_SEVERITY_MEDIUM, "undefined");
  insert(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_MEDIUM, "chatter");
  insert(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_LOW, "chatter");
  EXPECT_THAT(log.messages, ElementsAre("OpenGL: slow", "OpenGL: undefined"));
  EXPECT_NO_THROW(gl().throw_on_error("x"));
}

TEST_F(GlContext, OfOurOwnIsCurrentFromItsStartToItsEnd) {
  const EGLContext shared = eglGetCurrentContext();
  const auto lives = [display = eglGetCurrentDisplay()](EGLContext context) {
    EGLint version = 0;
    return eglQueryContext(display, context, EGL_CONTEXT_CLIENT_VERSION, &version) == EGL_TRUE;
  };
  EGLContext gone = EGL_NO_CONTEXT;
  {
    Context own = Context::headless();
    const EGLContext fresh = eglGetCurrentContext();
    EXPECT_NE(fresh, shared);
    gl().make_current();
    EXPECT_EQ(eglGetCurrentContext(), shared);
    own.make_current();
    EXPECT_EQ(eglGetCurrentContext(), fresh);
    EXPECT_TRUE(lives(fresh));
    gone = fresh;
  }
  EXPECT_FALSE(lives(gone)) << "it is given back";
  EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
  {
    const Context own = Context::headless();
    gl().make_current();
  }
  EXPECT_EQ(eglGetCurrentContext(), shared) << "another one stays current";
}

// More of them than a process could hold at a time, were they kept.
TEST_F(GlContext, ErrorsGoToTheContextTheyAreOf) {
  Context own = Context::headless();
  insert_error("own");
  gl().make_current();
  EXPECT_NO_THROW(gl().throw_on_error("x"));
  insert_error("shared");
  own.make_current();
  EXPECT_EQ(test::message_of([&] { own.throw_on_error("x"); }), "x: OpenGL reports: own");
  gl().make_current();
  EXPECT_EQ(test::message_of([&] { gl().throw_on_error("x"); }), "x: OpenGL reports: shared");
}

TEST_F(GlContext, AdoptedOneLeavesTheHostItsSwitches) {
  Context host = Context::headless();
  const int user = 0;
  const GLDEBUGPROC quiet = [](GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar*, const void*) {};
  for (const bool output : {false, true}) {
    for (const bool synchronous : {false, true}) {
      glDebugMessageCallback(quiet, &user);
      (output ? glEnable : glDisable)(GL_DEBUG_OUTPUT);
      (synchronous ? glEnable : glDisable)(GL_DEBUG_OUTPUT_SYNCHRONOUS);
      {
        Context adopted = Context::adopt_current();
        EXPECT_TRUE(glIsEnabled(GL_DEBUG_OUTPUT));
        EXPECT_TRUE(glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS));
        insert_error("heard");
        EXPECT_THROW(adopted.throw_on_error("x"), Error);
      }
      void* now = nullptr;
      glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &now);
      EXPECT_EQ(now, reinterpret_cast<void*>(quiet));
      EXPECT_EQ(glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE, output);
      EXPECT_EQ(glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS) == GL_TRUE, synchronous);
    }
  }
}

TEST_F(GlContext, AdoptedOneLeavesAlonesWhatListensByThen) {
  Context host = Context::headless();
  const int user = 0;
  const GLDEBUGPROC later = [](GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar*, const void*) {};
  {
    const Context adopted = Context::adopt_current();
    glDebugMessageCallback(later, &user);
  }
  void *function = nullptr, *listener = nullptr;
  glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &function);
  glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &listener);
  EXPECT_EQ(function, reinterpret_cast<void*>(later));
  EXPECT_EQ(listener, &user);
  EXPECT_NE(eglGetCurrentContext(), EGL_NO_CONTEXT) << "the host's context stays current";
}

TEST_F(GlContext, HostIsToldAllOfWhatTheDriverSays) {
  Context host = Context::headless();
  struct Heard {
    GLenum source, type, severity;
    GLuint id;
    std::string text;
  };
  static std::vector<Heard> heard;
  heard.clear();
  const GLDEBUGPROC listen = [](GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                const GLchar* message, const void* user) {
    EXPECT_EQ(user, &heard);
    heard.push_back({source, type, severity, id, std::string(message, static_cast<std::size_t>(length))});
  };
  glDebugMessageCallback(listen, &heard);
  const Context adopted = Context::adopt_current();
  glDebugMessageInsert(GL_DEBUG_SOURCE_THIRD_PARTY, GL_DEBUG_TYPE_PORTABILITY, 17, GL_DEBUG_SEVERITY_MEDIUM,
                       4, "said and cut off");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0].source, GL_DEBUG_SOURCE_THIRD_PARTY);
  EXPECT_EQ(heard[0].type, GL_DEBUG_TYPE_PORTABILITY);
  EXPECT_EQ(heard[0].severity, GL_DEBUG_SEVERITY_MEDIUM);
  EXPECT_EQ(heard[0].id, 17u);
  EXPECT_EQ(heard[0].text, "said");
}

TEST_F(GlContext, AdoptedOneIsNotMadeCurrent) {
  const Context host = Context::headless();
  Context adopted = Context::adopt_current();
  EXPECT_EQ(adopted.info().renderer, host.info().renderer);
  gl().make_current();
  const EGLContext now = eglGetCurrentContext();
  adopted.make_current();
  EXPECT_EQ(eglGetCurrentContext(), now) << "that is the window's business";
}

TEST_F(GlContext, NoneThatIsCurrentCanBeAdopted) {
  eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  EXPECT_EQ(test::message_of([] { Context::adopt_current(); }),
            "OpenGL: no context is current on this thread");
}

TEST_F(GlContext, OlderOneIsRefusedWithItsVersion) {
  const EGLDisplay display = eglGetCurrentDisplay();
  ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                      EGL_OPENGL_ES2_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  eglChooseConfig(display, config_attributes, &config, 1, &configs);
  const EGLContext older = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (older == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, older)) {
    eglBindAPI(EGL_OPENGL_API);
    GTEST_SKIP() << "there is no OpenGL ES 3";
  }
  const std::string expected = "OpenGL: version 4.5 is needed, this is " +
                               std::to_string(integer(GL_MAJOR_VERSION)) + "." +
                               std::to_string(integer(GL_MINOR_VERSION));
  EXPECT_EQ(test::message_of([] { Context::adopt_current(); }), expected);
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, older);
  eglBindAPI(EGL_OPENGL_API);
}

/// What headless() says in a process in which Mesa offers no more than OpenGL 3.3.
void say_what_an_old_driver_says() {
  setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
  std::string said = test::message_of([] {
    const Context context = Context::headless();
    if (context.info().version.find("Mesa") == std::string::npos) throw Error("driver", "no Mesa");
  });
  std::fputs(("<" + said + ">").c_str(), stderr);
  std::exit(0);
}

TEST(GlContextDeathTest, WithoutAnyTellsEachThatWasTried) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(say_what_an_old_driver_says(), testing::ExitedWithCode(0),
              "<driver: no Mesa>|<OpenGL: no context of version 4.5 core "
              "\\((EGL device [0-9]+: [^,]*, )*EGL surfaceless: no OpenGL 4.5 core"
              "(, EGL device [0-9]+ \\(software\\): no OpenGL 4.5 core)+\\).*apt install libegl1");
}

}  // namespace
}  // namespace ssphh::gl

#include <memory>
#include <utility>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/gl/context.h>

namespace ssphh::gl {

struct Context::Data {
  ContextInfo info;
  EGLDisplay display = EGL_NO_DISPLAY;  ///< of a headless context
  EGLContext context = EGL_NO_CONTEXT;
  std::string errors;  ///< reported since the last throw_on_error

  /// Of an adopted context: what its owner listened with.
  GLDEBUGPROC host_callback = nullptr;
  void* host_user = nullptr;
  bool host_output = false, host_synchronous = false, listening = false;

  void listen();
  void stop_listening() const;

  ~Data() {
    if (context == EGL_NO_CONTEXT) {
      stop_listening();
      return;
    }
    if (eglGetCurrentContext() == context)
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
};

namespace {

constexpr int required_version = 45;

/// Whether a list of words with spaces between them, if there is one, holds the word.
bool has_word(const char* list, const std::string& word) {
  return list != nullptr && (" " + std::string(list) + " ").find(" " + word + " ") != std::string::npos;
}

struct Candidate {
  EGLenum platform;
  void* native;
  std::string name;
};

/// GPUs first, then what draws without one.
std::vector<Candidate> candidates() {
  std::vector<Candidate> gpus, others;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has_word(client, "EGL_EXT_platform_device") && has_word(client, "EGL_EXT_device_enumeration")) {
    EGLDeviceEXT devices[32];
    EGLint count = 0;
    if (eglQueryDevicesEXT(32, devices, &count)) {
      for (EGLint i = 0; i < count; ++i) {
        const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
        const bool software = has_word(extensions, "EGL_MESA_device_software");
        (software ? others : gpus)
            .push_back({EGL_PLATFORM_DEVICE_EXT, devices[i],
                        fmt::format("EGL device {}{}", i, software ? " (software)" : "")});
      }
    }
  }
  if (has_word(client, "EGL_MESA_platform_surfaceless"))
    others.insert(others.begin(), {EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "EGL surfaceless"});
  gpus.insert(gpus.end(), others.begin(), others.end());
  return gpus;
}

/// Empty when it worked, else what failed.
std::string try_candidate(const Candidate& candidate, EGLDisplay& display, EGLContext& context) {
  // The core name eglGetPlatformDisplay is EGL 1.5, which some drivers announce only after initialisation.
  display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return "no display";
  if (!has_word(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
    return "needs a surface";
  if (!eglBindAPI(EGL_OPENGL_API)) return "no desktop OpenGL";
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                      EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display, config_attributes, &config, 1, &configs) || configs == 0)
    return "no configuration";
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG,
                               EGL_TRUE,
                               EGL_NONE};
  context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return "no OpenGL 4.5 core";
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    context = EGL_NO_CONTEXT;
    return "cannot be made current";
  }
  return {};
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

void read_info(ContextInfo& info) {
  info.renderer = text_of(GL_RENDERER);
  info.version = text_of(GL_VERSION);
  for (const char* name : {"llvmpipe", "softpipe", "SWR", "swrast", "SwiftShader"})
    info.software |= info.renderer.find(name) != std::string::npos;
}

template <class Data>
void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                           const GLchar* message, const void* user) {
  auto& data = *static_cast<Data*>(const_cast<void*>(user));
  if (data.host_callback) data.host_callback(source, type, id, severity, length, message, data.host_user);
  if (type == GL_DEBUG_TYPE_ERROR) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;  // Program throws these itself
    if (data.errors.size() < 4096) data.errors += (data.errors.empty() ? "" : "; ") + std::string(message);
  } else if (severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) {
    log_warning("OpenGL: {}", message);
  }
}

}  // namespace

void Context::Data::listen() {
  void* callback = nullptr;
  glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
  glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &host_user);
  host_callback = reinterpret_cast<GLDEBUGPROC>(callback);
  host_output = glIsEnabled(GL_DEBUG_OUTPUT);
  host_synchronous = glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message<Data>, this);
  listening = true;
}

void Context::Data::stop_listening() const {
  if (!listening) return;
  void* user = nullptr;  // somebody else's, where the context is no longer current or others listen by now
  glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
  if (user != this) return;
  glDebugMessageCallback(host_callback, host_user);
  (host_output ? glEnable : glDisable)(GL_DEBUG_OUTPUT);
  (host_synchronous ? glEnable : glDisable)(GL_DEBUG_OUTPUT_SYNCHRONOUS);
}

Context::Context(std::unique_ptr<Data> data) : data_(std::move(data)) {
  read_info(data_->info);
  data_->listen();
  forget_errors();
}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

Context Context::headless() {
  std::string tried;
  for (const Candidate& candidate : candidates()) {
    auto data = std::make_unique<Data>();
    const std::string problem = try_candidate(candidate, data->display, data->context);
    if (problem.empty()) return Context(std::move(data));
    tried += fmt::format("{}{}: {}", tried.empty() ? "" : ", ", candidate.name, problem);
  }
  throw Error(
      "OpenGL",
      tried.empty() ? "EGL finds no device" : fmt::format("no context of version 4.5 core ({})", tried),
      "install a graphics driver, or Mesa's software renderer: apt install libegl1 libgl1-mesa-dri");
}

Context Context::adopt_current() {
  if (!eglGetCurrentContext() && epoxy_gl_version() == 0)
    throw Error("OpenGL", "no context is current on this thread");
  const int version = epoxy_gl_version();
  if (version < required_version)
    throw Error("OpenGL", fmt::format("version 4.5 is needed, this is {}.{}", version / 10, version % 10));
  return Context(std::make_unique<Data>());
}

const ContextInfo& Context::info() const {
  return data_->info;
}

void Context::make_current() {
  if (data_->context != EGL_NO_CONTEXT)
    eglMakeCurrent(data_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, data_->context);
}

std::string Context::take_errors() {
  // Drivers need not report messages in contexts without debugging: ask as well.
  if (const GLenum code = glGetError(); code != GL_NO_ERROR && data_->errors.empty())
    data_->errors = fmt::format("error {:#06x}", code);
  return std::exchange(data_->errors, {});
}

void Context::throw_on_error(const std::string& where) {
  const std::string errors = take_errors();
  if (!errors.empty()) throw Error(where, "OpenGL reports: " + errors);
}

void Context::forget_errors() {
  const std::string errors = take_errors();
  if (!errors.empty()) log_warning("OpenGL reported before: {}", errors);
}

}  // namespace ssphh::gl

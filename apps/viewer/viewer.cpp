#include "viewer.h"

#include <cstdlib>
#include <filesystem>

#include "app.h"
#include "glfw_window.h"
#include "script_player.h"

namespace ssphh::viewer {
namespace {

class Session {
 public:
  Session(App& app, const Control& control) : app_(app), control_(control) {}

  /// False once the window is to close.
  bool turn(const InjectedInput& input = {}) {
    if (control_.cancelled() || (app_.window.should_close() && app_.may_close())) return false;
    const double wait = app_.turn(input);
    app_.window.events(wait);
    return true;
  }

  /// Turns until that is true after one; false as turn().
  template <class Done>
  bool until(const Done& done) {
    do {
      if (!app_.job.running() && !app_.reference.status().running && !app_.marks.status().running)
        app_.redraw();
      if (!turn()) return false;
      if (app_.message_is_error) throw Error("view", app_.message);
    } while (!done());
    return true;
  }
  /// With the exposure that suits what is shown then.
  bool settle() {
    return until([&] { return app_.current() && !app_.take_exposure() && app_.settled(); });
  }

 private:
  App& app_;
  const Control& control_;
};

/// Where the display goes away the window system's library ends the process: what is not saved is kept first.
class KeptAtExit {
 public:
  explicit KeptAtExit(App& app) {
    static const int registered = std::atexit([] {
      if (app_) app_->keep_at_once();
    });
    static_cast<void>(registered);
    app_ = &app;
  }
  ~KeptAtExit() { app_ = nullptr; }
  KeptAtExit(const KeptAtExit&) = delete;
  KeptAtExit& operator=(const KeptAtExit&) = delete;

 private:
  static inline App* app_ = nullptr;
};

/// Opens what the options name. A scene that cannot be opened ends the session, for it is all that was asked
/// for; the window handles input meanwhile.
void begin(App& app, Session& session, const ViewerOptions& options) {
  if (options.source.empty()) return app.offer_recovery();
  app.failures_end = true;
  app.open_then(options.source, [&] {
    if (!options.camera.empty()) app.go_to_camera(options.camera);
    if (!options.path.empty()) app.load_path(options.path);
    if (options.probes.empty()) {
      app.light_opened();
    } else {
      app.use_probes(options.probes);
      app.offer_recovery();
    }
    app.failures_end = false;
  });
  // Until it is there, refused or cancelled
  while (app.failures_end && (!app.job.idle() || !app.job.status().error.empty())) {
    if (!session.turn()) break;
  }
  app.failures_end = false;
}

/// Pictures of a camera path, each once its light is complete.
void export_path(App& app, Session& session, const ViewerOptions& options, const Control& control) {
  FrameExport frames(app, options.export_dir, options.fps);
  ProgressStage progress(control, "drawing", static_cast<std::uint64_t>(frames.count()), "frames");
  int told = 0;
  const bool all = session.until([&] {
    const bool done = frames.step(app);
    for (; told < frames.done(); ++told) progress.advance(1);
    return done;
  });
  if (!all) throw Cancelled();
}

void play(App& app, Session& session, const ViewerOptions& options) {
  ScriptPlayer script(options.script.empty() ? std::vector<ScriptLine>{} : read_script(options.script));
  while (options.frames == 0 || app.report.frames < options.frames) {
    if (options.frames > 0) app.redraw();
    if (!session.turn(script.next(app))) return;
  }
}

}  // namespace

ViewerReport run_viewer(const ViewerOptions& options, const LoadScene& load, const ShowElsewhere& show,
                        const Control& control) {
  if (!options.export_dir.empty() && options.path.empty())
    throw Error("--export", "needs the path that is to be drawn", "give a camera path file with --path");
  GlfwWindow window("ssphh", options.width, options.height);
  return run_session(window, options, load, show, control);
}

ViewerReport run_session(Window& window, const ViewerOptions& options, const LoadScene& load,
                         const ShowElsewhere& show, const Control& control) {
  App app(window, options, load, show);
  const KeptAtExit kept(app);
  Session session(app, control);
  begin(app, session, options);
  const bool batch = !options.screenshot.empty() || !options.export_dir.empty();
  if (!options.script.empty() || !batch || options.frames > 0) play(app, session, options);
  if (batch && !control.cancelled()) session.settle();
  if (!options.screenshot.empty()) {
    app.screenshot(options.screenshot, options.panels);
    session.until([&] { return app.current(); });
  }
  if (!options.export_dir.empty()) export_path(app, session, options, control);
  if (!options.stats.empty()) app.save_stats(options.stats);
  // Ctrl-C closes a window as well as its button does; it leaves pictures that were asked for undone.
  if (batch) control.check();

  ViewerReport report = app.report;
  report.probes = app.light.empty() ? 0 : static_cast<int>(app.light.set().probes.size());
  for (const FrameTimes::Stage& stage : app.times.stages()) {
    if (stage.name != "frame") continue;
    report.median_ms = static_cast<double>(stage.ms.median());
    report.p99_ms = static_cast<double>(stage.ms.quantile(0.99));
  }
  return report;
}

}  // namespace ssphh::viewer

#pragma once
/// The viewer: a scene lit by probes in a window, lamps and doors moving (docs/viewer.md).

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/farm/dispatch.h>
#include <ssphh/scene/scene.h>
#include <ssphh/transport/transport_params.h>

#include "model/farm_client.h"
#include "model/picture_sender.h"

namespace ssphh::viewer {

struct ViewerOptions {
  std::string source;   ///< SCENE; empty: an empty window that waits for a file to be dropped
  std::string overlay;  ///< that loading lays on `source`; empty: the one beside it, if there is one
  std::string camera;   ///< by name; empty: the first
  float time = 0;       ///< pose at the start [s]
  std::string probes;   ///< a probe file; scene, auto, auto:METRES; off; empty: the scene's SPHLs, if any
  bool force = false;   ///< take a probe file of another scene, with a warning
  bool live = false;    ///< light a file's probes anew, so that they follow lamps and doors
  /// Surface points that keep light while it follows lamps, at most; none given: as the quality has them.
  std::optional<int> records;
  transport::TransportParams transport = {};  ///< of that light
  int width = 1440, height = 810;
  bool panels = true;
  std::vector<std::pair<std::string, std::string>> settings;  ///< by setting_names()

  const farm::FarmOptions* farm = nullptr;  ///< who does GEN and VIZ; null: this process
  OwnFarm own_farm;                         ///< where this session has started it
  bool show_truth = false;                  ///< every pass of a truth goes to `show`, too

  std::string path;  ///< camera path file: the bookmarks; with `export_dir` also what is drawn
  std::string export_dir;
  double fps = 30;         ///< of the export
  std::string script;      ///< file of docs/viewer.md's commands
  std::string screenshot;  ///< written once everything has settled
  std::string stats;       ///< .json or .csv, written at the end
  int frames = 0;          ///< end after so many; 0: when the user closes the window

  // Of the user; empty: nothing is kept. Where nobody is there to be asked, nothing is either.
  std::filesystem::path preferences;  ///< file (model/preferences.h)
  std::filesystem::path autosave;     ///< folder (model/autosave.h)
};

/// What a session was, for the tool to print.
struct ViewerReport {
  int frames = 0;
  std::string renderer;  ///< OpenGL's name of it
  int probes = 0;
  double median_ms = 0, p99_ms = 0;   ///< of a drawn frame
  std::uint64_t geometry_builds = 0;  ///< acceleration structures that were built, one for each opened scene
  std::optional<farm::FarmReport> farm;  ///< of the last bake, if a farm did it
  std::vector<std::string> written;      ///< files
};

/// Loads a scene as the tool's options say (overlay, environment); throws Error.
using LoadScene = std::function<scene::Scene(const std::string& source)>;

/// Opens the window and returns when it is closed or all that the options ask for is done. Throws Error when
/// there is no display or no OpenGL 4.5, and for anything in the options that cannot be done. `show` takes
/// pictures that the user wants to see elsewhere.
ViewerReport run_viewer(const ViewerOptions& options, const LoadScene& load, const ShowElsewhere& show,
                        const Control& control);

class Window;
/// The same in a window that is there.
ViewerReport run_session(Window& window, const ViewerOptions& options, const LoadScene& load,
                         const ShowElsewhere& show, const Control& control);

}  // namespace ssphh::viewer

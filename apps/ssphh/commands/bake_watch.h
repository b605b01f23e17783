#pragma once
/// `ssphh bake --watch`: bakes again, by update, whenever the scene's files are saved.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/files_read.h>

#include "commands/bake.h"

namespace ssphh::app {

/// What came of one save.
struct WatchRound {
  std::vector<scene::ChangedItem> changed;  ///< none: nothing that decides the light
  std::size_t baked = 0;                    ///< probes
  std::uint64_t rays = 0;
  double seconds = 0;             ///< from reading the scene to the file's last byte
  std::optional<double> was_off;  ///< of the picture, with the light of before: share of its light
  std::string problem;            ///< that kept the bake from being brought up to date; empty: none
};

struct BakeWatch {
  BakeResult first;                ///< of the bake that the watch began with
  std::vector<WatchRound> rounds;  ///< one for each save
};

/// Bakes, then again after each save of a file that the scene was read from, until it is cancelled; saves
/// that come while it bakes or shortly after one another are one. What keeps a save from being baked is
/// logged and waited over. Draws the preview, where one is asked for. Throws as run_bake() does for what
/// keeps it from beginning, Cancelled included, and Error for scenes without files.
BakeWatch run_bake_watch(const BakeOptions& options, const Control& control = {});

json::Value to_json(const BakeWatch& watch, const BakeOptions& options);
std::string to_text(const BakeWatch& watch, const BakeOptions& options);

/// Waits until a file is no longer as its stamp tells and all have been at rest for a moment. False:
/// cancelled.
bool wait_for_save(const std::vector<FileStamp>& files, const Control& control);

}  // namespace ssphh::app

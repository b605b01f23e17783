#pragma once
/// `ssphh bake --update`: what a change of the scene reaches is baked anew, the rest is taken from a probe
/// file.

#include <string>
#include <vector>

#include <ssphh/bake/update.h>
#include <ssphh/scene/scene_items.h>

#include "commands/bake.h"

namespace ssphh::app {

/// Fills result.set, paths, transport, viz and update from the probe file that options.update names. Throws
/// Error for files that cannot be updated, for SPHLs that have moved, and as run_bake() does.
void run_bake_update(const BakeOptions& options, BakeResult& result, BakeWatcher& watcher,
                     const Control& control);

/// At most a few of them by name.
std::string changes_text(const std::vector<scene::ChangedItem>& changed);
json::Value changed_json(const std::vector<scene::ChangedItem>& changed);

json::Value update_json(const BakeUpdate& update, const BakeOptions& options);
std::string update_text(const BakeUpdate& update, const BakeOptions& options);

}  // namespace ssphh::app

#pragma once
/// The options of every command that may place probes, and what it prints about them.

#include <string>

#include <ssphh/core/json.h>
#include <ssphh/pipeline/places.h>

#include "options/command_line.h"

namespace ssphh::app {

using pipeline::PlaceOptions;
using pipeline::PlaceResult;

/// With `files`, --probes also takes a probe file, for is_probe_file() to tell.
void add_place_options(Command command, PlaceOptions& options, bool files = false);

json::Value place_json(const PlaceResult& result);
std::string place_text(const PlaceResult& result);

}  // namespace ssphh::app

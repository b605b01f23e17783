#pragma once
/// `ssphh cook`: a probe file as a cooked file, which a shipped program looks up in place.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/cook/cook.h>
#include <ssphh/core/json.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct CookOptions {
  std::string input;        ///< probe file to read
  SceneOptions scene;       ///< in which the probes were baked; no source: none. Its time is not read
  std::string output;       ///< cooked file to write, .sphlc
  std::string places_of;    ///< probe file whose points of surfaces are taken; empty: the file's own
  cook::CookParams params;  ///< its places are not read
  int points = 1024;        ///< places at which the file is compared with the full lookup; 0: none
  bool force = false;       ///< go on, with a warning, where the probes are of another scene
  std::uint64_t seed = 0;   ///< of these places
};

/// The cooked file's irradiance against the full lookup's, which sends rays. Differences are means over
/// colours, relative to the full lookup's mean irradiance.
struct CookAgreement {
  std::size_t points = 0;
  double ratio = 0;                   ///< of the mean irradiances
  double mean = 0;                    ///< of the differences
  double half = 0, p90 = 0, p99 = 0;  ///< as many of the differences are no larger
  double microseconds = 0;            ///< of one lookup, the quickest of several batches on one thread
};

struct CookResult {
  cook::Cooked cooked;  ///< its bytes were written and are not here any more
  std::uint64_t bytes = 0, probe_file_bytes = 0;
  std::size_t memory = 0;  ///< that a program needs to open it
  std::size_t probes = 0;
  std::vector<std::string> groups;
  std::optional<CookAgreement> on_surfaces, in_the_open;
};

/// Cooks, opens what was made as a program would, compares, and writes. Throws Error for files that cannot be
/// read or written, for another scene than that of the bake, and as cook::cook does; Cancelled when asked to
/// stop.
CookResult run_cook(const CookOptions& options, const Control& control = {});
json::Value to_json(const CookResult& result, const CookOptions& options);
std::string to_text(const CookResult& result, const CookOptions& options);

}  // namespace ssphh::app

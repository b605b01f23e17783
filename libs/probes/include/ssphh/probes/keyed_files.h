#pragma once
/// Several bakes of one network, played as keys: "a.sphl,b.sphl@1.5".

#include <optional>
#include <string>
#include <vector>

#include <ssphh/probes/blend.h>

namespace ssphh::probes {

/// A probe file, and the time it is the light of [s]; none: that of its bake.
struct ProbeKey {
  std::string file;
  std::optional<float> time;
};

/// What "FILE[@SECONDS],FILE[@SECONDS] ..." names. Throws Error for names that are no probe file's and times
/// that are no numbers.
std::vector<ProbeKey> read_probe_keys(const std::string& text);

/// The sets of two keys or more, by time. Throws Error for files that cannot be read, two keys at one time,
/// and sets that cannot be blended.
std::vector<KeyedSet> read_keyed_sets(const std::vector<ProbeKey>& keys);

}  // namespace ssphh::probes

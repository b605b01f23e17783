#pragma once

#include <ssphh/probes/probe_file.h>

namespace ssphh::probes {

/// Last step of both readers: derives `self` and `sum`, then validates.
void finish_reading(ProbeSet& set, const std::string& where);

}  // namespace ssphh::probes

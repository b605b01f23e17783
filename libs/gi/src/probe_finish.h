#pragma once

#include <ssphh/gi/probe_file.h>

namespace ssphh::gi {

/// Last step of both readers: derives `self` and `sum`, then validates.
void finish_reading(ProbeSet& set, const std::string& where);

}  // namespace ssphh::gi

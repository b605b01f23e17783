#pragma once

#include <string>

#include "binding.h"

namespace ssphh::python {

/// What a caller says of places, None, a number or a word, as pipeline::PlaceOptions takes it. Throws Error
/// for anything else.
std::string places_in_words(const py::object& probes);

}  // namespace ssphh::python

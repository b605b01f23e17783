#pragma once
/// The processor that this program runs on.

#include <string>

namespace ssphh::app {

/// Its name as the system tells it.
std::string processor_name();

}  // namespace ssphh::app

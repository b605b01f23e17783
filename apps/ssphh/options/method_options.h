#pragma once
/// The options of the commands that make a method of methods::method_table().

#include <string>
#include <vector>

#include "options/command_line.h"

namespace ssphh::app {

/// --param NAME=VALUE, repeated.
Option add_method_parameters(Command command, std::vector<std::string>& settings);

}  // namespace ssphh::app

#pragma once
/// The options of the commands that make a method of methods::all_methods().

#include <string>
#include <vector>

#include "options/command_line.h"

namespace ssphh::app {

/// --param NAME=VALUE, repeated.
inline Option add_method_parameters(Command command, std::vector<std::string>& settings) {
  return command
      .option("--param", settings, "Parameter of the method, NAME=VALUE; `ssphh methods` lists them")
      .repeatable();
}

}  // namespace ssphh::app

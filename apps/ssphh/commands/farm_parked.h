#pragma once

#include "commands/command.h"

namespace ssphh::app {

/// `ssphh farm parked`, `release` and `drop`.
void add_farm_parked_commands(Command group, Context& context);

}  // namespace ssphh::app

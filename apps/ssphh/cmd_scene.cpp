#include "command.h"

namespace ssphh::app {

void add_scene_commands(CLI::App&, Context&) {}

}  // namespace ssphh::app

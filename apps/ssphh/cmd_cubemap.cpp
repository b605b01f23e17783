#include "command.h"

namespace ssphh::app {

void add_cubemap_commands(CLI::App&, Context&) {}

}  // namespace ssphh::app

#include "command.h"

namespace ssphh::app {

void add_hier_command(CLI::App&, Context&) {}

}  // namespace ssphh::app

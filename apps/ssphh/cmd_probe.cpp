#include "command.h"

namespace ssphh::app {

void add_probe_commands(CLI::App&, Context&) {}

}  // namespace ssphh::app

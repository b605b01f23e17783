#include "command.h"

namespace ssphh::app {

void add_bake_command(CLI::App&, Context&) {}

}  // namespace ssphh::app

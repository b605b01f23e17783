#include "command.h"

namespace ssphh::app {

void add_sh_commands(CLI::App&, Context&) {}

}  // namespace ssphh::app

#include "command.h"

namespace ssphh::app {

void add_render_command(CLI::App&, Context&) {}

}  // namespace ssphh::app

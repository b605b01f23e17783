#include "command.h"

namespace ssphh::app {

void add_compare_command(CLI::App&, Context&) {}

}  // namespace ssphh::app

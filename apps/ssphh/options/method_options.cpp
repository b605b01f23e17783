#include "options/method_options.h"

namespace ssphh::app {

Option add_method_parameters(Command command, std::vector<std::string>& settings) {
  return command
      .option("--param", settings, "Parameter of the method, NAME=VALUE; `ssphh methods` lists them")
      .repeatable();
}

}  // namespace ssphh::app

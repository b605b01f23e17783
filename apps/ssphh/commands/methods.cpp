#include "commands/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

std::string default_text(const methods::MethodParameter& p) {
  if (!p.choices.empty()) return p.choices[static_cast<std::size_t>(p.value)];
  return fmt::format("{:g}", p.value);
}

std::string range_text(const methods::MethodParameter& p) {
  if (!p.choices.empty()) return fmt::format("{}", fmt::join(p.choices, "|"));
  return fmt::format("{:g}..{:g}", p.least, p.most);
}

json::Value parameter_json(const methods::MethodParameter& p) {
  json::Value item = {{"name", p.name}, {"default", default_text(p)}, {"about", p.about}};
  if (p.choices.empty()) {
    item["default"] = p.value, item["least"] = p.least, item["most"] = p.most, item["whole"] = p.whole;
  } else {
    item["choices"] = p.choices;
  }
  return item;
}

}  // namespace

MethodsResult run_methods(const MethodsOptions& options, const Control&) {
  if (options.name.empty()) return {methods::all_methods()};
  return {{&methods::find_method(options.name), 1}};
}

json::Value to_json(const MethodsResult& result, const MethodsOptions&) {
  json::Value all = json::Value::array();
  for (const methods::MethodEntry& entry : result.methods) {
    json::Value parameters = json::Value::array();
    for (const methods::MethodParameter& p : entry.parameters) parameters.push_back(parameter_json(p));
    all.push_back({{"name", entry.name}, {"about", entry.about}, {"parameters", std::move(parameters)}});
  }
  return {{"methods", std::move(all)}};
}

std::string to_text(const MethodsResult& result, const MethodsOptions&) {
  std::string text;
  for (const methods::MethodEntry& entry : result.methods) {
    text += fmt::format("{}{}\n    {}", text.empty() ? "" : "\n\n", entry.name, entry.about);
    for (const methods::MethodParameter& p : entry.parameters)
      text += fmt::format("\n    {:<16} {:<10} {} ({})", p.name, default_text(p), p.about, range_text(p));
  }
  return text;
}

void add_methods_command(Command app, Context& context) {
  auto [command, o] = add_command(app, context, "methods",
                                  "List the methods of indirect light and their parameters", run_methods);
  command.option("name", o.name, "This one alone");
}

}  // namespace ssphh::app

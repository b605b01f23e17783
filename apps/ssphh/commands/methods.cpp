#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/methods/table.h>

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

void list(const std::string& wanted, const Context& context) {
  if (!wanted.empty()) methods::find_method(wanted);
  json::Value all = json::Value::array();
  std::string text;
  for (const methods::MethodEntry& entry : methods::method_table()) {
    if (!wanted.empty() && wanted != entry.name) continue;
    json::Value parameters = json::Value::array();
    text += fmt::format("{}{}\n    {}\n", text.empty() ? "" : "\n", entry.name, entry.about);
    for (const methods::MethodParameter& p : entry.parameters) {
      text += fmt::format("    {:<16} {:<10} {} ({})\n", p.name, default_text(p), p.about, range_text(p));
      json::Value item = {{"name", p.name}, {"default", default_text(p)}, {"about", p.about}};
      if (p.choices.empty()) {
        item["default"] = p.value, item["least"] = p.least, item["most"] = p.most, item["whole"] = p.whole;
      } else {
        item["choices"] = p.choices;
      }
      parameters.push_back(std::move(item));
    }
    all.push_back({{"name", entry.name}, {"about", entry.about}, {"parameters", std::move(parameters)}});
  }
  text.pop_back();
  context.result({{"methods", std::move(all)}}, text);
}

}  // namespace

void add_methods_command(Command app, Context& context) {
  auto wanted = std::make_shared<std::string>();
  Command command =
      add_command(app, context, "methods", "List the methods of indirect light and their parameters",
                  [wanted, &context] { list(*wanted, context); });
  command.option("name", *wanted, "This one alone");
}

}  // namespace ssphh::app

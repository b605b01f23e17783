#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/methods/parameters.h>

namespace ssphh::methods {
namespace {

const MethodParameter& declared_as(const std::string& where, std::span<const MethodParameter> declared,
                                   const std::string& name) {
  std::vector<std::string> names;
  for (const MethodParameter& parameter : declared) {
    if (name == parameter.name) return parameter;
    names.emplace_back(parameter.name);
  }
  if (names.empty()) throw Error(where, fmt::format("there is no parameter \"{}\": it has none", name));
  throw Error(where, fmt::format("there is no parameter \"{}\"", name), nearest_hint(name, names));
}

double read(const std::string& where, const MethodParameter& parameter, const std::string& text) {
  if (!parameter.choices.empty()) {
    const auto found = std::ranges::find(parameter.choices, text);
    if (found != parameter.choices.end()) return static_cast<double>(found - parameter.choices.begin());
    throw Error(where, none_of(text, parameter.choices));
  }
  const auto value = parse_number<double>(text);
  if (!value) throw Error(where, fmt::format("\"{}\" is no number", text));
  if (parameter.whole && *value != std::floor(*value))
    throw Error(where, fmt::format("{} is no whole number", text));
  if (*value < parameter.least || *value > parameter.most)
    throw Error(where, fmt::format("{} is not within {:g} to {:g}", text, parameter.least, parameter.most));
  return *value;
}

}  // namespace

MethodParameters::MethodParameters(const std::string& method, std::span<const MethodParameter> declared,
                                   std::span<const std::string> settings) {
  for (const MethodParameter& parameter : declared)
    values_[parameter.name] = {parameter.value, parameter.choices};
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos)
      throw Error("parameter \"" + setting + "\"", "has no value", "write NAME=VALUE");
    const std::string name = setting.substr(0, equals);
    const MethodParameter& parameter = declared_as("method " + method, declared, name);
    values_[name].number =
        read(fmt::format("{} of method {}", name, method), parameter, setting.substr(equals + 1));
  }
}

double MethodParameters::number(const std::string& name) const {
  return values_.at(name).number;
}
int MethodParameters::integer(const std::string& name) const {
  return static_cast<int>(number(name));
}
const std::string& MethodParameters::choice(const std::string& name) const {
  const Value& value = values_.at(name);
  return value.choices.at(static_cast<std::size_t>(value.number));
}

}  // namespace ssphh::methods

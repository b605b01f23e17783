#include "parameters.h"

namespace ssphh::report {
namespace {

std::string value_text(const json::Cursor& at) {
  if (at.is_string()) return at.text();
  if (at.is_number()) return json::print(at.value());
  at.fail("must be a number or text");
}

}  // namespace

Parameters read_parameters(const json::Cursor& object) {
  Parameters parameters;
  for (const auto& [name, unused] : object.entries())
    parameters.emplace_back(name, value_text(object[name.c_str()]));
  return parameters;
}

std::vector<Parameters> read_variants(const std::optional<json::Cursor>& given) {
  if (!given) return {{}};
  std::vector<Parameters> variants;
  if (given->is_array()) {
    for (std::size_t i = 0; i < given->size(); ++i) variants.push_back(read_parameters((*given)[i]));
  } else if (given->is_object()) {
    variants.emplace_back();
    for (const auto& [name, unused] : given->entries()) {
      const json::Cursor values = (*given)[name.c_str()];
      if (!values.is_array() || values.size() == 0) values.fail("must be a list of values");
      std::vector<Parameters> longer;
      for (const Parameters& start : variants) {
        for (std::size_t i = 0; i < values.size(); ++i) {
          longer.push_back(start);
          longer.back().emplace_back(name, value_text(values[i]));
        }
      }
      variants = std::move(longer);
    }
  } else {
    given->fail("must be an object of lists or a list of objects");
  }
  if (variants.empty()) given->fail("is empty");
  return variants;
}

}  // namespace ssphh::report

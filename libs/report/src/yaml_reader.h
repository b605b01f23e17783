#pragma once
/// Plans in YAML 1.2 (core schema), read into the same document as JSON.

#include <string>
#include <string_view>

#include <ssphh/core/json.h>

namespace ssphh::report {

/// Whether a file of this name is YAML: it ends with .yaml or .yml.
bool is_yaml_name(std::string_view name);

/// Throws Error with the line for what is no YAML, a key that stands twice, a key that is no text, or a
/// document of over a million values (aliases may multiply).
json::Value parse_yaml(std::string_view text, const std::string& name);

/// The line, from 1, of the place that an Error of a Cursor names ("plan.yaml: methods[1].steps"), or of the
/// key `key` there; 0 when there is no such place.
int yaml_line(std::string_view text, const std::string& name, const std::string& where,
              const std::string& key);

}  // namespace ssphh::report

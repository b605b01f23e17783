#pragma once
/// What a method made for a scene took.

#include <string>

#include <ssphh/core/json.h>
#include <ssphh/methods/method.h>

namespace ssphh::pipeline {

struct MethodFigures {
  double bake_seconds = 0, update_seconds = 0;  ///< of making it, of its last update
  methods::MethodMemory memory;                 ///< bytes
  methods::MethodNumbers numbers;               ///< its own
};

/// bake_seconds, update_seconds, lookup_bytes, update_bytes and the method's numbers.
json::Value to_json(const MethodFigures& figures);
std::string to_text(const MethodFigures& figures);

}  // namespace ssphh::pipeline

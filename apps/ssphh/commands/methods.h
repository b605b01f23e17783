#pragma once
/// `ssphh methods`: which methods of indirect light there are, and their parameters.

#include <span>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/methods/method_list.h>

namespace ssphh::app {

struct MethodsOptions {
  std::string name;  ///< of the one to tell of; empty: all
};

struct MethodsResult {
  std::span<const methods::MethodEntry> methods;  ///< of methods::all_methods(), in its order
};

/// Throws Error for a name that no method has.
MethodsResult run_methods(const MethodsOptions& options = {}, const Control& control = {});

json::Value to_json(const MethodsResult& result, const MethodsOptions& options);
std::string to_text(const MethodsResult& result, const MethodsOptions& options);

}  // namespace ssphh::app

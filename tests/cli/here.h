#pragma once
/// Commands of the tool run within the test: quicker than a process, and what they throw can be looked at.

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include <ssphh/core/control.h>

#include "joined.h"
#include "json_text.h"

namespace ssphh::test {

struct HereResult {
  std::string out, err;
  int exit_code = 0;
};

/// Throws what the command does; for wrong usage that is an app::ParsingEnded.
HereResult run_here(const std::vector<std::string>& arguments, const Control& control = {});

/// What it prints for people, without the newline at the end.
std::string text_here(const std::vector<std::string>& arguments);

const json::Value json_here(std::vector<std::string> arguments, int exit_code = 0);

/// The message of the Error that it throws.
std::string problem_here(const std::vector<std::string>& arguments);

}  // namespace ssphh::test

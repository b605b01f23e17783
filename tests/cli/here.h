#pragma once
/// Commands of the tool run within the test: quicker than a process, and what they throw can be looked at.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "error_message.h"

namespace ssphh::test {

struct HereResult {
  std::string out, err;
  int exit_code = 0;
};

/// Throws what the command does; for wrong usage that is a CLI::ParseError.
inline HereResult run_here(std::vector<std::string> arguments) {
  app::Context context;
  CLI::App app{"ssphh"};
  app::add_commands(app, context);
  std::ranges::reverse(arguments);  // as CLI11 wants a vector
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  HereResult result;
  const auto finish = [&] {
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr();
  };
  try {
    app.parse(arguments);
    context.run();
  } catch (...) {
    finish();
    throw;
  }
  finish();
  result.exit_code = context.exit_code;
  return result;
}

/// What it prints for people, without the newline at the end.
inline std::string text_here(const std::vector<std::string>& arguments) {
  std::string text = run_here(arguments).out;
  if (!text.empty()) text.pop_back();
  return text;
}

inline nlohmann::json json_here(std::vector<std::string> arguments, int exit_code = 0) {
  arguments.emplace_back("--json");
  const HereResult result = run_here(arguments);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  return nlohmann::json::parse(result.out);
}

/// The message of the Error that it throws.
inline std::string problem_here(const std::vector<std::string>& arguments) {
  return message_of([&] { run_here(arguments); });
}

inline std::vector<std::string> joined(std::vector<std::string> arguments,
                                       const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace ssphh::test

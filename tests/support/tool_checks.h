#pragma once
/// What the tests of the tool expect of a command: one JSON object, certain keys, a failure that says why.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_text.h"
#include "tool.h"

namespace ssphh::test {

/// Runs a command with --json; the object on stdout, empty when there was none (the test fails then).
inline const json::Value run_json(std::vector<std::string> arguments, int exit_code = 0) {
  arguments.emplace_back("--json");
  const ToolResult result = run_tool(arguments);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  const json::Value object = parse_json_if_any(result.out);
  EXPECT_TRUE(object.is_object()) << "stdout is not one JSON object: " << result.out;
  return object.is_object() ? object : json::Value::object();
}

inline void expect_keys(const json::Value& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys)
    EXPECT_TRUE(object.contains(key)) << key << " is missing in " << print(object);
}

/// The command ends with `exit_code` and says each of `messages`.
inline void expect_failure(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& messages, int exit_code = 1) {
  const ToolResult result = run_tool(arguments);
  EXPECT_EQ(result.exit_code, exit_code) << testing::PrintToString(arguments) << "\n" << result.err;
  for (const std::string& message : messages)
    EXPECT_THAT(result.err + result.out, testing::HasSubstr(message)) << testing::PrintToString(arguments);
}
inline void expect_failure(const std::vector<std::string>& arguments, const char* message,
                           int exit_code = 1) {
  expect_failure(arguments, std::vector<std::string>{message}, exit_code);
}

}  // namespace ssphh::test

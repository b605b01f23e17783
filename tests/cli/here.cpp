#include "here.h"

#include "commands/command.h"
#include "error_message.h"

namespace ssphh::test {

HereResult run_here(const std::vector<std::string>& arguments, const Control& control) {
  app::Context context;
  context.control = control;
  const app::CommandLine line("ssphh");
  app::add_commands(line.root(), context);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  HereResult result;
  const auto finish = [&] {
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr();
  };
  try {
    line.parse(arguments);
    context.run();
  } catch (...) {
    finish();
    throw;
  }
  finish();
  result.exit_code = context.exit_code;
  return result;
}

std::string text_here(const std::vector<std::string>& arguments) {
  std::string text = run_here(arguments).out;
  if (!text.empty()) text.pop_back();
  return text;
}

const json::Value json_here(std::vector<std::string> arguments, int exit_code) {
  arguments.emplace_back("--json");
  const HereResult result = run_here(arguments);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  return parse_json(result.out);
}

std::string problem_here(const std::vector<std::string>& arguments) {
  return message_of([&] { run_here(arguments); });
}

}  // namespace ssphh::test

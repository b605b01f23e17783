#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "commands/command.h"
#include "commands/farm_ask.h"

namespace ssphh::app {
namespace {

std::string parked_text(const json::Value& jobs) {
  if (jobs.empty()) return "no job is set aside";
  std::string text;
  for (const json::Value& job : jobs.elements()) {
    text += fmt::format("{}job {} of {}, {:.1f} KB, set aside {:.0f} s ago", text.empty() ? "" : "\n",
                        job.number_or("job", 0), job.text_or("service", ""), 1e-3 * job.number_or("bytes", 0),
                        1e-3 * job.number_or("since_ms", 0));
    if (const json::Value* failures = job.find("failures"); failures && failures->is_array()) {
      for (const json::Value& failure : failures->elements()) text += "\n  " + failure.string();
    }
  }
  return text;
}

/// Jobs by their numbers, or all of them.
struct Choice {
  BrokerChoice broker;
  std::vector<std::uint64_t> jobs;
  bool all = false;
};

int tell(const Choice& choice, const std::string& service, const Control& control) {
  if (choice.jobs.empty() && !choice.all)
    throw Error("jobs", "none are named", "give their numbers (`ssphh farm parked`) or --all");
  majordomo::Client client = connect(choice.broker);
  if (choice.all) return std::stoi(ask(client, service, "all", control));
  for (const std::uint64_t job : choice.jobs)
    ask(client, service, std::to_string(job), control, fmt::format("job {} is not set aside", job));
  return static_cast<int>(choice.jobs.size());
}

void add_choice(Command command, Choice& choice) {
  add_broker_options(command, choice.broker, "admin", "Broker").required();
  Option jobs = command.option("JOB", choice.jobs, "Numbers, as `ssphh farm parked` shows them");
  command.flag("--all", choice.all, "All that are set aside").excludes(jobs);
}

}  // namespace

void add_farm_parked_commands(Command group, Context& context) {
  const auto broker = std::make_shared<BrokerChoice>();
  Command parked =
      add_command(group, context, "parked",
                  "Jobs that were set aside because workers failed on them, and why", [=, &context] {
                    majordomo::Client client = connect(*broker);
                    const json::Value answer = ask_json(client, "mmi.parked", context.control);
                    context.result({{"jobs", answer["jobs"]}}, parked_text(answer["jobs"]));
                  });
  add_broker_options(parked, *broker, "client", "Broker").required();

  const auto again = std::make_shared<Choice>(), gone = std::make_shared<Choice>();
  Command release = add_command(
      group, context, "release", "Put jobs that were set aside back into the queue", [=, &context] {
        const int count = tell(*again, "mmi.release", context.control);
        context.result(
            {{"released", count}},
            fmt::format("{} queued again", count == 1 ? "1 job is" : fmt::format("{} jobs are", count)));
      });
  add_choice(release, *again);
  release.footer(
      "A result goes to whoever left the request on the broker's disk; without such a one it is kept for ten "
      "minutes\nfor a client that sends the same job.");
  Command drop = add_command(group, context, "drop", "Forget jobs that were set aside", [=, &context] {
    const int count = tell(*gone, "mmi.drop", context.control);
    context.result({{"dropped", count}},
                   fmt::format("{} forgotten", count == 1 ? "1 job is" : fmt::format("{} jobs are", count)));
  });
  add_choice(drop, *gone);
}

}  // namespace ssphh::app

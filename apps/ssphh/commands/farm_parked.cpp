#include "commands/farm_parked.h"

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/error.h>
#include <ssphh/farm/ask.h>

#include "commands/command.h"
#include "commands/farm.h"

namespace ssphh::app {
namespace {

const std::string parked_service = "mmi.parked";

int tell(const FarmJobsOptions& choice, const std::string& service, const Control& control) {
  if (choice.jobs.empty() && !choice.all)
    throw Error("jobs", "none are named", "give their numbers (`ssphh farm parked`) or --all");
  majordomo::Client client = farm::connect(broker_address(choice.broker));
  if (choice.all) return std::stoi(farm::ask(client, service, "all", control));
  for (const std::uint64_t job : choice.jobs)
    farm::ask(client, service, std::to_string(job), control, fmt::format("job {} is not set aside", job));
  return static_cast<int>(choice.jobs.size());
}

std::string jobs_text(int count) {
  return counted(count, "job is", "jobs are");
}

void add_choice(Command command, FarmJobsOptions& choice) {
  add_required_broker(command.under("Broker"), choice.broker, "admin");
  Option jobs = command.option("JOB", choice.jobs, "Numbers, as `ssphh farm parked` shows them");
  command.flag("--all", choice.all, "All that are set aside").excludes(jobs);
}

}  // namespace

FarmParkedResult run_farm_parked(const BrokerChoice& broker, const Control& control) {
  majordomo::Client client = farm::connect(broker_address(broker));
  const json::Value answer = farm::ask_json(client, parked_service, control);
  return {json::Cursor(answer, parked_service)["jobs"].value()};
}

json::Value to_json(const FarmParkedResult& result, const BrokerChoice&) {
  return {{"jobs", result.jobs}};
}

std::string to_text(const FarmParkedResult& result, const BrokerChoice&) {
  std::string text;
  for (const json::Cursor& job : json::elements(json::Cursor(result.jobs, parked_service, "jobs"))) {
    text += fmt::format("{}job {} of {}, {:.1f} KB, set aside {:.0f} s ago", text.empty() ? "" : "\n",
                        farm::told_number(job, "job"), job.text_or("service"),
                        1e-3 * farm::told_number(job, "bytes"), 1e-3 * farm::told_number(job, "since_ms"));
    if (!job.has("failures")) continue;
    for (const json::Cursor& failure : json::elements(job["failures"])) text += "\n  " + failure.text();
  }
  return text.empty() ? "no job is set aside" : text;
}

FarmReleaseResult run_farm_release(const FarmJobsOptions& options, const Control& control) {
  return {tell(options, "mmi.release", control)};
}

json::Value to_json(const FarmReleaseResult& result, const FarmJobsOptions&) {
  return {{"released", result.released}};
}

std::string to_text(const FarmReleaseResult& result, const FarmJobsOptions&) {
  return jobs_text(result.released) + " queued again";
}

FarmDropResult run_farm_drop(const FarmJobsOptions& options, const Control& control) {
  return {tell(options, "mmi.drop", control)};
}

json::Value to_json(const FarmDropResult& result, const FarmJobsOptions&) {
  return {{"dropped", result.dropped}};
}

std::string to_text(const FarmDropResult& result, const FarmJobsOptions&) {
  return jobs_text(result.dropped) + " forgotten";
}

void add_farm_parked_commands(Command group, Context& context) {
  auto [parked, broker] =
      add_command(group, context, "parked",
                  "Jobs that were set aside because workers failed on them, and why", run_farm_parked);
  add_required_broker(parked.under("Broker"), broker, "client");

  auto [release, again] = add_command(group, context, "release",
                                      "Put jobs that were set aside back into the queue", run_farm_release);
  add_choice(release, again);
  release.footer(
      "A result goes to whoever left the request on the broker's disk; without such a one it is kept for ten "
      "minutes\nfor a client that sends the same job.");
  auto [drop, gone] = add_command(group, context, "drop", "Forget jobs that were set aside", run_farm_drop);
  add_choice(drop, gone);
}

}  // namespace ssphh::app

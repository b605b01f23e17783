#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include <ssphh/majordomo/security.h>

#include "commands/command.h"
#include "commands/farm_ask.h"

namespace ssphh::app {
namespace {

struct Status {
  json::Value stats, workers;
};

Status status_of(majordomo::Client& client, const Control& control) {
  return {ask_json(client, "mmi.stats", control), ask_json(client, "mmi.workers", control)};
}

double seconds(const json::Value& object, const char* key) {
  return object.number_or(key, 0) / 1000;
}

/// Without questions to the broker, as those of `top` itself, which its totals count as well.
double finished_jobs(const json::Value& stats) {
  double sum = 0;
  for (const json::Value& service : stats["services"].elements()) sum += service.number_or("finished", 0);
  return sum;
}

/// `per_second`: jobs finished, where it is known.
std::string status_text(const Status& s, std::optional<double> per_second) {
  const json::Value &now = s.stats["now"], &total = s.stats["total"];
  std::string text =
      fmt::format("{} workers ({} idle), {} jobs queued, {} running, {} finished, {} retries, {} parked",
                  now.number_or("workers", 0), now.number_or("idle", 0), now.number_or("queued", 0),
                  now.number_or("running", 0), total.number_or("finished", 0), total.number_or("retries", 0),
                  total.number_or("parked", 0));
  if (per_second) {
    const double left = now.number_or("queued", 0) + now.number_or("running", 0);
    text += fmt::format("\n{:.2f} jobs/s", *per_second);
    if (*per_second > 0 && left > 0) text += fmt::format(", about {:.0f} s left", left / *per_second);
  }
  text += fmt::format("\n{:<48} {:>7} {:>6} {:>7} {:>9}", "service", "workers", "idle", "queued", "finished");
  for (const json::Value& service : s.stats["services"].elements()) {
    text += fmt::format("\n{:<48} {:>7} {:>6} {:>7} {:>9}", service.text_or("name", ""),
                        service.number_or("workers", 0), service.number_or("idle", 0),
                        service.number_or("queued", 0), service.number_or("finished", 0));
  }
  text += fmt::format("\n{:<30} {:<8} {:>9} {:>7}  {}", "worker", "state", "for", "served", "service");
  for (const json::Value& worker : s.workers["workers"].elements()) {
    text += fmt::format("\n{:<30} {:<8} {:>7.1f} s {:>7}  {}", worker.text_or("name", ""),
                        worker.text_or("state", ""), seconds(worker, "since_ms"),
                        worker.number_or("served", 0), worker.text_or("service", ""));
  }
  return text;
}

void top(const BrokerChoice& choice, double interval, int count, Context& context) {
  majordomo::Client client = connect(choice);
  std::optional<double> before;
  auto asked = std::chrono::steady_clock::now();
  for (int i = 0; count == 0 || i < count; ++i) {
    const Status status = status_of(client, context.control);
    const auto now = std::chrono::steady_clock::now();
    const double finished = finished_jobs(status.stats);
    std::optional<double> rate;
    if (before) rate = std::max(0.0, finished - *before) / std::chrono::duration<double>(now - asked).count();
    before = finished, asked = now;
    if (!context.json && count != 1) fmt::print("\x1b[H\x1b[2J");
    context.result({{"stats", status.stats}, {"workers", status.workers["workers"]}},
                   status_text(status, rate));
    for (double waited = 0; waited < interval && (count == 0 || i + 1 < count); waited += 0.05) {
      context.control.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

std::vector<std::string> roles_of(const std::string& role) {
  if (role == "client") return {"client", "worker:ssphh.blobs.*"};
  if (role == "worker") return {"client", "worker:ssphh.jobs.*"};
  return {"client", "admin"};
}

void keygen(const std::string& folder, const std::string& name, const std::string& role, Context& context) {
  std::filesystem::create_directories(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  const std::filesystem::path dir = folder;
  std::vector<std::string> made;
  const auto make = [&](const std::string& who) {
    const majordomo::KeyPair keys = majordomo::make_key_pair();
    majordomo::write_key_pair(dir, who, keys);
    made.push_back(who);
    return keys.public_key;
  };
  if (!std::filesystem::exists(dir / "broker.key")) make("broker");
  majordomo::add_to_allow_list(dir / "allow.txt", name, make(name), roles_of(role));
  context.result({{"folder", folder}, {"made", made}, {"role", role}},
                 fmt::format("{}: made {}.key, which may be a {}\ngive its user {}.key and broker.pub; "
                             "broker.key and allow.txt stay with the broker",
                             folder, name, role, name));
}

}  // namespace

void add_farm_commands(Command app, Context& context) {
  Command group = add_group(app, "farm", "Look after a farm: status, top, drain, parked jobs, keys");
  const auto choice = std::make_shared<BrokerChoice>();
  const auto with_broker = [&](Command command, const std::string& key) {
    add_broker_options(command, *choice, key, "Broker").required();
    return command;
  };
  with_broker(add_command(group, context, "status", "Workers, queues and counts of a broker",
                          [choice, &context] { top(*choice, 0, 1, context); }),
              "client");

  const auto interval = std::make_shared<double>(1);
  const auto count = std::make_shared<int>(0);
  Command top_command =
      with_broker(add_command(group, context, "top", "status, again and again, with rate and remaining time",
                              [=, &context] { top(*choice, *interval, *count, context); }),
                  "client");
  top_command.option("--interval", *interval, "Seconds").range(0.1, 3600.0);
  top_command.option("--count", *count, "End after so many; 0: never");

  const auto prefix = std::make_shared<std::string>();
  Command drain = with_broker(
      add_command(group, context, "drain", "Let workers finish the jobs in hand and leave",
                  [=, &context] {
                    majordomo::Client client = connect(*choice);
                    const std::string told = ask(client, "mmi.drain", *prefix, context.control);
                    context.result({{"told", std::atoi(told.c_str())}}, told + " workers were told to leave");
                  }),
      "admin");
  drain.option("--workers", *prefix, "Only those whose name begins so");

  add_farm_parked_commands(group, context);

  const auto folder = std::make_shared<std::string>("ssphh-keys");
  const auto name = std::make_shared<std::string>(), role = std::make_shared<std::string>();
  Command keys = add_command(group, context, "keygen",
                             "Make a key for a user or machine, and the broker's when there is none",
                             [=, &context] { keygen(*folder, *name, *role, context); });
  keys.option("NAME", *name, "Of the key").required();
  keys.option("--role", *role, "client (bakes, renders), worker (serves), admin (may drain)")
      .one_of({"client", "worker", "admin"})
      .required();
  keys.option("--keys", *folder, "Folder of the keys");
}

}  // namespace ssphh::app

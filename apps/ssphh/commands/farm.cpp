#include "commands/farm.h"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/farm/ask.h>
#include <ssphh/majordomo/security.h>

#include "commands/command.h"
#include "commands/farm_parked.h"

namespace ssphh::app {
namespace {

std::vector<std::string> roles_of(FarmRole role) {
  if (role == FarmRole::client) return {"client", "worker:ssphh.blobs.*"};
  if (role == FarmRole::worker) return {"client", "worker:ssphh.jobs.*"};
  return {"client", "admin"};
}

}  // namespace

FarmStatus run_farm_status(const BrokerChoice& broker, const Control& control) {
  FarmStatus status;
  run_farm_top(
      {broker, 0, 1}, [&](const FarmStatus& look) { status = look; }, control);
  return status;
}

json::Value to_json(const FarmStatus& s, const BrokerChoice&) {
  return {{"stats", s.stats}, {"workers", json::Cursor(s.workers, "mmi.workers")["workers"].value()}};
}

std::string to_text(const FarmStatus& s, const BrokerChoice&) {
  const farm::FarmFigures f = farm::figures_of(s);
  std::string text = fmt::format("{} ({} idle), {} queued, {} running, {} finished, {}, {} parked",
                                 counted(f.workers, "worker"), f.idle, counted(f.queued, "job"), f.running,
                                 f.finished, counted(f.retries, "retry", "retries"), f.parked);
  if (s.per_second) {
    text += fmt::format("\n{:.2f} jobs/s", *s.per_second);
    if (f.seconds_left) text += fmt::format(", about {:.0f} s left", *f.seconds_left);
  }
  text += fmt::format("\n{:<48} {:>7} {:>6} {:>7} {:>9}", "service", "workers", "idle", "queued", "finished");
  for (const farm::FarmFigures::Service& service : f.services) {
    text += fmt::format("\n{:<48} {:>7} {:>6} {:>7} {:>9}", service.name, service.workers, service.idle,
                        service.queued, service.finished);
  }
  text += fmt::format("\n{:<30} {:<8} {:>9} {:>7}  {}", "worker", "state", "for", "served", "service");
  for (const farm::FarmFigures::Worker& worker : f.each_worker) {
    text += fmt::format("\n{:<30} {:<8} {:>7.1f} s {:>7}  {}", worker.name, worker.state, worker.seconds,
                        worker.served, worker.service);
  }
  return text;
}

void run_farm_top(const FarmTopOptions& o, const std::function<void(const FarmStatus&)>& show,
                  const Control& control) {
  farm::StatusWatch watch(broker_address(o.broker));
  try {
    for (int i = 0; o.count == 0 || i < o.count; ++i) {
      show(watch.look(control));
      for (double waited = 0; waited < o.interval && (o.count == 0 || i + 1 < o.count); waited += 0.05) {
        control.check();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
  } catch (const Cancelled&) {
    if (o.count != 0) throw;  // without end, it is how to end it
  }
}

FarmDrainResult run_farm_drain(const FarmDrainOptions& o, const Control& control) {
  majordomo::Client client = farm::connect(broker_address(o.broker));
  return {std::atoi(farm::ask(client, "mmi.drain", o.workers, control).c_str())};
}

json::Value to_json(const FarmDrainResult& result, const FarmDrainOptions&) {
  return {{"told", result.told}};
}

std::string to_text(const FarmDrainResult& result, const FarmDrainOptions&) {
  return counted(result.told, "worker was", "workers were") + " told to leave";
}

FarmKeygenResult run_farm_keygen(const FarmKeygenOptions& o, const Control&) {
  const std::filesystem::path dir = o.folder;
  std::filesystem::create_directories(dir);
  std::filesystem::permissions(dir, std::filesystem::perms::owner_all);
  FarmKeygenResult result;
  const auto make = [&](const std::string& who) {
    const majordomo::KeyPair keys = majordomo::make_key_pair();
    majordomo::write_key_pair(dir, who, keys);
    result.made.push_back(who);
    return keys.public_key;
  };
  if (!std::filesystem::exists(dir / "broker.key")) make("broker");
  majordomo::add_to_allow_list(dir / "allow.txt", o.name, make(o.name), roles_of(o.role));
  return result;
}

json::Value to_json(const FarmKeygenResult& result, const FarmKeygenOptions& o) {
  return {{"folder", o.folder}, {"made", result.made}, {"role", name_of(o.role)}};
}

std::string to_text(const FarmKeygenResult&, const FarmKeygenOptions& o) {
  return fmt::format(
      "{}: made {}.key, which may be a {}\ngive its user {}.key and broker.pub; "
      "broker.key and allow.txt stay with the broker",
      o.folder, o.name, name_of(o.role), o.name);
}

void add_farm_commands(Command app, Context& context) {
  Command group = add_group(app, "farm", "Look after a farm: status, top, drain, parked jobs, keys");
  const auto with_broker = [](const Command& command, BrokerChoice& broker, const std::string& key) {
    add_required_broker(command.under("Broker"), broker, key);
  };
  auto [status, broker] =
      add_command(group, context, "status", "Workers, queues and counts of a broker", run_farm_status);
  with_broker(status, broker, "client");

  auto [top, looks] = add_command<FarmTopOptions>(
      group, context, "top", "status, again and again, with rate and remaining time",
      [&context](FarmTopOptions& o) {
        run_farm_top(
            o,
            [&](const FarmStatus& look) {
              if (!context.json && o.count != 1) fmt::print("\x1b[H\x1b[2J");
              context.result(to_json(look, o.broker), to_text(look, o.broker));
            },
            context.control);
      });
  with_broker(top, looks.broker, "client");
  top.option("--interval", looks.interval, "Seconds").range(0.1, 3600.0);
  top.option("--count", looks.count, "End after so many; 0: never");

  auto [drain, leaving] =
      add_command(group, context, "drain", "Let workers finish the jobs in hand and leave", run_farm_drain);
  with_broker(drain, leaving.broker, "admin");
  drain.option("--workers", leaving.workers, "Only those whose name begins so");

  add_farm_parked_commands(group, context);

  auto [keygen, key] =
      add_command(group, context, "keygen",
                  "Make a key for a user or machine, and the broker's when there is none", run_farm_keygen);
  keygen.option("NAME", key.name, "Of the key").required();
  keygen.choice("--role", key.role, "client (bakes, renders), worker (serves), admin (may drain)")
      .shown_default("")
      .required();
  keygen.option("--keys", key.folder, "Folder of the keys");
}

}  // namespace ssphh::app

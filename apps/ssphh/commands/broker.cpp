#include <csignal>
#include <iostream>
#include <memory>

#include <ssphh/core/log.h>
#include <ssphh/majordomo/broker.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

struct BrokerCommand {
  majordomo::BrokerOptions broker;
  std::string keys;
  double worker_expiry = 8, drain = 10, attempt_timeout = 3600;
  std::uint64_t frame_mb = 64, client_mb = 2048;
  bool verbose = false;
};

majordomo::Broker* running = nullptr;

extern "C" void stop_broker(int) {
  running->stop();
}

extern "C" void reload_broker(int) {
  running->reload();
}

void serve(Context& context, BrokerCommand& options) {
  majordomo::BrokerOptions broker_options = options.broker;
  if (!options.keys.empty()) broker_options.security = majordomo::read_broker_security(options.keys);
  broker_options.timers.worker_expiry = static_cast<majordomo::Millis>(options.worker_expiry * 1000);
  broker_options.timers.attempt_timeout = static_cast<majordomo::Millis>(options.attempt_timeout * 1000);
  broker_options.drain = static_cast<majordomo::Millis>(options.drain * 1000);
  broker_options.limits.frame_bytes = options.frame_mb << 20;
  broker_options.limits.client_bytes = options.client_mb << 20;
  const bool json = context.json;
  const LogLevel least = options.verbose ? LogLevel::debug : LogLevel::info;
  set_log_level(least);
  broker_options.least_event = least;
  broker_options.on_event = [json](const majordomo::BrokerEvent& event) {
    if (json) {
      std::cout << event.json() << std::endl;
    } else {
      log(event.level, event.text());
    }
  };
  majordomo::Broker broker(std::move(broker_options));
  running = &broker;
  std::signal(SIGINT, stop_broker);
  std::signal(SIGTERM, stop_broker);
  std::signal(SIGHUP, reload_broker);
  majordomo::BrokerEvent ready{LogLevel::info, "broker-ready", {{"endpoint", broker.endpoint()}}};
  if (!broker.metrics_endpoint().empty()) ready.fields.emplace_back("metrics", broker.metrics_endpoint());
  // The one line on stdout that scripts wait for.
  std::cout << (json ? ready.json() : broker.endpoint()) << std::endl;
  if (!json) log_info("{}", ready.text());
  broker.run();
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
}

}  // namespace

void add_broker_command(Command app, Context& context) {
  auto options = std::make_shared<BrokerCommand>();
  Command command =
      add_command(app, context, "broker", "Pass requests of clients to workers (Majordomo protocol)",
                  [&context, options] { serve(context, *options); });
  command.option("--bind", options->broker.bind, "Endpoint to listen on; port 0 finds a free one");
  command.option("--store", options->broker.store, "Folder in which persistent requests survive a restart");
  command.option("--keys", options->keys,
                 "Folder with broker.key and allow.txt; wanted beyond loopback and ipc");
  command.option("--metrics", options->broker.metrics_bind,
                 "Endpoint of GET /metrics for Prometheus, e.g. tcp://127.0.0.1:9464");
  command.option("--worker-expiry", options->worker_expiry, "Seconds of silence after which a worker is dead")
      .range(7.5, 86400.0);
  command
      .option("--attempt-timeout", options->attempt_timeout,
              "Seconds after which a computation counts as hung, unless the request says otherwise")
      .range(0.001, 1e6);
  command
      .option("--attempts", options->broker.limits.attempts, "Workers a job may fail on before it is parked")
      .range(1, 100);
  command.option("--drain", options->drain, "Seconds to wait for running requests at the end")
      .range(0.0, 86400.0);
  command.option("--max-frame-mb", options->frame_mb, "Largest frame, MB").range(1, 1024);
  command.option("--max-client-mb", options->client_mb, "Request bytes of one client at one time, MB")
      .range(1, 65536);
  command.flag("--verbose", options->verbose, "Log every job");
  command.footer(
      "Prints the endpoint on stdout and events on stderr (with --json: all as JSON lines on stdout).\n"
      "SIGTERM or Ctrl-C: running requests finish, then it ends; a second one ends it at once.\n"
      "SIGHUP: allow.txt is read again, as it is by itself within a second of a change.\n"
      "docs/protocol.md tells frames, timers, limits and events.");
}

}  // namespace ssphh::app

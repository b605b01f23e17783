#include "commands/broker.h"

#include <csignal>
#include <iostream>

#include <ssphh/core/log.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

majordomo::Broker* running = nullptr;

extern "C" void stop_broker(int) {
  running->stop();
}

extern "C" void reload_broker(int) {
  running->reload();
}

void stop_at_signals(majordomo::Broker& broker) {
  running = &broker;
  std::signal(SIGINT, stop_broker);
  std::signal(SIGTERM, stop_broker);
  std::signal(SIGHUP, reload_broker);
}

void ignore_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
}

/// The endpoint is the one line on stdout that scripts wait for; with JSON all events stand there.
void serve(const Context& context, const BrokerSettings& settings) {
  const auto print = [](const std::string& line) { std::cout << line << std::endl; };
  majordomo::BrokerEventSink event;
  if (context.json) event = [print](const majordomo::BrokerEvent& told) { print(told.json()); };
  set_log_level(settings.verbose ? LogLevel::debug : LogLevel::info);
  const auto ready = [&](majordomo::Broker& broker) {
    stop_at_signals(broker);
    const majordomo::BrokerEvent listens = ready_event(broker.endpoint(), broker.metrics_endpoint());
    print(context.json ? listens.json() : broker.endpoint());
    if (!context.json) log_info("{}", listens.text());
  };
  run_broker(settings, {ready, ignore_signals, event});
}

}  // namespace

void run_broker(const BrokerSettings& settings, const BrokerCalls& calls) {
  majordomo::Broker broker(broker_options(settings), calls.event);
  const struct Last {
    ~Last() {
      if (ended) ended();
    }
    const std::function<void()>& ended;
  } last{calls.ended};
  if (calls.ready) calls.ready(broker);
  broker.run();
}

void add_broker_command(Command app, Context& context) {
  auto [command, o] = add_command<BrokerSettings>(
      app, context, "broker", "Pass requests of clients to workers (Majordomo protocol)",
      [&context](BrokerSettings& settings) { serve(context, settings); });
  command.option("--bind", o.broker.bind, "Endpoint to listen on; port 0 finds a free one");
  command.option("--store", o.broker.store, "Folder in which persistent requests survive a restart");
  command.option("--keys", o.keys, "Folder with broker.key and allow.txt; wanted beyond loopback and ipc");
  command.option("--metrics", o.broker.metrics_bind,
                 "Endpoint of GET /metrics for Prometheus, e.g. tcp://127.0.0.1:9464");
  command.option("--worker-expiry", o.worker_expiry, "Seconds of silence after which a worker is dead")
      .range(7.5, 86400.0);
  command
      .option("--attempt-timeout", o.attempt_timeout,
              "Seconds after which a computation counts as hung, unless the request says otherwise")
      .range(0.001, 1e6);
  command.option("--attempts", o.broker.limits.attempts, "Workers a job may fail on before it is parked")
      .range(1, 100);
  command.option("--drain", o.drain, "Seconds to wait for running requests at the end").range(0.0, 86400.0);
  command.option("--max-frame-mb", o.frame_mb, "Largest frame, MB").range(1, 1024);
  command.option("--max-client-mb", o.client_mb, "Request bytes of one client at one time, MB")
      .range(1, 65536);
  command.flag("--verbose", o.verbose, "Log every job");
  command.footer(
      "Prints the endpoint on stdout and events on stderr (with --json: all as JSON lines on stdout).\n"
      "SIGTERM or Ctrl-C: running requests finish, then it ends; a second one ends it at once.\n"
      "SIGHUP: allow.txt is read again, as it is by itself within a second of a change.\n"
      "docs/protocol.md tells frames, timers, limits and events.");
}

}  // namespace ssphh::app

#pragma once
/// A broker in this process, and a worker of it that does what a test says.

#include <string>
#include <thread>

#include <unistd.h>

#include <ssphh/core/log.h>
#include <ssphh/farm/blob_server.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/worker.h>

namespace ssphh::farm::test {

/// What a worker without a name calls itself: HOST:PID.
inline std::string name_of_this_process() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return std::string(host) + ":" + std::to_string(::getpid());
}

/// A broker on a thread; its events are not shown.
class BrokerThread {
 public:
  BrokerThread()
      : broker_(options(), [](const majordomo::BrokerEvent&) {}), thread_([this] { broker_.run(); }) {}
  ~BrokerThread() {
    broker_.stop();
    broker_.stop();
    thread_.join();
  }
  BrokerAddress address() const { return {broker_.endpoint(), std::nullopt}; }

 private:
  static majordomo::BrokerOptions options() {
    majordomo::BrokerOptions options;
    options.bind = "tcp://127.0.0.1:0";
    return options;
  }
  majordomo::Broker broker_;
  std::thread thread_;
};

/// Serves one service with `handler` until its end.
class ServiceThread {
 public:
  ServiceThread(const BrokerAddress& broker, const std::string& service, majordomo::Handler handler)
      : worker_(options(broker, service)), thread_([this, handler] { worker_.run(handler); }) {}
  ~ServiceThread() {
    worker_.stop();
    thread_.join();
  }

 private:
  static majordomo::WorkerOptions options(const BrokerAddress& broker, const std::string& service) {
    majordomo::WorkerOptions options;
    options.endpoint = broker.endpoint;
    options.service = service;
    return options;
  }
  majordomo::Worker worker_;
  std::thread thread_;
};

struct Quiet {
  Quiet() { set_log_level(LogLevel::error); }
  ~Quiet() { set_log_level(LogLevel::info); }
};

}  // namespace ssphh::farm::test

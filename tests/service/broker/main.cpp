/// quick_broker ENDPOINT BEAT: our broker with another heartbeat, in milliseconds, so that its times can be
/// probed quickly. As by default, a worker may be silent for 3.2 of them.

#include <cstdlib>
#include <exception>
#include <iostream>

#include <signal.h>

#include <ssphh/majordomo/broker.h>

namespace {

ssphh::majordomo::Broker* running = nullptr;

extern "C" void stop(int) {
  running->stop();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    ssphh::majordomo::BrokerOptions options;
    options.bind = argv[1];
    options.timers.heartbeat = std::atoi(argv[2]);
    options.timers.worker_expiry = options.timers.heartbeat * 16 / 5;
    ssphh::majordomo::Broker broker(std::move(options));
    running = &broker;
    ::signal(SIGTERM, stop);
    broker.run();
    ::signal(SIGTERM, SIG_IGN);
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
  return 0;
}

/// Checks of what takes heartbeats of time. Their length is the broker's: 2.5 s with those of the guide.

#include <algorithm>
#include <atomic>

#include "checks.h"
#include "peer.h"

namespace ssphh::probe {
namespace {

using Clock = std::chrono::steady_clock;

/// How late this machine wakes a thread that sleeps.
class Lateness {
 public:
  Lateness() : thread_([this] { measure(); }) {}
  ~Lateness() { end(); }
  Milliseconds end() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    return worst_;
  }

 private:
  void measure() {
    while (!ended_) {
      const auto due = Clock::now() + Milliseconds(5);
      std::this_thread::sleep_until(due);
      worst_ = std::max(worst_, std::chrono::duration_cast<Milliseconds>(Clock::now() - due));
    }
  }
  std::atomic<bool> ended_{false};
  Milliseconds worst_{0};
  std::thread thread_;
};

using Timed = bool (*)(const std::string& endpoint, const std::string& service, int beat);

/// A failure counts when the machine kept time to a tenth of a heartbeat; else it is tried again.
std::function<bool(const std::string&)> timed(const char* service, int beat, Timed check) {
  return [=](const std::string& endpoint) {
    constexpr int tries = 20;
    for (int i = 0; i < tries; ++i) {
      Lateness lateness;
      if (check(endpoint, std::string(service) + std::to_string(i), beat)) return true;
      if (lateness.end() * 10 < Milliseconds(beat)) return false;
    }
    return false;
  };
}

bool idle(const std::string& e, const std::string& service, int beat) {
  Worker01 worker(e, service);
  return worker.receive(Milliseconds(2 * beat)) == heartbeat01 &&
         worker.receive(Milliseconds(2 * beat)) == heartbeat01;
}

bool busy(const std::string& e, const std::string& service, int beat) {
  Worker02 worker(e, service);
  Peer client(e);
  client.send(request02(service, {"a"}));
  return worker.job() && worker.receive(Milliseconds(2 * beat)) == heartbeat02 &&
         worker.receive(Milliseconds(2 * beat)) == heartbeat02;
}

bool patience(const std::string& e, const std::string& service, int beat) {
  Worker01 worker(e, service);
  pause(29 * beat / 10);
  return mmi_status(e, service, "200");
}

bool expiry(const std::string& e, const std::string& service, int beat) {
  Worker01 worker(e, service);
  return mmi_status(e, service, "200", 50) && (pause(38 * beat / 10), mmi_status(e, service, "404", 5));
}

bool silent_busy_worker(const std::string& e, const std::string& service, int beat) {
  Peer client(e);
  Worker01 silent(e, service);
  client.send(request01(service, {"a"}));
  if (!silent.job()) return false;
  pause(36 * beat / 10);
  Worker01 second(e, service);
  if (!second.job(Milliseconds(beat))) return false;
  silent.reply({"after all"});  // its answer is still welcome, and the second is not heard
  if (client.receive() != Frames{"", "MDPC01", service, "after all"}) return false;
  second.reply({"again"});
  return client.receive(Milliseconds(300)).empty();
}

/// One DISCONNECT, and nothing after it: no heartbeat either.
std::function<bool(const std::string&)> refuses(int beat, Frames first, Frames answer) {
  return [=](const std::string& e) {
    Peer worker(e);
    worker.send(first);
    return worker.receive() == answer && worker.receive(Milliseconds(12 * beat / 10)).empty();
  };
}

}  // namespace

std::vector<Check> times(int beat) {
  return {
      {"heartbeats to idle workers", "7/MDP", timed("p.idle", beat, idle)},
      {"heartbeats to busy workers", "18/MDP", timed("p.busy", beat, busy)},
      {"a worker silent for 2.9 heartbeats is alive", "7/MDP", timed("p.patience", beat, patience)},
      {"a worker silent for 3.8 heartbeats is gone", "7/MDP", timed("p.expiry", beat, expiry)},
      {"HEARTBEAT before READY (0.1): one DISCONNECT", "7/MDP", refuses(beat, heartbeat01, disconnect01)},
      {"HEARTBEAT before READY (0.2): one DISCONNECT", "18/MDP", refuses(beat, heartbeat02, disconnect02)},
      {"REPLY before READY: one DISCONNECT", "7/MDP",
       refuses(beat, {"", "MDPW01", "\x03", "nobody", "", "x"}, disconnect01)},
      {"registering in mmi.: DISCONNECT", "8/MMI",
       refuses(beat, {"", "MDPW01", "\x01", "mmi.service"}, disconnect01)},
      {"busy worker falls silent: copy elsewhere, first answer wins", "dependable",
       timed("p.silent", beat, silent_busy_worker)},
  };
}

}  // namespace ssphh::probe

/// Requests per second and latency through the broker, beside a bare zmq_proxy of the same topology and, when
/// $SSPHH_MDBROKER names the guide's mdbroker (it listens on $SSPHH_MDBROKER_ENDPOINT, default
/// tcp://127.0.0.1:5555), that one. Peers are the same raw 7/MDP frames for all.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include <ssphh/majordomo/broker.h>

namespace {

using namespace ssphh::majordomo;
using Clock = std::chrono::steady_clock;

enum Kind { ours, bare, guide };
const char* const kind_names[] = {"ssphh", "zmq_proxy", "guide"};

void send(zmq::socket_t& socket, const Frames& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i)
    socket.send(zmq::buffer(frames[i]),
                i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
}

Frames receive(zmq::socket_t& socket) {
  Frames frames;
  zmq::message_t part;
  do {
    if (!socket.recv(part)) return {};
    frames.push_back(part.to_string());
  } while (part.more());
  return frames;
}

zmq::socket_t dealer(zmq::context_t& context, const std::string& endpoint, int timeout) {
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.set(zmq::sockopt::linger, 0);
  socket.set(zmq::sockopt::rcvtimeo, timeout);
  socket.set(zmq::sockopt::sndhwm, 0);
  socket.set(zmq::sockopt::rcvhwm, 0);
  socket.connect(endpoint);
  return socket;
}

/// What clients and workers connect to: a process of its own, whose CPU time tells the work of a request also
/// where other programs disturb the clock.
class Middle {
 public:
  explicit Middle(Kind kind) : mdp(kind != bare) {
    int ends[2];
    if (::pipe(ends) != 0) std::abort();
    pid_ = ::fork();
    if (pid_ == 0) {
      if (kind == ours) serve_broker(ends[1]);
      if (kind == bare) serve_proxy(ends[1]);
      const char* path = std::getenv("SSPHH_MDBROKER");
      ::execl(path, path, nullptr);
      ::_exit(127);
    }
    if (kind == guide) {
      const char* endpoint = std::getenv("SSPHH_MDBROKER_ENDPOINT");
      front = back = endpoint ? endpoint : "tcp://127.0.0.1:5555";
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    } else {
      char text[200] = {};
      if (::read(ends[0], text, sizeof text - 1) < 1) std::abort();
      front = text, back = std::strchr(text, ' ') + 1;
      front.resize(front.find(' '));
    }
    ::close(ends[0]), ::close(ends[1]);
  }
  ~Middle() {
    if (pid_ > 0) cpu_seconds();
  }
  /// Of the whole process; ends it.
  double cpu_seconds() {
    ::kill(std::exchange(pid_, -1), SIGKILL);
    rusage usage{};
    ::wait4(-1, nullptr, 0, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }

  const bool mdp;
  std::string front, back;

 private:
  static void tell(int end, const std::string& text) {
    if (::write(end, text.c_str(), text.size() + 1) < 0) ::_exit(1);
  }
  [[noreturn]] static void serve_broker(int end) {
    Broker broker({.bind = "tcp://127.0.0.1:0"}, [](const BrokerEvent&) {});
    tell(end, broker.endpoint() + " " + broker.endpoint());
    broker.run();
    ::_exit(0);
  }
  [[noreturn]] static void serve_proxy(int end) {
    zmq::context_t context;
    zmq::socket_t router(context, zmq::socket_type::router), out(context, zmq::socket_type::dealer);
    for (zmq::socket_t* socket : {&router, &out}) {
      socket->set(zmq::sockopt::sndhwm, 0);
      socket->set(zmq::sockopt::rcvhwm, 0);
      socket->bind("tcp://127.0.0.1:*");
    }
    tell(end, router.get(zmq::sockopt::last_endpoint) + " " + out.get(zmq::sockopt::last_endpoint));
    zmq::proxy(router, out);
    ::_exit(0);
  }
  pid_t pid_;
};

/// Echoes until it is asked to end by a body "end".
void work(zmq::context_t& context, const Middle& middle) {
  zmq::socket_t socket = dealer(context, middle.back, 10'000);
  if (middle.mdp) send(socket, {"", "MDPW01", "\x01", "echo"});
  while (true) {
    Frames frames = receive(socket);
    if (frames.empty()) return;
    if (middle.mdp && frames.at(2) == "\x05") return;
    if (middle.mdp && frames.at(2) != "\x02") continue;
    const bool end = frames.back() == "end";
    if (middle.mdp) frames[2] = "\x03";
    send(socket, frames);
    if (end && middle.mdp) send(socket, {"", "MDPW01", "\x05"});
    if (end) {
      socket.set(zmq::sockopt::linger, 200);
      return;
    }
  }
}

void round_trips(benchmark::State& state) {
  const Kind kind = static_cast<Kind>(state.range(0));
  const auto window = static_cast<std::size_t>(state.range(1));
  const std::string body(static_cast<std::size_t>(state.range(2)), 'x');
  const auto workers = static_cast<std::size_t>(state.range(3));
  if (kind == guide && !std::getenv("SSPHH_MDBROKER"))
    return state.SkipWithError("SSPHH_MDBROKER is not set");
  state.SetLabel(kind_names[kind]);
  const std::size_t count = window == 1 ? 2000 : 10'000;
  Middle middle(kind);
  zmq::context_t context;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < workers; ++i) threads.emplace_back([&] { work(context, middle); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  zmq::socket_t client = dealer(context, middle.front, 10'000);
  // The same four frames through the proxy, which looks at none of them.
  const auto request = [&](const std::string& content) { send(client, {"", "MDPC01", "echo", content}); };
  std::vector<double> latencies;
  for (auto _ : state) {
    std::map<std::size_t, Clock::time_point> began;
    const auto start = Clock::now();
    std::size_t sent = 0, done = 0;
    std::vector<Clock::time_point> times;
    while (done < count) {
      while (sent < count && sent - done < window) {
        times.push_back(Clock::now());
        request(body);
        ++sent;
      }
      if (receive(client).empty()) {
        state.SkipWithError("a reply was lost");
        break;
      }
      // With several workers replies overtake each other; the k-th reply is set against the k-th request.
      latencies.push_back(std::chrono::duration<double, std::micro>(Clock::now() - times[done]).count());
      ++done;
    }
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  for (std::size_t i = 0; i < workers; ++i) request("end");
  for (std::thread& thread : threads) thread.join();
  const double cpu = middle.cpu_seconds();
  std::sort(latencies.begin(), latencies.end());
  if (latencies.empty()) return;
  state.counters["requests_per_s"] =
      benchmark::Counter(static_cast<double>(count * state.iterations()), benchmark::Counter::kIsRate);
  state.counters["broker_cpu_us"] = 1e6 * cpu / static_cast<double>(count * state.iterations());
  state.counters["p50_us"] = latencies[latencies.size() / 2];
  state.counters["p99_us"] = latencies[latencies.size() * 99 / 100];
}
BENCHMARK(round_trips)
    ->ArgNames({"broker", "window", "bytes", "workers"})
    ->ArgsProduct({{ours, bare, guide}, {1, 200}, {100, 4096}, {1, 16}})
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

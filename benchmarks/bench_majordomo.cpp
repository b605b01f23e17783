/// Requests per second and latency through the broker, beside a bare zmq_proxy of the same topology and, when
/// $SSPHH_MDBROKER names the guide's mdbroker (it listens on $SSPHH_MDBROKER_ENDPOINT, default
/// tcp://127.0.0.1:5555), that one; and what a long queue costs. Peers are the same raw 7/MDP frames for all.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/broker_core.h>

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

/// What clients and workers connect to.
struct Middle {
  virtual ~Middle() = default;
  std::string front, back;
  bool mdp = true;
};

struct OurBroker : Middle {
  OurBroker() : broker({.bind = "tcp://127.0.0.1:0", .on_event = [](const BrokerEvent&) {}}) {
    front = back = broker.endpoint();
    thread = std::thread([this] { broker.run(); });
  }
  ~OurBroker() override {
    broker.stop();
    broker.stop();
    thread.join();
  }
  Broker broker;
  std::thread thread;
};

struct Proxy : Middle {
  Proxy()
      : router(context, zmq::socket_type::router),
        out(context, zmq::socket_type::dealer),
        control(context, zmq::socket_type::pair),
        peer(context, zmq::socket_type::pair) {
    for (zmq::socket_t* socket : {&router, &out}) {
      socket->set(zmq::sockopt::linger, 0);
      socket->set(zmq::sockopt::sndhwm, 0);
      socket->set(zmq::sockopt::rcvhwm, 0);
      socket->bind("tcp://127.0.0.1:*");
    }
    control.bind("inproc://control");
    peer.connect("inproc://control");
    front = router.get(zmq::sockopt::last_endpoint);
    back = out.get(zmq::sockopt::last_endpoint);
    mdp = false;
    thread = std::thread(
        [this] { zmq_proxy_steerable(router.handle(), out.handle(), nullptr, control.handle()); });
  }
  ~Proxy() override {
    peer.send(zmq::str_buffer("TERMINATE"), zmq::send_flags::none);
    thread.join();
  }
  zmq::context_t context;
  zmq::socket_t router, out, control, peer;
  std::thread thread;
};

struct GuideBroker : Middle {
  GuideBroker() {
    const char* endpoint = std::getenv("SSPHH_MDBROKER_ENDPOINT");
    front = back = endpoint ? endpoint : "tcp://127.0.0.1:5555";
    const char* path = std::getenv("SSPHH_MDBROKER");
    pid = ::fork();
    if (pid == 0) {
      ::execl(path, path, nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  ~GuideBroker() override {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
  }
  pid_t pid;
};

std::unique_ptr<Middle> make(Kind kind) {
  if (kind == ours) return std::make_unique<OurBroker>();
  if (kind == bare) return std::make_unique<Proxy>();
  return std::make_unique<GuideBroker>();
}

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
  const auto middle = make(kind);
  zmq::context_t context;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < workers; ++i) threads.emplace_back([&] { work(context, *middle); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  zmq::socket_t client = dealer(context, middle->front, 10'000);
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
  std::sort(latencies.begin(), latencies.end());
  if (latencies.empty()) return;
  state.counters["requests_per_s"] =
      benchmark::Counter(static_cast<double>(count * state.iterations()), benchmark::Counter::kIsRate);
  state.counters["p50_us"] = latencies[latencies.size() / 2];
  state.counters["p99_us"] = latencies[latencies.size() * 99 / 100];
}
BENCHMARK(round_trips)
    ->ArgNames({"broker", "window", "bytes", "workers"})
    ->ArgsProduct({{ours, bare, guide}, {1, 200}, {100, 4096}, {1, 16}})
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

/// The state machine alone: `queued` requests of ten clients wait, then 1000 workers come and answer them
/// all.
void long_queue(benchmark::State& state) {
  const auto queued = static_cast<int>(state.range(0));
  constexpr int workers = 1000;
  double bytes = 0;
  for (auto _ : state) {
    const auto before = mallinfo2().uordblks;
    std::uint64_t n = 0;
    BrokerCore core({}, {}, [&n] {
      ++n;
      return std::array<std::uint64_t, 2>{n * 0x9e3779b97f4a7c15ull, n};
    });
    Millis now = 0;
    const auto start = Clock::now();
    for (int i = 0; i < queued; ++i) {
      now = i / 100;
      core.receive(now, "client" + std::to_string(i % 10), {"", "MDPC01", "echo", std::string(100, 'x')});
    }
    bytes = static_cast<double>(mallinfo2().uordblks - before) / queued;
    for (int i = 0; i < workers; ++i)
      core.receive(now, "w" + std::to_string(i), {"", "MDPW01", "\x01", "echo"});
    int answered = 0;
    while (answered < queued) {
      const BrokerOutputs out = core.take();
      for (const Outgoing& message : out.messages) {
        if (message.head.at(1) == "MDPC01") ++answered;
        if (message.head.at(1) == "MDPW01" && message.head.at(2) == "\x02")
          core.receive(now, message.peer, {"", "MDPW01", "\x03", message.head.at(3), "", "reply"});
      }
      ++now;
      if (core.next_deadline() <= now) core.tick(now);
    }
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  state.counters["requests_per_s"] = benchmark::Counter(
      static_cast<double>(queued) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["bytes_per_request"] = bytes;
}
BENCHMARK(long_queue)
    ->ArgName("queued")
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

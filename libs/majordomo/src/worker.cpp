#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>
#include <ssphh/majordomo/worker.h>

#include "socket.h"
#include "worker_core.h"

namespace ssphh::majordomo {
namespace {

std::string default_name() {
  char host[64] = "worker";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{}:{}", host, ::getpid());
}

bool is_name(const std::string& name) {
  if (name.empty() || name.size() > 100) return false;
  for (const char c : name) {
    const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (!letter && std::string_view("._:/-").find(c) == std::string_view::npos) return false;
  }
  return true;
}

}  // namespace

struct Worker::Impl {
  explicit Impl(WorkerOptions&& o) : options(std::move(o)), core(options) {}

  // The I/O thread owns the socket and the core; the two threads share what the mutex guards.
  void io();
  void open();
  void hand_over();

  WorkerOptions options;
  WorkerCore core;
  zmq::context_t context;
  zmq::socket_t socket;
  std::vector<ToBroker> unsent;
  Wakeup wakeup;
  std::atomic<bool> stopping{false}, abandoning{false};
  std::atomic<std::uint64_t> served{0};

  std::mutex mutex;
  std::condition_variable changed;
  std::optional<Message> job;
  std::optional<Token> token;
  std::vector<Frames> partials;
  std::optional<JobResult> result;
  CancelToken* cancel = nullptr;
  bool ended = false;
  std::exception_ptr failure;
};

void Worker::Impl::open() {
  socket = peer_socket(context, Side::worker, options.security);
  if (options.dialect == Dialect::own)
    socket.set(zmq::sockopt::routing_id, std::string(own_worker_prefix) + options.name + "#" + random_name());
  connect(socket, options.endpoint, options.security.has_value());
  core.connected(steady_now());
}

// Between the threads: what the handler made goes to the core, what the core was given goes to the handler.
void Worker::Impl::hand_over() {
  const Millis now = steady_now();
  std::lock_guard lock(mutex);
  for (Frames& part : partials) core.partial(now, std::move(part));
  partials.clear();
  if (result) core.done(now, *std::exchange(result, std::nullopt));
  if (stopping) core.stop(now);
  if (cancel && (abandoning || core.cancelled())) cancel->request();
  if (auto next = core.take_job()) {
    token = core.token();
    job = std::move(next);
    changed.notify_all();
  }
}

void Worker::Impl::io() {
  try {
    while (!core.finished()) {
      hand_over();
      const auto flush = [&] {
        for (ToBroker& message : core.take()) unsent.push_back(std::move(message));
        std::size_t sent = 0;
        while (socket && sent < unsent.size() &&
               send_message(socket, nullptr, unsent[sent].head, unsent[sent].body) == Sent::yes)
          ++sent;
        unsent.erase(unsent.begin(), unsent.begin() + static_cast<std::ptrdiff_t>(sent));
      };
      flush();
      if (core.finished()) break;
      if (socket && core.wants_close()) {
        socket.set(zmq::sockopt::linger, 0);
        socket.close();
        unsent.clear();
      }
      Millis now = steady_now();
      if (!socket && core.connect_at().value_or(Timers::never) <= now) {
        open();
        flush();
        now = steady_now();
      }
      const Millis wait = std::clamp<Millis>(core.next_deadline() - now, 0, 60'000);
      zmq::pollitem_t items[] = {
          {nullptr, wakeup.fd(), ZMQ_POLLIN, 0},
          {socket.handle(), 0, static_cast<short>(unsent.empty() ? ZMQ_POLLIN : ZMQ_POLLIN | ZMQ_POLLOUT),
           0}};
      try {
        zmq::poll(items, socket ? 2 : 1, std::chrono::milliseconds(wait));
      } catch (const zmq::error_t& e) {
        if (e.num() != EINTR) throw;
      }
      wakeup.clear();
      now = steady_now();
      while (socket) {
        auto message = receive_message(socket);
        if (!message) break;
        core.receive(now, std::move(message->frames));
      }
      core.tick(now);
    }
    socket.close();  // lingers until the DISCONNECT is out
  } catch (...) {
    std::lock_guard lock(mutex);
    failure = std::current_exception();
  }
  std::lock_guard lock(mutex);
  ended = true;
  if (cancel) cancel->request();
  changed.notify_all();
}

Worker::Worker(WorkerOptions options) {
  if (options.name.empty()) options.name = default_name();
  if (!is_name(options.name))
    throw Error("worker name", "has characters other than A-Za-z0-9._:/- or more than 100", "choose another");
  if (!is_service_name(options.service))
    throw Error("service name", "is empty, too long or not printable", "use 1 to 255 ASCII characters");
  require_keys(options.endpoint, options.security.has_value(), "broker endpoint");
  if (options.security) require_keys_of("broker endpoint", *options.security);
  require_pause(options.heartbeat, "worker", "its heartbeat would have no pause");
  require_pause(options.broker_expiry, "worker", "its broker expiry would end every connection at once");
  require_pause(options.reconnect, "worker", "it would reconnect without a pause");
  require_pause(options.reconnect_max, "worker", "it would reconnect without a pause");
  require(options.reconnect <= options.reconnect_max, "worker", "reconnect is over reconnect_max");
  impl_ = std::make_unique<Impl>(std::move(options));
}

Worker::~Worker() = default;

void Worker::run(const Handler& handler) {
  require(handler != nullptr, "worker", "there is no handler");
  Impl& s = *impl_;
  std::thread io([&s] { s.io(); });
  std::unique_lock lock(s.mutex);
  while (true) {
    s.changed.wait(lock, [&] { return s.job || s.ended; });
    if (s.ended) break;
    const Message message = *std::exchange(s.job, std::nullopt);
    const std::optional<Token> token = s.token;
    CancelToken cancel;
    s.cancel = &cancel;
    lock.unlock();

    Job job{.body = message.body, .cancel = &cancel, .partial = {}};
    if (token) job.number = token->job, job.attempt = token->attempt;
    job.partial = [&s](Frames frames) {
      std::lock_guard guard(s.mutex);
      s.partials.push_back(std::move(frames));
      s.wakeup.notify();
    };
    JobResult result;
    try {
      result.body = handler(job);
    } catch (const Cancelled&) {
      result = {.outcome = Outcome::cancelled};
    } catch (const Error& e) {
      result = {.outcome = Outcome::failed, .reason = e.what()};
    } catch (const std::exception& e) {
      result = {.outcome = Outcome::failed, .retry = true, .reason = e.what()};
    } catch (...) {
      result = {.outcome = Outcome::failed, .retry = true, .reason = "the handler threw no std::exception"};
    }

    lock.lock();
    s.cancel = nullptr;
    s.result = std::move(result);
    ++s.served;
    s.wakeup.notify();
  }
  lock.unlock();
  io.join();
  if (s.failure) std::rethrow_exception(s.failure);
}

void Worker::stop() noexcept {
  impl_->stopping = true;
  impl_->wakeup.notify();
}

void Worker::abandon() noexcept {
  impl_->abandoning = true;
  stop();
}

std::uint64_t Worker::served() const {
  return impl_->served;
}

}  // namespace ssphh::majordomo

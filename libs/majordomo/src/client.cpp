#include <algorithm>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/majordomo/client.h>

#include "client_core.h"
#include "socket.h"

namespace ssphh::majordomo {
namespace {

constexpr Millis look = 100;          // how often `call` looks whether it is cancelled
constexpr Millis knock_again = 2000;  // ZeroMQ gives a connection up whose key was refused; lists change

constexpr int watched = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_AUTH | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                        ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;

}  // namespace

struct Client::Impl {
  explicit Impl(ClientOptions&& o) : options(std::move(o)), core(options, RequestId::random) {
    require_keys(options.endpoint, options.security.has_value(), "broker endpoint");
    open();
  }

  ~Impl() {
    try {
      for (const RequestId& id : core.to_cancel()) core.cancel(steady_now(), id);
      core.tick(steady_now());
      flush();
    } catch (const std::exception&) {
      // No socket, no memory: the broker cancels after its grace for clients that are gone.
    }
    if (monitor) monitor.close();
    socket.close();
  }

  void open() {
    if (monitor) monitor.close();
    if (socket) {
      socket.set(zmq::sockopt::linger, 0);
      socket.close();
    }
    unsent.clear();
    socket = peer_socket(context, Side::client, options.security);
    socket.set(zmq::sockopt::rcvhwm, 0);  // what we asked for is bounded by the window
    const std::string name = "inproc://monitor-" + random_name();
    zmq_socket_monitor(socket.handle(), name.c_str(), watched);
    monitor = zmq::socket_t(context, zmq::socket_type::pair);
    monitor.connect(name);
    up = false;
    knock_at = Timers::never;
    connect(socket, options.endpoint, options.security.has_value());
  }

  void hear_monitor(Millis now) {
    while (const auto news = receive_message(monitor)) {
      std::uint16_t event = 0;
      if (news->frames[0].size() < sizeof event) continue;
      std::memcpy(&event, news->frames[0].data(), sizeof event);
      if (event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
        up = true;
        core.connected(now);
      } else if (event == ZMQ_EVENT_DISCONNECTED) {
        up = false;
      } else {
        knock_at = now + knock_again;
        if (!std::exchange(warned, true))
          log_warning(
              "{}: the broker refuses the connection; is this key in its allow.txt, and broker.pub its own? "
              "Still trying",
              options.endpoint);
      }
    }
  }

  void flush() {
    if (core.take_reconnect()) open();
    for (ToBroker& message : core.take()) unsent.push_back(std::move(message));
    while (!unsent.empty()) {
      if (send_message(socket, nullptr, unsent.front().head, unsent.front().body) != Sent::yes) break;
      unsent.pop_front();
    }
  }

  /// Sends, waits at most `timeout`, hears.
  void step(Millis timeout) {
    Millis now = steady_now();
    if (knock_at <= now) open();
    core.tick(now);
    flush();
    const Millis due = std::min(core.next_deadline(), knock_at);
    const Millis wait = std::clamp<Millis>(std::min(timeout, due - now), 0, 60'000);
    zmq::pollitem_t items[] = {
        {socket.handle(), 0, static_cast<short>(unsent.empty() ? ZMQ_POLLIN : ZMQ_POLLIN | ZMQ_POLLOUT), 0},
        {monitor.handle(), 0, ZMQ_POLLIN, 0}};
    try {
      zmq::poll(items, 2, std::chrono::milliseconds(wait));
    } catch (const zmq::error_t& e) {
      if (e.num() != EINTR) throw;
    }
    now = steady_now();
    hear_monitor(now);
    while (auto message = receive_message(socket)) core.receive(now, std::move(message->frames));
    core.tick(now);
    flush();
  }

  ClientOptions options;
  zmq::context_t context;
  zmq::socket_t socket, monitor;
  ClientCore core;
  std::deque<ToBroker> unsent;
  std::deque<ClientEvent> kept;  ///< of other requests, while call() waits for its own
  Millis knock_at = Timers::never;
  bool up = false, warned = false;
};

Client::Client(ClientOptions options) {
  require(options.window >= 1, "client", "its window is 1 request at least");
  require_pause(options.ask_again, "client", "it would ask the broker again without a pause");
  require_pause(options.foreign_timeout, "client", "it would ask a foreign broker again without a pause");
  require(options.foreign_tries >= 1, "client", "it asks a foreign broker once at least");
  if (options.security) require_keys_of("broker endpoint", *options.security);
  impl_ = std::make_unique<Impl>(std::move(options));
}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

RequestId Client::submit(const std::string& service, Frames body, const RequestOptions& options) {
  if (!is_service_name(service))
    throw Error("service name", "is empty, too long or not printable", "use 1 to 255 ASCII characters");
  const auto in_range = [](Millis time) { return time >= 0 && time <= most_millis; };
  require(in_range(options.deadline), "request", "its deadline is before now or after most_millis");
  require(in_range(options.attempt_timeout), "request", "its attempt_timeout is under 0 or over most_millis");
  const RequestId id = impl_->core.submit(steady_now(), service, std::move(body), options);
  impl_->flush();
  return id;
}

void Client::cancel(const RequestId& id) {
  impl_->core.cancel(steady_now(), id);
  impl_->flush();
}

std::optional<ClientEvent> Client::poll(Millis timeout) {
  Impl& s = *impl_;
  if (!s.kept.empty()) {
    ClientEvent event = std::move(s.kept.front());
    s.kept.pop_front();
    return event;
  }
  const Millis end = timeout < 0 ? Timers::never : steady_now() + std::min(timeout, most_millis);
  while (true) {
    if (auto event = s.core.next_event()) return event;
    if (s.core.outstanding() == 0) {
      s.step(0);  // acknowledgements
      return s.core.next_event();
    }
    const Millis now = steady_now();
    s.step(end == Timers::never ? 60'000 : std::max<Millis>(0, end - now));
    if (auto event = s.core.next_event()) return event;
    if (steady_now() >= end) return std::nullopt;
  }
}

std::size_t Client::outstanding() const {
  const auto kept = std::ranges::count_if(impl_->kept, [](const ClientEvent& e) { return e.final; });
  return impl_->core.outstanding() + static_cast<std::size_t>(kept);
}

bool Client::connected() const {
  return impl_->up && impl_->core.heard();
}

Frames Client::call(const std::string& service, Frames body, const RequestOptions& options,
                    const Control& control) {
  Impl& s = *impl_;
  const RequestId id = submit(service, std::move(body), options);
  Frames whole;
  while (true) {
    if (control.cancelled()) {
      cancel(id);
      while (auto event = s.core.next_event())
        if (!(event->id == id)) s.kept.push_back(std::move(*event));
      throw Cancelled();
    }
    s.step(control.cancel ? look : 60'000);
    while (auto event = s.core.next_event()) {
      if (!(event->id == id)) {
        s.kept.push_back(std::move(*event));
        continue;
      }
      whole.insert(whole.end(), std::make_move_iterator(event->body.begin()),
                   std::make_move_iterator(event->body.end()));
      if (!event->final) continue;
      if (event->outcome == Outcome::ok) return whole;
      throw Error(service, std::string(name_of(event->outcome)) + ": " + event->reason,
                  "the broker's log and `mmi.parked` tell more");
    }
  }
}

}  // namespace ssphh::majordomo

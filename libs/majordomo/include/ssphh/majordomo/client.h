#pragma once
/// A client of a Majordomo broker: sends requests, gets each one's reply exactly once.
///
/// Against our broker it speaks 18/MDP with an envelope (docs/protocol.md): requests carry an id and a
/// deadline, survive lost connections and broker restarts (they are sent again under the same id and answered
/// once), can be cancelled, and wait while the broker is busy. Against foreign brokers (`Dialect::mdp01`,
/// `mdp02`) the frames are exactly the RFC's, with one request in flight at a time; a reply that is late is
/// asked for again on a new socket.

#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/core/held.h>
#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {

enum class Dialect {
  own,    ///< 18/MDP 0.2 and our envelope; our broker only
  mdp01,  ///< 7/MDP as the guide's programs speak it
  mdp02,  ///< 18/MDP, RFC text
};

struct ClientOptions {
  std::string endpoint = {};  ///< "tcp://127.0.0.1:5555", "ipc:///path"; plain only where is_local_endpoint
  std::optional<PeerSecurity> security = {};
  Dialect dialect = Dialect::own;
  std::size_t window = 1000;  ///< requests on their way at one time; further ones wait here
  Millis ask_again = 2500;    ///< after this long without news, ask whether the broker still has a request
  Millis foreign_timeout = 2500;  ///< foreign dialects: a reply later than this is asked for again
  int foreign_tries = 3;          ///< and after so many times the request has failed
};

struct RequestOptions {
  Millis deadline = 0;         ///< from now, up to most_millis; 0: none. Then the outcome is `expired`
  Millis attempt_timeout = 0;  ///< of one attempt on one worker, up to most_millis; 0: the broker's default
  /// Requests to one service with equal key and equal body are computed once while in flight.
  std::optional<Hash128> content_key = {};
  bool persistent = false;  ///< survives broker restarts and this client; wants a broker with a store
  std::optional<RequestId> id =
      {};  ///< a fresh one unless given; an id known to the broker joins that request
};

enum class Outcome : std::uint8_t {
  ok = 0,
  failed = 1,     ///< the worker says that this request cannot be done, here or elsewhere
  parked = 2,     ///< took down or hung on too many workers and was set aside; the reason tells each
  cancelled = 3,  ///< by this client or an administrator
  expired = 4,    ///< the deadline passed
  refused = 5,    ///< not allowed, malformed or beyond a limit that waiting does not help
  no_answer = 6,  ///< foreign broker did not answer
};
constexpr auto enum_table(Outcome) {
  using enum Outcome;
  return std::to_array<EnumName<Outcome>>({{ok, "ok"},
                                           {failed, "failed"},
                                           {parked, "parked"},
                                           {cancelled, "cancelled"},
                                           {expired, "expired"},
                                           {refused, "refused"},
                                           {no_answer, "no answer"}});
}

/// One piece of news about one request: any number of PARTIALs in order, then one FINAL.
struct ClientEvent {
  RequestId id = {};
  bool final = true;
  Outcome outcome = Outcome::ok;
  Frames body = {};         ///< the worker's frames; empty unless ok
  std::string reason = {};  ///< for people; empty when ok
  int attempts = 0;         ///< workers that were given the request, as far as the broker tells
};

/// Not thread-safe: one per thread. Heartbeats need no help from the caller; the connection is kept by
/// ZeroMQ's own thread, so long computations between calls of `poll` do no harm.
class Client {
 public:
  /// Throws Error for a bad endpoint or a plain one that is not local, for keys that are none and for options
  /// that would send nothing or ask without a pause. A broker that is not there yet is no
  /// error: requests wait.
  explicit Client(ClientOptions options);
  /// Cancels what is outstanding and not persistent.
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  /// Queues a request; never blocks. Throws Error for a service name that is empty, too long or unprintable,
  /// and for times out of range.
  RequestId submit(const std::string& service, Frames body, const RequestOptions& options = {});
  /// The request's outcome will be `cancelled` unless it is finished already; unknown ids are ignored.
  void cancel(const RequestId& id);
  /// The next event, waiting at most `timeout` (0: not at all, negative: without end while requests are
  /// outstanding). None on timeout or when nothing is outstanding.
  std::optional<ClientEvent> poll(Millis timeout);
  /// Requests without a FINAL event yet.
  std::size_t outstanding() const;
  /// Whether the broker was heard on the present connection.
  bool connected() const;

  /// Submits and waits for this request alone; its PARTIALs are folded into the body, other requests' events
  /// are kept for `poll`. Throws Error unless the outcome is ok (where: the service; problem: outcome and
  /// reason) and Cancelled when `control` is cancelled.
  Frames call(const std::string& service, Frames body, const RequestOptions& options = {},
              const Control& control = {});

 private:
  struct Impl;
  Held<Impl> impl_;
};

}  // namespace ssphh::majordomo

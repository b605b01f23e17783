#pragma once
/// The broker as a pure state machine: frames, vanished peers and the time go in; frames, log events, store
/// operations and the next deadline come out. No socket, no clock, no sleep, no thread: the same inputs give
/// the same outputs. `Broker` puts it on a socket; tests and fuzzers drive it directly.
///
/// Every step costs O(log n) in workers, queued requests and clients.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/event.h>
#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/limits.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {

/// A message to a peer: its frames are `head` and then `body`, which is null when there is none.
struct Outgoing {
  std::string peer = {};
  Frames head = {};
  Body body = {};
};

/// A persistent request as a store keeps it; `finished` ones carry their reply.
struct StoredRequest {
  RequestId id = {};
  std::string service = {};
  Body body = {};
  Millis attempt_timeout = 0;
  bool finished = false;
  Outcome outcome = Outcome::ok;
  std::string reason = {};
  std::uint32_t attempts = 0;
  Body reply = {};
};

/// To be done, in order, before the messages of the same step are sent.
struct StoreOperation {
  enum Kind { add, finish, forget } kind = add;
  StoredRequest request;  ///< of `forget`, only the id counts; of `finish`, the body is null
};

struct BrokerOutputs {
  std::vector<StoreOperation> store = {};
  std::vector<Outgoing> messages = {};
  std::vector<BrokerEvent> events = {};
};

/// Sums since the start, and what is there now.
struct BrokerStats {
  std::uint64_t received = 0, sent = 0, dropped = 0;
  std::uint64_t requests = 0, finished = 0, failed = 0, parked = 0, expired = 0, cancelled = 0, busy = 0;
  std::uint64_t attempts = 0, retries = 0, hedged = 0, coalesced = 0, repeated = 0, late_replies = 0;
  std::uint64_t workers_lost = 0;
  std::size_t peers = 0, workers = 0, idle = 0, outstanding = 0, queued = 0, running = 0, bytes = 0;
  std::size_t services = 0, records = 0;
};

class BrokerCore {
 public:
  using Random = std::function<std::array<std::uint64_t, 2>()>;

  /// `random` must be unpredictable to peers in production; tests give a sequence. `has_store`: persistent
  /// requests and 9/TSP are served and store operations come out. Throws Error for limits and timers out of
  /// range.
  BrokerCore(const BrokerLimits& limits, const BrokerTimers& timers, Random random, bool has_store = false);
  ~BrokerCore();

  /// A message from `peer`, the ROUTER's identity frame. `now` never goes back.
  void receive(Millis now, const std::string& peer, Frames&& frames, const Rights& rights = {});
  /// The connection of a peer has ended, or it cannot be reached.
  void peer_gone(Millis now, const std::string& peer);
  /// The peer's rights were taken away or changed: a worker is disconnected, and all is as if it were gone.
  void revoke(Millis now, const std::string& peer);
  /// A message that was not handed to receive(), counted and logged as a dropped one.
  void dropped(Millis now, const std::string& peer, const char* reason);
  /// Does what is due. To be called when next_deadline() is reached.
  void tick(Millis now);
  /// When tick() wants to be called; never before the last `now`.
  Millis next_deadline() const;
  /// Puts back what a store held, before anything else.
  void restore(Millis now, StoredRequest&& request);

  /// Lesser events do not come out (at first all do): those of every job cost time.
  void set_least_event(LogLevel level);

  /// New requests are told `busy`; what is queued stays where it is.
  void drain(Millis now);
  /// After drain(): no request is running any more.
  bool drained() const;
  /// Sends DISCONNECT to every worker.
  void disconnect_workers(Millis now);

  /// What the calls since the last take() want done.
  BrokerOutputs take();
  BrokerStats stats() const;
  /// The stats in Prometheus' text format.
  std::string metrics_text() const;

 private:
  friend class BrokerRecount;  // of the tests: counts the books anew
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ssphh::majordomo

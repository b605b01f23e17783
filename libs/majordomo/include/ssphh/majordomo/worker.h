#pragma once
/// A worker of a Majordomo broker: one service, one request at a time.
///
/// An I/O thread beats its heart, reconnects and hears cancellations while the calling thread computes for as
/// long as it takes. With our broker (known by the token in the client-address frame) it also tells failures
/// with their reason; with foreign brokers its frames are exactly the RFC's.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {

struct WorkerOptions {
  std::string endpoint = {};
  std::string service = {};
  std::string name = {};  ///< shown by mmi.workers and logs: [A-Za-z0-9._:/-], at most 100; empty: "HOST:PID"
  std::optional<PeerSecurity> security = {};
  Dialect dialect = Dialect::own;  ///< own and mdp02 both begin as the RFC's 0.2
  Millis heartbeat = 2500;         ///< at most a third of the broker's worker_expiry
  Millis broker_expiry = 10'000;   ///< of silence; then a new socket is opened
  Millis reconnect = 250;          ///< first pause before a new socket; doubles up to reconnect_max
  Millis reconnect_max = 10'000;
};

/// What a handler is given.
struct Job {
  Frames body = {};
  std::uint64_t number = 0;  ///< the broker's number of the job, in its logs too; 0 with foreign brokers
  int attempt = 1;
  const CancelToken* cancel = nullptr;  ///< set when the answer is not wanted any more, or by abandon()
  /// Sends a PARTIAL; a job that runs again must send the same PARTIALs in the same order.
  std::function<void(Frames)> partial = {};

  Control control() const { return {nullptr, cancel}; }
};

/// Returns the reply's frames (at least one; an empty list is sent as one empty frame). A pure function of
/// the body: it may run again elsewhere, and twice at once.
///  - ssphh::Error: the job is impossible anywhere; the client gets `failed` with the text
///  - ssphh::Cancelled: the job goes back to the broker unless it was cancelled there
///  - other exceptions: this worker could not; the broker tries another
using Handler = std::function<Frames(const Job&)>;

class Worker {
 public:
  /// Throws Error for a bad endpoint, service or name, a plain endpoint that is not local, keys that are none
  /// and times without a pause.
  explicit Worker(WorkerOptions options);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Serves until stop(); the handler runs on this thread. Reconnects for ever. Throws Error without a
  /// handler, and for an endpoint that ZeroMQ does not know.
  void run(const Handler& handler);
  /// Drain: the request in hand is finished and answered, then the worker disconnects and run() returns. May
  /// be called from any thread and from signal handlers.
  void stop() noexcept;
  /// As stop(), but the request in hand is cancelled and handed back at once. Also from signal handlers.
  void abandon() noexcept;
  /// Requests answered so far.
  std::uint64_t served() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ssphh::majordomo

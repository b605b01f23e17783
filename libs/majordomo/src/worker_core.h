#pragma once
/// A worker as a pure state machine: frames, results and the time in; frames, jobs and wishes out.

#include <optional>
#include <utility>
#include <vector>

#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>
#include <ssphh/majordomo/worker.h>

#include "client_core.h"

namespace ssphh::majordomo {

/// What a handler's run came to.
struct JobResult {
  Outcome outcome = Outcome::ok;  ///< ok, failed, or cancelled: handed back
  bool retry = false;             ///< failed here, but another worker may be able to
  std::string reason = {};
  Frames body = {};
};

class WorkerCore {
 public:
  explicit WorkerCore(const WorkerOptions& options) : options_(options), pause_(options.reconnect) {}

  /// A new socket is connected. Sends READY, and the result of a job that outlived the last connection.
  void connected(Millis now);
  void receive(Millis now, Frames&& frames);
  void tick(Millis now);
  Millis next_deadline() const;

  void partial(Millis now, Frames&& body);
  void done(Millis now, JobResult&& result);
  /// Leave when idle.
  void stop(Millis now);

  std::vector<ToBroker> take() { return std::exchange(out_, {}); }
  /// The job that has arrived, once.
  std::optional<Message> take_job() { return std::exchange(job_, std::nullopt); }
  /// Whether the running job's answer is not wanted any more.
  bool cancelled() const { return cancelled_; }
  /// The socket is to be closed now.
  bool wants_close() const { return state_ == State::closed && !finished_; }
  /// When a new socket is to be opened; none while a job runs without a connection.
  std::optional<Millis> connect_at() const;
  bool finished() const { return finished_; }
  const std::optional<Token>& token() const { return token_; }
  std::uint64_t served() const { return served_; }

 private:
  enum class State { closed, open };
  void send(Millis now, Command command, std::string_view name = {}, Body body = nullptr);
  void send_result(Millis now, JobResult&& result);
  void close(Millis now);
  void leave(Millis now);
  Version version() const { return options_.dialect == Dialect::mdp01 ? Version::v01 : Version::v02; }

  WorkerOptions options_;
  State state_ = State::closed;
  Millis pause_, connect_at_ = 0, heard_ = 0, sent_ = 0;
  bool busy_ = false, stale_ = false, incomplete_ = false, cancelled_ = false, stopping_ = false,
       finished_ = false;
  std::string address_;
  std::optional<Token> token_;
  std::optional<Message> job_;
  std::optional<JobResult> late_;
  std::vector<ToBroker> out_;
  std::uint64_t served_ = 0;
};

}  // namespace ssphh::majordomo

#pragma once
/// What a broker knows. Jobs, requests, services and peers refer to each other by key; a job is one
/// computation, a request one client's wish for its result (several may share a job).

#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include <ssphh/majordomo/broker_core.h>
#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>

#include "../timers.h"

namespace ssphh::majordomo {

using JobNumber = std::uint64_t;

struct KeyHash {
  std::size_t operator()(const Hash128& key) const noexcept { return static_cast<std::size_t>(key.low); }
};

/// One client's jobs in one service, oldest first; the lanes of a service take turns.
struct Lane {
  std::list<JobNumber> jobs;
  std::size_t outstanding = 0, finished = 0;
  std::optional<std::list<std::string>::iterator> turn;
};

struct Service {
  std::string name;
  std::list<std::string> idle;                         ///< workers, longest idle first
  std::unordered_map<std::string, Lane> lanes;         ///< by owner
  std::list<std::string> turns;                        ///< owners with queued jobs
  std::list<JobNumber> choosy;                         ///< want a worker that they have not had
  std::list<JobNumber> running;                        ///< with one attempt, in order of start
  std::unordered_map<std::string, std::size_t> names;  ///< of workers, and how many bear each
  std::size_t workers = 0;
  std::size_t queued = 0;  ///< in lanes and choosy
  std::uint64_t requests = 0, finished = 0;
  std::array<Millis, 31> durations{};  ///< of the last attempts that succeeded
  std::size_t measured = 0;
  Timers::Handle straggle;
  Millis used = 0;
};

struct Attempt {
  Token token = {};
  std::string worker = {};
  Millis started = 0;
  std::uint32_t partials = 0;
  bool live = true;
};

enum class Place : std::uint8_t { none, lane, choosy, backoff };

struct QueuedJob {
  JobNumber number = 0;
  Service* service = nullptr;
  std::string owner;
  Body body;
  std::size_t bytes = 0;
  std::vector<RequestId> requests;
  std::vector<Attempt> attempts;
  std::vector<std::string> failures;  ///< for people: who and why
  std::vector<std::string> avoid;     ///< names of workers that failed it
  std::vector<Body> partials;
  std::size_t reply_bytes = 0;
  std::optional<Hash128> key;
  Millis attempt_timeout = 0, submitted = 0;
  Place place = Place::none;
  std::list<JobNumber>::iterator at;  ///< in the lane or in `choosy`
  std::optional<std::list<JobNumber>::iterator> run;
  Timers::Handle backoff;
  std::optional<Hash128> orphan;  ///< its foreign client vanished while it ran: key in `orphans`

  std::size_t live() const;
};

/// `stored`: nobody is connected, the reply goes on record; `released`: nobody waits at all.
enum class Route : std::uint8_t { mdp01, mdp02, own, stored, released };

struct Request {
  RequestId id = {};
  JobNumber job = 0;
  Route route = Route::own;
  std::string peer = {};  ///< empty when nobody waits
  Timers::Handle deadline = {};
  bool persistent = false;
};

struct WorkerState {
  Service* service = nullptr;
  std::string name;
  Version version = Version::v02;
  bool own = false, busy = false, suspect = false, leaving = false;
  std::optional<std::list<std::string>::iterator> idle;
  Token token;
  Timers::Handle check, attempt;
  Millis sent = 0, since = 0;
  std::uint64_t served = 0;
};

struct Peer {
  std::string user;  ///< name of its key
  bool invalid = false, told = false, gone = false;
  Millis heard = 0, filled = 0;
  double allowance = 0;
  std::unordered_set<RequestId> requests;
  std::unique_ptr<WorkerState> worker;
  Timers::Handle grace;
};

/// What a client is held to, over all its connections.
struct Owner {
  std::size_t requests = 0, bytes = 0;
};

/// A finished reply, kept for whoever asks again.
struct Record {
  std::string service = {};
  Outcome outcome = Outcome::ok;
  std::string reason = {};
  std::uint32_t attempts = 0;
  std::vector<Body> partials = {};
  Body reply = {};
  std::size_t bytes = 0;
  bool persistent = false;
  Timers::Handle forget = {};
  std::list<RequestId>::iterator order = {};
};

struct Orphan {
  JobNumber job = 0;  ///< while it runs
  Body body = {};
  std::vector<Body> partials = {};
  Body reply = {};
  std::size_t bytes = 0;
};

/// Set aside after failing on several workers; kept whole, so that it can run again.
struct Parked {
  JobNumber job = 0;
  std::string service = {};
  std::vector<std::string> failures = {};
  Body body = {};
  Millis attempt_timeout = 0, since = 0;
  std::vector<RequestId> persistent = {};  ///< requests whose reply lies in the store
};

struct BrokerCore::Impl {
  BrokerLimits limits;
  BrokerTimers times;
  Random random;
  bool has_store = false, draining = false, sweeping = false;
  Millis now = 0, started = 0;
  Timers timers;
  JobNumber last_job = 0;
  std::unordered_map<std::string, Peer> peers;
  std::unordered_map<std::string, Service> services;
  std::unordered_map<JobNumber, QueuedJob> jobs;
  std::unordered_map<RequestId, Request> requests;
  std::unordered_map<RequestId, JobNumber> tokens;  ///< by their random part
  std::unordered_map<std::string, Owner> owners;
  std::unordered_map<Hash128, JobNumber, KeyHash> keys;
  std::unordered_map<Hash128, Orphan, KeyHash> orphans;
  std::unordered_map<RequestId, Record> records;
  std::list<RequestId> record_order;
  std::size_t record_bytes = 0, orphan_bytes = 0, stored_bytes = 0, queued_bytes = 0, worker_count = 0,
              running_count = 0, queued_count = 0, parked_bytes = 0;
  std::deque<Parked> parked;
  LogLevel least_event = LogLevel::debug;
  BrokerOutputs out;
  BrokerStats sums;
  std::map<std::string, std::uint64_t> dropped;
  Millis drop_second = 0;
  int drop_logged = 0;

  void set_time(Millis t);

  // receive.cpp: who is it, may it, is it well formed
  void receive(const std::string& id, Frames&& frames, const Rights& rights);
  void from_worker(const std::string& id, Peer& peer, Message&& message, const Rights& rights);
  bool over_rate(Peer& peer);
  void drop(const std::string& id, const char* reason);
  void peer_gone(const std::string& id);
  void revoke(const std::string& id);
  void client_vanished(const std::string& id);
  void sweep();

  // clients.cpp
  void from_client(const std::string& id, Peer& peer, Message&& message, const Rights& rights);
  void submit(const std::string& id, Peer& peer, Message&& message, const Envelope& envelope);
  void submit_foreign(const std::string& id, Peer& peer, Message&& message);
  const char* over_limits(const std::string& owner, std::size_t bytes) const;
  void enqueue(Request&& request, const std::string& owner, const std::string& service, Body body,
               const Envelope& options);
  bool adopt_orphan(Request& request, Peer& peer, const std::string& service, const Frames& body);
  void attach(const std::string& id, Request& request);
  void end_request(const RequestId& id, Outcome outcome, const std::string& reason);
  void detach(const RequestId& id);

  // replies.cpp: to clients
  void deliver(const Request& request, const std::string& service, Outcome outcome, const std::string& reason,
               std::uint32_t attempts, const std::vector<Body>& partials, const Body& reply);
  void deliver_partial(const Request& request, const std::string& service, const Body& body,
                       std::uint32_t sequence);
  void to_own(const std::string& id, Command command, std::string_view service, const Envelope& envelope,
              Body body = nullptr);
  void answer(const std::string& id, const Message& question, const Envelope* envelope, Frames&& body);
  void keep_record(const RequestId& id, Record&& record);
  void forget_record(const RequestId& id);
  bool repeat_record(const RequestId& id, const std::string& peer);

  // workers.cpp
  void register_worker(const std::string& id, Peer& peer, const Message& message, const Rights& rights);
  void lose_worker(const std::string& id, Peer& peer, const std::string& why, bool handed_back);
  void disconnect(const std::string& id, Peer& peer, Version version);
  void check_worker(const std::string& id);
  void from_attempt(const std::string& id, Peer& peer, Message&& message);
  void make_idle(const std::string& id, WorkerState& worker);
  void to_worker(const std::string& id, WorkerState& worker, Command command, std::string_view name = {},
                 Body body = nullptr);
  void attempt_overdue(const std::string& id);
  void cancel_attempts(QueuedJob& job);

  // dispatch.cpp
  void dispatch(Service& service);
  bool dispatch_choosy(Service& service);
  bool dispatch_lane(Service& service);
  bool dispatch_straggler(Service& service);
  void start(QueuedJob& job, const std::string& worker);
  std::optional<std::string> pick_worker(const Service& service, const QueuedJob& job) const;
  void put_in_lane(QueuedJob& job);
  void put_in_choosy(QueuedJob& job);
  void unqueue(QueuedJob& job);
  void fail_attempt(QueuedJob& job, Attempt& attempt, const std::string& why, bool handed_back);

  // jobs.cpp
  Service* require_service(const std::string& name);
  QueuedJob* find_job(JobNumber number);
  void finish(QueuedJob& job, Outcome outcome, const std::string& reason, Body reply);
  void erase_job(QueuedJob& job);
  void keep_orphan(QueuedJob& job, const Body& reply);
  void forget_orphan(const Hash128& key);
  void result(QueuedJob& job, Attempt& attempt, const std::string& worker, Frames&& body);
  void partial(QueuedJob& job, Attempt& attempt, Frames&& body);

  // parked.cpp
  void park(QueuedJob& job);
  void keep_parked(Parked&& entry);
  void release(const Parked& entry);
  Frames unpark(const std::string& which, bool run_again);

  // mmi.cpp, titanic.cpp
  bool is_internal(std::string_view service) const;
  void internal(const std::string& id, Peer& peer, const Message& message, const Envelope* envelope,
                const Rights& rights);
  Frames mmi(const Message& message, const Frames& body, const Rights& rights);
  Frames titanic(const Message& message, const Frames& body, const std::string& owner);
  BrokerStats stats() const;

  /// Events below `least` are not even put together.
  bool wants(LogLevel level) const { return level >= least_event; }
  template <class... Fields>
  void event(LogLevel level, const char* name, Fields... fields) {
    if (wants(level)) out.events.push_back({level, name, {std::move(fields)...}});
  }
};

/// Lane of jobs that an administrator put back.
inline const std::string released_owner = "released";
/// Names equal work: service and bytes of the body.
Hash128 content_hash(std::string_view service, const Frames& body);
/// Field of an event.
using Field = std::pair<const char*, std::string>;
/// An identity as text: the worker's name of an own worker, else printable bytes as they are, others in
/// hexadecimal.
std::string peer_text(std::string_view id);
std::string owner_of(const std::string& id, const Peer& peer);

}  // namespace ssphh::majordomo

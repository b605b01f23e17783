#include <algorithm>

#include "state.h"

namespace ssphh::majordomo {

void BrokerCore::Impl::to_worker(const std::string& id, WorkerState& worker, Command command,
                                 std::string_view name, Body body) {
  worker.sent = now;
  out.messages.push_back({id, encode_head(worker.version, Side::worker, command, name), std::move(body)});
}

void BrokerCore::Impl::disconnect(const std::string& id, Peer& peer, Version version) {
  if (peer.told) return;
  peer.told = true;
  event(LogLevel::info, "worker-disconnected", Field("worker", peer_text(id)));
  out.messages.push_back({id, encode_head(version, Side::worker, Command::disconnect), nullptr});
}

void BrokerCore::Impl::register_worker(const std::string& id, Peer& peer, const Message& message,
                                       const Rights& rights) {
  if (peer.worker) {
    lose_worker(id, peer, "second READY", false);
    return disconnect(id, peer, message.version);
  }
  if (peer.told) return drop(id, "READY after DISCONNECT");
  const char* refused = is_internal(message.name)         ? "service is the broker's own"
                        : !rights.may_serve(message.name) ? "key may not serve this service"
                        : !services.contains(message.name) && services.size() >= limits.services
                            ? "too many services"
                            : nullptr;
  if (refused) {
    drop(id, refused);
    return disconnect(id, peer, message.version);
  }
  Service& service = *require_service(message.name);
  peer.worker = std::make_unique<WorkerState>();
  WorkerState& worker = *peer.worker;
  worker.service = &service;
  worker.name = peer_text(id);
  worker.version = message.version;
  worker.own = id.starts_with(own_worker_prefix);
  worker.sent = worker.since = now;
  worker.check = timers.set(now + std::min(times.heartbeat, times.worker_expiry),
                            [this, id](Millis) { check_worker(id); });
  ++service.workers;
  ++service.names[worker.name];
  ++worker_count;
  event(LogLevel::info, "worker-ready", Field("worker", worker.name), Field("service", service.name),
        Field("version", message.version == Version::v01 ? "0.1" : "0.2"));
  make_idle(id, worker);
  dispatch(service);
}

void BrokerCore::Impl::make_idle(const std::string& id, WorkerState& worker) {
  worker.busy = worker.suspect = false;
  worker.since = now;
  timers.cancel(worker.attempt);
  if (!worker.leaving) worker.idle = worker.service->idle.insert(worker.service->idle.end(), id);
}

void BrokerCore::Impl::lose_worker(const std::string& id, Peer& peer, const std::string& why,
                                   bool handed_back) {
  const std::unique_ptr<WorkerState> worker = std::move(peer.worker);
  Service& service = *worker->service;
  timers.cancel(worker->check);
  timers.cancel(worker->attempt);
  if (worker->idle) service.idle.erase(*worker->idle);
  if (--service.names[worker->name] == 0) service.names.erase(worker->name);
  --service.workers;
  --worker_count;
  service.used = now;
  if (!handed_back) ++sums.workers_lost;
  event(handed_back ? LogLevel::info : LogLevel::warning, handed_back ? "worker-left" : "worker-lost",
        Field("worker", peer_text(id)), Field("service", service.name), Field("reason", why));
  if (!worker->busy) return;
  const auto job_number = tokens.find({worker->token.high, worker->token.low});
  if (job_number == tokens.end()) return;
  QueuedJob& job = jobs.at(job_number->second);
  for (Attempt& attempt : job.attempts)
    if (attempt.live && attempt.token == worker->token) return fail_attempt(job, attempt, why, handed_back);
}

void BrokerCore::Impl::check_worker(const std::string& id) {
  Peer& peer = peers.at(id);
  WorkerState& worker = *peer.worker;
  worker.check = {};
  if (now - peer.heard >= times.worker_expiry && !worker.suspect) {
    if (!worker.busy || worker.own) return lose_worker(id, peer, "silent", false);
    // A foreign worker may compute in the thread that should beat its heart: its answer stays welcome.
    worker.suspect = true;
    event(LogLevel::warning, "worker-suspect", Field("worker", worker.name),
          Field("service", worker.service->name), Field("job", std::to_string(worker.token.job)));
    if (const auto found = tokens.find({worker.token.high, worker.token.low}); found != tokens.end()) {
      QueuedJob& job = jobs.at(found->second);
      if (job.live() == 1 && job.place == Place::none) {
        ++sums.hedged;
        put_in_choosy(job);
        dispatch(*worker.service);
      }
    }
  }
  if (now - worker.sent >= times.heartbeat) to_worker(id, worker, Command::heartbeat);
  const Millis expiry = worker.suspect ? Timers::never : peer.heard + times.worker_expiry;
  worker.check =
      timers.set(std::min(worker.sent + times.heartbeat, expiry), [this, id](Millis) { check_worker(id); });
}

void BrokerCore::Impl::attempt_overdue(const std::string& id) {
  Peer& peer = peers.at(id);
  const Version version = peer.worker->version;
  peer.worker->attempt = {};
  lose_worker(id, peer, fmt::format("no answer within {} ms", now - peer.worker->since), false);
  disconnect(id, peer, version);
}

void BrokerCore::Impl::from_attempt(const std::string& id, Peer& peer, Message&& message) {
  const bool last = message.command == Command::reply;
  const Version version = message.version;
  const auto token = Token::parse(message.name);
  WorkerState* worker = peer.worker.get();
  const bool its_job = worker && worker->busy && token && worker->token == *token;
  Service* freed = nullptr;
  if (its_job && last) {
    freed = worker->service;
    ++worker->served;
    make_idle(id, *worker);
  }

  QueuedJob* job = nullptr;
  Attempt* attempt = nullptr;
  if (const auto found = token ? tokens.find({token->high, token->low}) : tokens.end();
      found != tokens.end()) {
    job = &jobs.at(found->second);
    for (Attempt& a : job->attempts)
      if (a.token == *token) attempt = &a;
  }
  if (!attempt) {
    ++sums.late_replies;
    event(LogLevel::debug, "reply-late", Field("worker", peer_text(id)),
          Field("job", token ? std::to_string(token->job) : "unknown"));
    // Nobody asked: with 7/MDP, valid but unexpected. A busy worker keeps its job; the stray reply does no
    // harm.
    if (worker && !worker->busy && !its_job) {
      lose_worker(id, peer, "reply without a request", false);
      disconnect(id, peer, version);
    }
  } else if (last) {
    result(*job, *attempt, id, std::move(message.body));
  } else {
    partial(*job, *attempt, std::move(message.body));
  }
  if (!worker) disconnect(id, peer, version);
  if (freed) dispatch(*freed);
}

void BrokerCore::Impl::cancel_attempts(QueuedJob& job) {
  for (const Attempt& attempt : job.attempts) {
    if (!attempt.live) continue;
    const auto peer = peers.find(attempt.worker);
    if (peer == peers.end() || !peer->second.worker) continue;
    WorkerState& worker = *peer->second.worker;
    if (!worker.own || !worker.busy || worker.token != attempt.token) continue;
    const Frame envelope = encode_envelope({.kind = EnvelopeKind::cancel_job, .token = attempt.token});
    to_worker(attempt.worker, worker, Command::heartbeat, {},
              std::make_shared<const Frames>(Frames{envelope}));
  }
}

}  // namespace ssphh::majordomo

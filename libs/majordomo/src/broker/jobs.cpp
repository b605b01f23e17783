#include <algorithm>

#include <ssphh/core/hash.h>

#include "state.h"

namespace ssphh::majordomo {
namespace {

constexpr Millis orphan_reply = 30'000;     // longer than a guide client's three tries
constexpr Millis released_reply = 600'000;  // for people, who start their bake again

}  // namespace

Service* BrokerCore::Impl::require_service(const std::string& name) {
  Service& service = services[name];
  if (service.name.empty()) service.name = name;
  service.used = now;
  return &service;
}

QueuedJob* BrokerCore::Impl::find_job(JobNumber number) {
  const auto found = jobs.find(number);
  return found == jobs.end() ? nullptr : &found->second;
}

void BrokerCore::Impl::partial(QueuedJob& job, Attempt& attempt, Frames&& body) {
  // Copies and repetitions send the same PARTIALs: whoever is first to send the next one is heard.
  if (attempt.partials++ != job.partials.size()) return;
  job.reply_bytes += byte_count(body);
  if (job.reply_bytes > limits.reply_bytes) {
    return finish(job, Outcome::failed, "reply too large", std::make_shared<const Frames>(Frames{Frame()}));
  }
  job.partials.push_back(std::make_shared<const Frames>(std::move(body)));
  for (const RequestId& id : job.requests)
    deliver_partial(requests.at(id), job.service->name, job.partials.back(),
                    static_cast<std::uint32_t>(job.partials.size() - 1));
}

void BrokerCore::Impl::result(QueuedJob& job, Attempt& attempt, const std::string& worker, Frames&& body) {
  Outcome outcome = Outcome::ok;
  std::string reason;
  // Only who was given the job knows its token, so a body that happens to look like an envelope is a body.
  if (const auto envelope = decode_envelope(body[0]);
      envelope && envelope->kind == EnvelopeKind::result && envelope->token == attempt.token) {
    body.erase(body.begin());
    if (envelope->outcome == Outcome::cancelled) {
      if (attempt.live) fail_attempt(job, attempt, "handed back", true);
      return;
    }
    if (envelope->outcome != Outcome::ok) {
      if (envelope->retry) {
        if (attempt.live) fail_attempt(job, attempt, envelope->reason, false);
        return;
      }
      outcome = Outcome::failed;
      reason = peer_text(worker) + ": " + envelope->reason;
    }
  }
  if (body.empty()) body.emplace_back();
  if (job.reply_bytes + byte_count(body) > limits.reply_bytes) {
    outcome = Outcome::failed;
    reason = "reply too large";
    body = {Frame()};
  }
  if (outcome == Outcome::ok) {
    Service& service = *job.service;
    service.durations[service.measured++ % service.durations.size()] = now - attempt.started;
    // A FINAL ends the sequence, so an overtaken copy's PARTIALs must be complete here.
    if (attempt.partials < job.partials.size()) job.partials.resize(attempt.partials);
  }
  finish(job, outcome, reason, std::make_shared<const Frames>(std::move(body)));
}

void BrokerCore::Impl::finish(QueuedJob& job, Outcome outcome, const std::string& reason, Body reply) {
  const auto attempts = static_cast<std::uint32_t>(job.attempts.size());
  ++(outcome == Outcome::ok ? sums.finished : sums.failed);
  ++job.service->finished;
  const LogLevel level = outcome == Outcome::ok ? LogLevel::debug : LogLevel::warning;
  if (wants(level))
    event(level, "job-finished", Field("job", std::to_string(job.number)),
          Field("service", job.service->name), Field("outcome", std::string(name_of(outcome))),
          Field("attempts", std::to_string(attempts)), Field("ms", std::to_string(now - job.submitted)),
          Field("reason", reason));
  const std::vector<RequestId> ids = std::move(job.requests);
  job.requests.clear();
  for (const RequestId& id : ids) {
    Request& request = requests.at(id);
    deliver(request, job.service->name, outcome, reason, attempts, job.partials, reply);
    if (request.route == Route::own || request.route == Route::stored) {
      if (request.persistent) {
        stored_bytes -= std::min(stored_bytes, job.bytes);
        auto whole = std::make_shared<Frames>();
        for (const Body& part : job.partials) whole->insert(whole->end(), part->begin(), part->end());
        whole->insert(whole->end(), reply->begin(), reply->end());
        out.store.push_back({StoreOperation::finish,
                             {.id = id,
                              .service = {},
                              .finished = true,
                              .outcome = outcome,
                              .reason = reason,
                              .attempts = attempts,
                              .reply = std::move(whole)}});
      }
      keep_record(id, {.service = job.service->name,
                       .outcome = outcome,
                       .reason = reason,
                       .attempts = attempts,
                       .partials = job.partials,
                       .reply = reply,
                       .persistent = request.persistent});
    }
    timers.cancel(request.deadline);
    if (const auto peer = peers.find(request.peer); peer != peers.end()) peer->second.requests.erase(id);
    requests.erase(id);
  }
  if (job.orphan && outcome == Outcome::ok) keep_orphan(job, reply);
  erase_job(job);
}

void BrokerCore::Impl::keep_orphan(QueuedJob& job, const Body& reply) {
  const std::size_t bytes = job.reply_bytes + byte_count(*reply);
  if (orphan_bytes + bytes > limits.record_bytes / 4) return;
  const Hash128 key = *job.orphan;
  const Millis life = job.owner == released_owner ? released_reply : orphan_reply;
  job.orphan.reset();
  orphans[key] = {.job = 0, .body = job.body, .partials = job.partials, .reply = reply, .bytes = bytes};
  orphan_bytes += bytes;
  timers.set(now + life, [this, key, reply](Millis) {
    if (const auto it = orphans.find(key); it != orphans.end() && it->second.reply == reply)
      forget_orphan(key);
  });
}

void BrokerCore::Impl::forget_orphan(const Hash128& key) {
  const auto found = orphans.find(key);
  orphan_bytes -= found->second.bytes;
  orphans.erase(found);
}

void BrokerCore::Impl::erase_job(QueuedJob& job) {
  Service& service = *job.service;
  if (job.place != Place::none) unqueue(job);
  if (job.live() > 0) {
    --running_count;
    // The copies that were not needed. A worker that has just answered is idle and hears nothing.
    cancel_attempts(job);
  }
  if (job.run) service.running.erase(*job.run);
  for (const Attempt& attempt : job.attempts) tokens.erase({attempt.token.high, attempt.token.low});
  if (job.key) keys.erase(*job.key);
  if (job.orphan) forget_orphan(*job.orphan);
  const auto lane = service.lanes.find(job.owner);
  ++lane->second.finished;
  if (--lane->second.outstanding == 0) service.lanes.erase(lane);
  const auto owner = owners.find(job.owner);
  owner->second.bytes -= job.bytes;
  if (--owner->second.requests == 0) owners.erase(owner);
  queued_bytes -= job.bytes;
  service.used = now;
  jobs.erase(job.number);
}

}  // namespace ssphh::majordomo

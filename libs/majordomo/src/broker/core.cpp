#include <algorithm>
#include <utility>

#include <ssphh/core/require.h>

#include "state.h"

namespace ssphh::majordomo {

namespace {

void require_sound(const BrokerLimits& limits, const BrokerTimers& times) {
  require(limits.attempts >= 1, "broker limits", "attempts must be 1 at least");
  require(limits.messages_per_second >= 0, "broker limits", "messages_per_second is under 0 or no number");
  require(times.straggler >= 0 && times.straggler_after >= 0, "broker timers",
          "straggler or straggler_after is under 0 or no number");
  require_pause(times.heartbeat, "heartbeat", "must be 1 ms or more");
  const std::pair<const char*, Millis> waits[] = {
      {"worker_expiry", times.worker_expiry},     {"request_expiry", times.request_expiry},
      {"retry_backoff", times.retry_backoff},     {"retry_backoff_max", times.retry_backoff_max},
      {"attempt_timeout", times.attempt_timeout}, {"record", times.record},
      {"stored_result", times.stored_result},     {"service_idle", times.service_idle},
      {"straggler_least", times.straggler_least}, {"client_grace", times.client_grace}};
  for (const auto& [name, time] : waits)
    require(time >= 0 && time <= most_millis, name, "is under 0 or over most_millis");
}

}  // namespace

BrokerCore::BrokerCore(const BrokerLimits& limits, const BrokerTimers& timers, Random random, bool has_store)
    : impl_(std::make_unique<Impl>()) {
  require_sound(limits, timers);
  require(random != nullptr, "broker", "there is no source of random numbers");
  impl_->limits = limits;
  impl_->times = timers;
  impl_->random = std::move(random);
  impl_->has_store = has_store;
}

BrokerCore::~BrokerCore() = default;

void BrokerCore::Impl::set_time(Millis t) {
  if (!std::exchange(sweeping, true)) {
    now = started = t;
    sweep();
  }
  now = std::max(now, t);
}

void BrokerCore::receive(Millis now, const std::string& peer, Frames&& frames, const Rights& rights) {
  impl_->set_time(now);
  impl_->receive(peer, std::move(frames), rights);
}

void BrokerCore::peer_gone(Millis now, const std::string& peer) {
  impl_->set_time(now);
  impl_->peer_gone(peer);
}

void BrokerCore::revoke(Millis now, const std::string& peer) {
  impl_->set_time(now);
  impl_->revoke(peer);
}

void BrokerCore::dropped(Millis now, const std::string& peer, const char* reason) {
  impl_->set_time(now);
  impl_->drop(peer, reason);
}

void BrokerCore::tick(Millis now) {
  impl_->set_time(now);
  impl_->timers.run(impl_->now);
}

Millis BrokerCore::next_deadline() const {
  return std::max(impl_->now, impl_->timers.next());
}

void BrokerCore::restore(Millis now, StoredRequest&& stored) {
  Impl& s = *impl_;
  s.set_time(now);
  if (stored.finished) {
    if (stored.outcome == Outcome::parked)
      s.keep_parked({.job = ++s.last_job,
                     .service = stored.service,
                     .failures = {stored.reason},
                     .body = stored.body,
                     .attempt_timeout = stored.attempt_timeout,
                     .since = now,
                     .persistent = {stored.id}});
    s.keep_record(stored.id, {.service = stored.service,
                              .outcome = stored.outcome,
                              .reason = stored.reason,
                              .attempts = stored.attempts,
                              .partials = {},
                              .reply = stored.reply,
                              .persistent = true});
    return;
  }
  s.stored_bytes += byte_count(*stored.body);
  Envelope options;
  options.attempt_timeout = stored.attempt_timeout;
  s.enqueue({.id = stored.id, .route = Route::stored, .persistent = true}, "store", stored.service,
            std::move(stored.body), options);
}

void BrokerCore::set_least_event(LogLevel level) {
  impl_->least_event = level;
}

void BrokerCore::drain(Millis now) {
  impl_->set_time(now);
  if (std::exchange(impl_->draining, true)) return;
  impl_->event(LogLevel::info, "broker-draining", Field("running", std::to_string(impl_->running_count)),
               Field("queued", std::to_string(impl_->queued_count)));
}

bool BrokerCore::drained() const {
  return impl_->draining && impl_->running_count == 0;
}

void BrokerCore::disconnect_workers(Millis now) {
  impl_->set_time(now);
  for (auto& [id, peer] : impl_->peers)
    if (peer.worker) impl_->disconnect(id, peer, peer.worker->version);
}

BrokerOutputs BrokerCore::take() {
  impl_->sums.sent += impl_->out.messages.size();
  return std::exchange(impl_->out, {});
}

BrokerStats BrokerCore::stats() const {
  return impl_->stats();
}

}  // namespace ssphh::majordomo

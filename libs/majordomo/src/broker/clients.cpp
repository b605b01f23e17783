#include <algorithm>

#include <ssphh/core/hash.h>

#include "state.h"

namespace ssphh::majordomo {
namespace {

constexpr Millis busy_pause = 250;
constexpr Millis drain_pause = 1000;

Hash128 key_in(std::string_view service, const Hash128& key) {
  return Hasher().text(service).value(key.high).value(key.low).finish();
}

}  // namespace

Hash128 content_hash(std::string_view service, const Frames& body) {
  Hasher hasher;
  hasher.text(service);
  for (const Frame& frame : body) hasher.text(frame);
  return hasher.finish();
}

void BrokerCore::Impl::from_client(const std::string& id, Peer& peer, Message&& message,
                                   const Rights& rights) {
  std::optional<Envelope> envelope;
  if (message.version == Version::v02 && is_envelope(message.body[0])) {
    envelope = decode_envelope(message.body[0]);
    if (!envelope) return drop(id, "malformed envelope");
  }
  if (!rights.client) return drop(id, "key may not send requests");
  if (!envelope) {
    if (is_internal(message.name)) return internal(id, peer, message, nullptr, rights);
    return submit_foreign(id, peer, std::move(message));
  }

  const std::vector<RequestId>& ids = envelope->ids;
  switch (envelope->kind) {
    case EnvelopeKind::submit:
      if (ids.size() != 1) return drop(id, "malformed envelope");
      if (is_internal(message.name)) return internal(id, peer, message, &*envelope, rights);
      return submit(id, peer, std::move(message), *envelope);
    case EnvelopeKind::cancel:
      for (const RequestId& request : ids) {
        forget_record(request);
        const auto found = requests.find(request);
        if (found == requests.end()) continue;
        attach(id, found->second);
        end_request(request, Outcome::cancelled, "by its client");
      }
      return;
    case EnvelopeKind::query: {
      Envelope unknown{.kind = EnvelopeKind::unknown};
      for (const RequestId& request : ids) {
        if (const auto found = requests.find(request); found != requests.end()) {
          attach(id, found->second);
        } else if (!repeat_record(request, id)) {
          unknown.ids.push_back(request);
        }
      }
      if (!unknown.ids.empty()) to_own(id, Command::partial, control_service, unknown);
      return;
    }
    case EnvelopeKind::ack:
      for (const RequestId& request : ids) forget_record(request);
      return;
    default:
      return drop(id, "envelope of the other side");
  }
}

const char* BrokerCore::Impl::over_limits(const std::string& owner, std::size_t bytes) const {
  if (requests.size() >= limits.queued_requests) return "too many requests";
  if (queued_bytes + bytes > limits.queued_bytes) return "too many bytes";
  const auto found = owners.find(owner);
  if (found == owners.end()) return nullptr;
  if (found->second.requests >= limits.client_requests) return "too many requests of this client";
  if (found->second.bytes + bytes > limits.client_bytes) return "too many bytes of this client";
  return nullptr;
}

void BrokerCore::Impl::submit(const std::string& id, Peer& peer, Message&& message,
                              const Envelope& envelope) {
  const RequestId request_id = envelope.ids[0];
  if (const auto known = requests.find(request_id); known != requests.end()) {
    ++sums.repeated;
    attach(id, known->second);
    if (known->second.persistent)
      to_own(id, Command::partial, message.name, {.kind = EnvelopeKind::accepted, .ids = {request_id}});
    return;
  }
  if (repeat_record(request_id, id)) {
    ++sums.repeated;
    return;
  }
  message.body.erase(message.body.begin());
  if (message.body.empty()) message.body.emplace_back();
  const std::string owner = owner_of(id, peer);
  const std::size_t bytes = byte_count(message.body);
  const auto refuse = [&](const char* reason) {
    ++sums.failed;
    event(LogLevel::warning, "request-refused", Field("peer", peer_text(id)), Field("service", message.name),
          Field("reason", reason));
    to_own(id, Command::reply, message.name,
           {.kind = EnvelopeKind::final, .ids = {request_id}, .outcome = Outcome::refused, .reason = reason},
           std::make_shared<const Frames>(Frames{Frame()}));
  };
  if (envelope.persistent && !has_store) return refuse("the broker has no store");
  if (bytes > limits.client_bytes || bytes > limits.queued_bytes) return refuse("request too large");
  const char* full = over_limits(owner, bytes);
  if (!full && envelope.persistent && stored_bytes + bytes > limits.stored_bytes) full = "the store is full";
  if (!full && !services.contains(message.name) && services.size() >= limits.services)
    full = "too many services";
  if (full || draining) {
    ++sums.busy;
    if (full) event(LogLevel::debug, "client-busy", Field("peer", peer_text(id)), Field("reason", full));
    return to_own(id, Command::partial, message.name,
                  {.kind = EnvelopeKind::busy,
                   .ids = {request_id},
                   .reason = full ? full : "draining",
                   .retry_after = full ? busy_pause : drain_pause});
  }
  Request request{.id = request_id, .route = Route::own, .peer = id, .persistent = envelope.persistent};
  if (!orphans.empty() && !request.persistent && adopt_orphan(request, peer, message.name, message.body))
    return;
  peer.requests.insert(request_id);
  const auto body = std::make_shared<const Frames>(std::move(message.body));
  if (envelope.persistent) {
    stored_bytes += bytes;
    out.store.push_back({StoreOperation::add,
                         {.id = request_id,
                          .service = message.name,
                          .body = body,
                          .attempt_timeout = envelope.attempt_timeout}});
    to_own(id, Command::partial, message.name, {.kind = EnvelopeKind::accepted, .ids = {request_id}});
  }
  enqueue(std::move(request), owner, message.name, body, envelope);
}

void BrokerCore::Impl::submit_foreign(const std::string& id, Peer& peer, Message&& message) {
  const auto bits = random();
  Request request{.id = {bits[0], bits[1]},
                  .route = message.version == Version::v01 ? Route::mdp01 : Route::mdp02,
                  .peer = id};
  if (!orphans.empty() && adopt_orphan(request, peer, message.name, message.body)) return;
  const std::string owner = owner_of(id, peer);
  if (draining) return drop(id, "broker is draining");
  if (const char* full = over_limits(owner, byte_count(message.body))) return drop(id, full);
  if (!services.contains(message.name) && services.size() >= limits.services)
    return drop(id, "too many services");
  peer.requests.insert(request.id);
  enqueue(std::move(request), owner, message.name, std::make_shared<const Frames>(std::move(message.body)),
          {});
}

void BrokerCore::Impl::enqueue(Request&& request, const std::string& owner, const std::string& service_name,
                               Body body, const Envelope& options) {
  ++sums.requests;
  if (options.deadline > 0) {
    request.deadline = timers.set(now + options.deadline, [this, id = request.id](Millis) {
      end_request(id, Outcome::expired, "its deadline passed");
    });
  }
  std::optional<Hash128> key;
  if (options.content_key) {
    key = key_in(service_name, *options.content_key);
    const auto same = keys.find(*key);
    QueuedJob* job = same != keys.end() ? find_job(same->second) : nullptr;
    if (job && *job->body == *body) {  // the key is the client's word; equal bytes are proof
      ++sums.coalesced;
      request.job = job->number;
      job->requests.push_back(request.id);
      const auto& kept = requests.emplace(request.id, std::move(request)).first->second;
      for (std::size_t i = 0; i < job->partials.size(); ++i)
        deliver_partial(kept, service_name, job->partials[i], static_cast<std::uint32_t>(i));
      return;
    }
  }
  Service& service = *require_service(service_name);
  QueuedJob& job = jobs[++last_job];
  job.number = last_job;
  job.service = &service;
  job.owner = owner;
  job.bytes = byte_count(*body);
  job.body = std::move(body);
  job.attempt_timeout = options.attempt_timeout > 0 ? options.attempt_timeout : times.attempt_timeout;
  job.submitted = now;
  job.requests = {request.id};
  if (key && keys.emplace(*key, job.number).second) job.key = key;
  request.job = job.number;
  requests.emplace(request.id, std::move(request));
  Owner& account = owners[owner];
  ++account.requests;
  account.bytes += job.bytes;
  queued_bytes += job.bytes;
  ++service.requests;
  ++service.lanes[owner].outstanding;
  put_in_lane(job);
  dispatch(service);
}

bool BrokerCore::Impl::adopt_orphan(Request& request, Peer& peer, const std::string& service,
                                    const Frames& body) {
  const auto found = orphans.find(content_hash(service, body));
  if (found == orphans.end() || *found->second.body != body) return false;
  const Orphan orphan = found->second;
  forget_orphan(found->first);
  ++sums.repeated;
  if (orphan.reply) {
    for (std::size_t i = 0; i < orphan.partials.size(); ++i)
      deliver_partial(request, service, orphan.partials[i], static_cast<std::uint32_t>(i));
    deliver(request, service, Outcome::ok, {}, 1, orphan.partials, orphan.reply);
    if (request.route == Route::own)
      keep_record(request.id,
                  {.service = service, .attempts = 1, .partials = orphan.partials, .reply = orphan.reply});
    return true;
  }
  QueuedJob& job = jobs.at(orphan.job);
  job.orphan.reset();
  request.job = job.number;
  job.requests.push_back(request.id);
  peer.requests.insert(request.id);
  for (std::size_t i = 0; i < job.partials.size(); ++i)
    deliver_partial(request, service, job.partials[i], static_cast<std::uint32_t>(i));
  const RequestId id = request.id;
  requests.emplace(id, std::move(request));
  return true;
}

void BrokerCore::Impl::attach(const std::string& id, Request& request) {
  if (request.peer == id) return;
  if (const auto old = peers.find(request.peer); old != peers.end()) old->second.requests.erase(request.id);
  request.peer = id;
  request.route = Route::own;
  peers.at(id).requests.insert(request.id);
  const QueuedJob& job = jobs.at(request.job);
  for (std::size_t i = 0; i < job.partials.size(); ++i)
    deliver_partial(request, job.service->name, job.partials[i], static_cast<std::uint32_t>(i));
}

void BrokerCore::Impl::end_request(const RequestId& id, Outcome outcome, const std::string& reason) {
  const auto found = requests.find(id);
  if (found == requests.end()) return;
  ++(outcome == Outcome::cancelled ? sums.cancelled : sums.expired);
  const QueuedJob& job = jobs.at(found->second.job);
  deliver(found->second, job.service->name, outcome, reason, static_cast<std::uint32_t>(job.attempts.size()),
          {}, std::make_shared<const Frames>(Frames{Frame()}));
  if (found->second.persistent) out.store.push_back({StoreOperation::forget, {.id = id}});
  if (found->second.persistent) stored_bytes -= std::min(stored_bytes, job.bytes);
  detach(id);
}

void BrokerCore::Impl::detach(const RequestId& id) {
  const auto found = requests.find(id);
  if (found == requests.end()) return;
  Request& request = found->second;
  timers.cancel(request.deadline);
  if (const auto peer = peers.find(request.peer); peer != peers.end()) peer->second.requests.erase(id);
  QueuedJob& job = jobs.at(request.job);
  const bool foreign = request.route == Route::mdp01 || request.route == Route::mdp02;
  std::erase(job.requests, id);
  requests.erase(found);
  if (!job.requests.empty()) return;
  if (foreign && job.live() > 0) {  // a guide client that lost patience asks again on a new socket
    const Hash128 key = content_hash(job.service->name, *job.body);
    if (orphans.emplace(key, Orphan{.job = job.number, .body = job.body}).second) job.orphan = key;
    return;
  }
  event(LogLevel::debug, "job-dropped", Field("job", std::to_string(job.number)),
        Field("service", job.service->name), Field("reason", "nobody waits for it"));
  erase_job(job);
}

}  // namespace ssphh::majordomo

#include "state.h"

namespace ssphh::majordomo {
namespace {

constexpr std::size_t record_overhead = 300;

Body fold(const std::vector<Body>& partials, const Body& reply) {
  if (partials.empty()) return reply;
  auto all = std::make_shared<Frames>();
  for (const Body& partial : partials) all->insert(all->end(), partial->begin(), partial->end());
  all->insert(all->end(), reply->begin(), reply->end());
  return all;
}

}  // namespace

void BrokerCore::Impl::to_own(const std::string& id, Command command, std::string_view service,
                              const Envelope& envelope, Body body) {
  Frames head = encode_head(Version::v02, Side::client, command, service);
  head.push_back(encode_envelope(envelope));
  out.messages.push_back({id, std::move(head), std::move(body)});
}

void BrokerCore::Impl::deliver_partial(const Request& request, const std::string& service, const Body& body,
                                       std::uint32_t sequence) {
  if (request.peer.empty()) return;
  if (request.route == Route::mdp02) {
    out.messages.push_back(
        {request.peer, encode_head(Version::v02, Side::client, Command::partial, service), body});
  } else if (request.route == Route::own) {
    to_own(request.peer, Command::partial, service,
           {.kind = EnvelopeKind::partial, .ids = {request.id}, .sequence = sequence}, body);
  }
}

void BrokerCore::Impl::deliver(const Request& request, const std::string& service, Outcome outcome,
                               const std::string& reason, std::uint32_t attempts,
                               const std::vector<Body>& partials, const Body& reply) {
  if (request.peer.empty()) return;
  switch (request.route) {
    case Route::mdp01:
    case Route::mdp02: {
      // The published protocol has no words for a failure: foreign clients run into their own timeout.
      if (outcome != Outcome::ok) return;
      const bool old = request.route == Route::mdp01;
      out.messages.push_back(
          {request.peer,
           encode_head(old ? Version::v01 : Version::v02, Side::client, Command::reply, service),
           old ? fold(partials, reply) : reply});
      return;
    }
    case Route::own:
      return to_own(request.peer, Command::reply, service,
                    {.kind = EnvelopeKind::final,
                     .ids = {request.id},
                     .outcome = outcome,
                     .reason = reason,
                     .attempts = attempts,
                     .sequence = static_cast<std::uint32_t>(partials.size())},
                    reply);
    case Route::stored:
    case Route::released:
      return;
  }
}

void BrokerCore::Impl::answer(const std::string& id, const Message& question, const Envelope* envelope,
                              Frames&& body) {
  auto shared = std::make_shared<const Frames>(std::move(body));
  if (envelope) {
    return to_own(id, Command::reply, question.name, {.kind = EnvelopeKind::final, .ids = envelope->ids},
                  std::move(shared));
  }
  out.messages.push_back(
      {id, encode_head(question.version, Side::client, Command::reply, question.name), std::move(shared)});
}

void BrokerCore::Impl::keep_record(const RequestId& id, Record&& record) {
  record.bytes = record_overhead + byte_count(*record.reply);
  for (const Body& partial : record.partials) record.bytes += byte_count(*partial);
  const Millis life = record.persistent ? times.stored_result : times.record;
  record.forget = timers.set(now + life, [this, id](Millis) { forget_record(id); });
  if (!record.persistent) {
    record_bytes += record.bytes;
    record.order = record_order.insert(record_order.end(), id);
  } else {
    stored_bytes += record.bytes;
  }
  records.emplace(id, std::move(record));
  while (record_bytes > limits.record_bytes) forget_record(record_order.front());
}

void BrokerCore::Impl::forget_record(const RequestId& id) {
  const auto found = records.find(id);
  if (found == records.end()) return;
  Record& record = found->second;
  timers.cancel(record.forget);
  if (record.persistent) {
    out.store.push_back({StoreOperation::forget, {.id = id}});
    stored_bytes -= std::min(stored_bytes, record.bytes);
  } else {
    record_bytes -= record.bytes;
    record_order.erase(record.order);
  }
  records.erase(found);
}

bool BrokerCore::Impl::repeat_record(const RequestId& id, const std::string& peer) {
  const auto found = records.find(id);
  if (found == records.end()) return false;
  const Record& record = found->second;
  const Request request{.id = id, .route = Route::own, .peer = peer};
  for (std::size_t i = 0; i < record.partials.size(); ++i)
    deliver_partial(request, record.service, record.partials[i], static_cast<std::uint32_t>(i));
  deliver(request, record.service, record.outcome, record.reason, record.attempts, record.partials,
          record.reply);
  return true;
}

}  // namespace ssphh::majordomo

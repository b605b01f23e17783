#include "client_core.h"

#include <algorithm>

namespace ssphh::majordomo {
namespace {

constexpr std::size_t acks_at_once = 256;
constexpr Millis ack_pause = 200;
constexpr Millis grace = 1000;  // beyond the deadline, for the broker's own word on it to arrive

}  // namespace

RequestId ClientCore::submit(Millis now, const std::string& service, Frames&& body,
                             const RequestOptions& options) {
  const RequestId id = options.id ? *options.id : new_id_();
  const auto [entry, fresh] = pending_.try_emplace(id);
  if (!fresh) return id;
  if (body.empty()) body.emplace_back();
  Pending& request = entry->second;
  request.service = service;
  request.body = std::make_shared<const Frames>(std::move(body));
  request.options = options;
  request.place = waiting_.insert(waiting_.end(), id);
  if (options.deadline > 0) {
    request.expires = now + options.deadline;
    request.deadline = timers_.set(request.expires + (own() ? grace : 0), [this, id](Millis t) {
      const Entry late = pending_.find(id);
      late->second.deadline = {};
      finish(t, late, {.id = id, .outcome = Outcome::expired, .body = {}, .reason = "its deadline passed"});
      fill_window(t);
    });
  }
  fill_window(now);
  return id;
}

void ClientCore::fill_window(Millis now) {
  const std::size_t window = own() ? options_.window : 1;
  while (!waiting_.empty() && sent_.size() < window && !pause_.serial) {
    const Entry entry = pending_.find(waiting_.front());
    sent_.splice(sent_.end(), waiting_, waiting_.begin());
    entry->second.sent = true;
    send(now, entry);
  }
  arm(now);
}

void ClientCore::send(Millis now, Entry entry) {
  Pending& request = entry->second;
  request.asked = now;
  const Version version = options_.dialect == Dialect::mdp01 ? Version::v01 : Version::v02;
  Frames head = encode_head(version, Side::client, Command::request, request.service);
  if (own()) {
    head.push_back(encode_envelope(
        {.kind = EnvelopeKind::submit,
         .ids = {entry->first},
         .deadline = request.expires == Timers::never ? 0 : std::max<Millis>(1, request.expires - now),
         .attempt_timeout = std::max<Millis>(0, request.options.attempt_timeout),
         .content_key = request.options.content_key,
         .persistent = request.options.persistent}));
  }
  out_.push_back({std::move(head), request.body});
}

void ClientCore::arm(Millis now) {
  timers_.cancel(ask_timer_);
  if (sent_.empty()) return;
  const Pending& first = pending_.at(sent_.front());
  const Millis wait = own() ? options_.ask_again : options_.foreign_timeout;
  ask_timer_ = timers_.set(std::max(now, first.asked + wait), [this](Millis t) {
    ask_timer_ = {};
    if (own()) {
      ask(t);
    } else {
      foreign_overdue(t, sent_.front());
    }
  });
}

void ClientCore::ask(Millis now) {
  std::vector<RequestId> ids;
  while (!sent_.empty() && ids.size() < envelope_ids) {
    Pending& request = pending_.at(sent_.front());
    if (request.asked + options_.ask_again > now) break;
    request.asked = now;
    ids.push_back(sent_.front());
    sent_.splice(sent_.end(), sent_, sent_.begin());
  }
  if (!ids.empty()) query(std::move(ids));
  arm(now);
}

void ClientCore::query(std::vector<RequestId>&& ids) {
  control({.kind = EnvelopeKind::query, .ids = std::move(ids)});
}

void ClientCore::control(const Envelope& envelope) {
  Frames head = encode_head(Version::v02, Side::client, Command::request, control_service);
  head.push_back(encode_envelope(envelope));
  out_.push_back({std::move(head), nullptr});
}

void ClientCore::connected(Millis now) {
  if (!own()) return;
  for (const RequestId& id : sent_) pending_.at(id).asked = now - options_.ask_again;
  while (!sent_.empty() && pending_.at(sent_.front()).asked + options_.ask_again <= now) ask(now);
}

void ClientCore::cancel(Millis now, const RequestId& id) {
  const Entry entry = pending_.find(id);
  if (entry == pending_.end()) return;
  if (own() && entry->second.sent) control({.kind = EnvelopeKind::cancel, .ids = {id}});
  if (!own() && entry->second.sent) reconnect_ = true;  // else its reply would be taken for the next one's
  finish(now, entry, {.id = id, .outcome = Outcome::cancelled, .body = {}, .reason = "by its client"});
  fill_window(now);
}

void ClientCore::finish(Millis now, Entry entry, ClientEvent&& event) {
  timers_.cancel(entry->second.deadline);
  (entry->second.sent ? sent_ : waiting_).erase(entry->second.place);
  pending_.erase(entry);
  ++finals_;
  events_.push_back(std::move(event));
  arm(now);
}

void ClientCore::receive(Millis now, Frames&& frames) {
  Decoded decoded = decode(std::move(frames), Direction::to_peer);
  if (!decoded.message || decoded.message->side != Side::client) return;
  heard_ = true;
  if (own()) {
    receive_own(now, std::move(*decoded.message));
  } else {
    receive_foreign(now, std::move(*decoded.message));
  }
  fill_window(now);
}

void ClientCore::wait_again(Entry entry) {
  Pending& request = entry->second;
  request.sent = false;
  waiting_.splice(waiting_.begin(), sent_, request.place);
}

void ClientCore::receive_own(Millis now, Message&& message) {
  const auto envelope = decode_envelope(message.body[0]);
  if (!envelope) return;
  if (envelope->kind == EnvelopeKind::unknown) {
    for (const RequestId& id : envelope->ids)
      if (const Entry entry = pending_.find(id); entry != pending_.end() && entry->second.sent) {
        sent_.splice(sent_.end(), sent_, entry->second.place);
        send(now, entry);
      }
    return;
  }
  if (envelope->ids.size() != 1) return;
  const RequestId& id = envelope->ids[0];
  const Entry entry = pending_.find(id);
  if (entry == pending_.end()) {
    if (envelope->kind == EnvelopeKind::final) acknowledge(now, id);
    return;
  }
  Pending& request = entry->second;
  if (!request.sent) return;
  request.asked = now;
  sent_.splice(sent_.end(), sent_, request.place);
  Frames body(std::make_move_iterator(message.body.begin() + 1), std::make_move_iterator(message.body.end()));
  switch (envelope->kind) {
    case EnvelopeKind::partial:
      if (envelope->sequence != request.partials) return;  // heard before, on another connection
      ++request.partials;
      events_.push_back({.id = id, .final = false, .body = std::move(body), .reason = {}});
      return;
    case EnvelopeKind::busy:
      wait_again(entry);
      timers_.cancel(pause_);
      pause_ = timers_.set(now + std::clamp<Millis>(envelope->retry_after, 10, 60'000), [this](Millis t) {
        pause_ = {};
        fill_window(t);
      });
      return;
    case EnvelopeKind::final:
      if (envelope->outcome == Outcome::ok && envelope->sequence > request.partials) return query({id});
      if (envelope->outcome != Outcome::ok) body.clear();
      finish(now, entry,
             {.id = id,
              .outcome = envelope->outcome,
              .body = std::move(body),
              .reason = envelope->reason,
              .attempts = static_cast<int>(envelope->attempts)});
      acknowledge(now, id);
      return;
    default:
      return;
  }
}

void ClientCore::receive_foreign(Millis now, Message&& message) {
  const Version version = options_.dialect == Dialect::mdp01 ? Version::v01 : Version::v02;
  if (sent_.empty() || message.version != version) return;
  const RequestId id = sent_.front();
  const Entry entry = pending_.find(id);
  if (message.name != entry->second.service) return;
  if (message.command == Command::partial) {
    entry->second.asked = now;
    events_.push_back({.id = id, .final = false, .body = std::move(message.body), .reason = {}});
    return;
  }
  finish(now, entry, {.id = id, .body = std::move(message.body), .reason = {}});
}

void ClientCore::foreign_overdue(Millis now, const RequestId& overdue) {
  const RequestId id = overdue;
  const Entry entry = pending_.find(id);
  reconnect_ = true;
  if (++entry->second.tries >= options_.foreign_tries) {
    finish(now, entry,
           {.id = id, .outcome = Outcome::no_answer, .body = {}, .reason = "the broker is silent"});
  } else {
    send(now, entry);
  }
  fill_window(now);
}

void ClientCore::acknowledge(Millis now, const RequestId& id) {
  acks_.push_back(id);
  if (acks_.size() >= acks_at_once) return flush_acks();
  if (!ack_timer_.serial) {
    ack_timer_ = timers_.set(now + ack_pause, [this](Millis) { flush_acks(); });
  }
}

void ClientCore::flush_acks() {
  timers_.cancel(ack_timer_);
  control({.kind = EnvelopeKind::ack, .ids = std::exchange(acks_, {})});
}

void ClientCore::tick(Millis now) {
  timers_.run(now);
}

std::optional<ClientEvent> ClientCore::next_event() {
  if (events_.empty()) return std::nullopt;
  ClientEvent event = std::move(events_.front());
  events_.pop_front();
  finals_ -= event.final ? 1 : 0;
  return event;
}

std::vector<RequestId> ClientCore::to_cancel() const {
  std::vector<RequestId> ids;
  for (const auto& [id, request] : pending_)
    if (request.sent && !request.options.persistent) ids.push_back(id);
  return ids;
}

}  // namespace ssphh::majordomo

#include "worker_core.h"

#include <algorithm>

namespace ssphh::majordomo {

void WorkerCore::send(Millis now, Command command, std::string_view name, Body body) {
  sent_ = now;
  out_.push_back({encode_head(version(), Side::worker, command, name), std::move(body)});
}

void WorkerCore::connected(Millis now) {
  state_ = State::open;
  heard_ = now;
  send(now, Command::ready, options_.service);
  if (late_) {
    send_result(now, std::move(*late_));
    late_.reset();
  }
  if (stopping_) leave(now);
}

void WorkerCore::receive(Millis now, Frames&& frames) {
  if (state_ != State::open) return;
  Decoded decoded = decode(std::move(frames), Direction::to_peer);
  if (!decoded.message || decoded.message->side != Side::worker || decoded.message->version != version())
    return;
  Message& message = *decoded.message;
  heard_ = now;
  pause_ = options_.reconnect;
  switch (message.command) {
    case Command::request:
      if (busy_ || stopping_)
        return;  // in the latter case DISCONNECT is on its way: the broker tries another
      busy_ = true;
      cancelled_ = stale_ = incomplete_ = false;
      address_ = std::move(message.name);
      token_ = Token::parse(address_);
      job_ = std::move(message);
      return;
    case Command::heartbeat: {
      if (message.body.empty()) return;
      const auto envelope = decode_envelope(message.body[0]);
      if (!envelope) return;
      if (envelope->kind == EnvelopeKind::leave) return stop(now);
      if (envelope->kind == EnvelopeKind::cancel_job && busy_ && envelope->token == token_) cancelled_ = true;
      return;
    }
    case Command::disconnect:
      return close(now);
    default:
      return;
  }
}

void WorkerCore::close(Millis now) {
  state_ = State::closed;
  stale_ = busy_;
  connect_at_ = now + pause_;
  pause_ = std::min(2 * pause_, options_.reconnect_max);
}

void WorkerCore::tick(Millis now) {
  if (state_ != State::open) return;
  if (now - heard_ >= options_.broker_expiry) return close(now);
  if (now - sent_ >= options_.heartbeat) send(now, Command::heartbeat);
}

Millis WorkerCore::next_deadline() const {
  if (state_ == State::open) return std::min(heard_ + options_.broker_expiry, sent_ + options_.heartbeat);
  return connect_at().value_or(Timers::never);
}

std::optional<Millis> WorkerCore::connect_at() const {
  if (state_ == State::open || finished_ || (busy_ && stale_)) return std::nullopt;
  return connect_at_;
}

void WorkerCore::partial(Millis now, Frames&& body) {
  // 0.1 has no PARTIAL: all go with the REPLY.
  if (body.empty()) body.emplace_back();
  if (stale_) incomplete_ = true;
  if (!busy_ || stale_) return;
  if (version() == Version::v01) {
    if (!late_) late_.emplace();
    late_->body.insert(late_->body.end(), std::make_move_iterator(body.begin()),
                       std::make_move_iterator(body.end()));
    return;
  }
  send(now, Command::partial, address_, std::make_shared<const Frames>(std::move(body)));
}

void WorkerCore::done(Millis now, JobResult&& result) {
  if (late_ && result.outcome == Outcome::ok)  // PARTIALs that were kept
    result.body.insert(result.body.begin(), std::make_move_iterator(late_->body.begin()),
                       std::make_move_iterator(late_->body.end()));
  late_.reset();
  busy_ = false;
  ++served_;
  if (state_ == State::open && !stale_) {
    send_result(now, std::move(result));
  } else if (token_ && result.outcome == Outcome::ok && !incomplete_) {
    late_ = std::move(result);  // our broker takes it from a new connection, too
    connect_at_ = std::min(connect_at_, now + options_.reconnect);
  }
  if (stopping_ && state_ == State::open) leave(now);
  if (stopping_ && state_ == State::closed && !late_) finished_ = true;
}

void WorkerCore::send_result(Millis now, JobResult&& result) {
  if (result.body.empty()) result.body.emplace_back();
  if (!token_) {
    // A foreign broker has no word for failure: leaving lets it, or its client, try again.
    if (result.outcome != Outcome::ok) {
      send(now, Command::disconnect);
      return close(now);
    }
  } else {
    result.body.insert(result.body.begin(), encode_envelope({.kind = EnvelopeKind::result,
                                                             .outcome = result.outcome,
                                                             .retry = result.retry,
                                                             .reason = std::move(result.reason),
                                                             .token = token_}));
  }
  send(now, Command::reply, address_, std::make_shared<const Frames>(std::move(result.body)));
}

void WorkerCore::stop(Millis now) {
  stopping_ = true;
  if (busy_) return;
  if (state_ == State::open) {
    leave(now);
  } else if (!late_) {
    finished_ = true;
  }
}

void WorkerCore::leave(Millis now) {
  send(now, Command::disconnect);
  state_ = State::closed;
  finished_ = true;
}

}  // namespace ssphh::majordomo

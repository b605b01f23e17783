#pragma once
/// Drives a BrokerCore with raw frames written from the RFCs and a clock of its own.

#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/majordomo/broker_core.h>
#include <ssphh/majordomo/envelope.h>

namespace ssphh::majordomo::test {

using std::string_literals::operator""s;

/// Random numbers that tests can repeat.
inline BrokerCore::Random sequence(std::uint64_t seed = 1) {
  return [n = seed << 32]() mutable {
    ++n;
    return std::array<std::uint64_t, 2>{n * 0x9e3779b97f4a7c15ull, n};
  };
}

// 7/MDP
inline Frames client01(const std::string& service, Frames body) {
  body.insert(body.begin(), {"", "MDPC01", service});
  return body;
}
inline Frames ready01(const std::string& service) {
  return {"", "MDPW01", "\x01", service};
}
inline Frames reply01(const std::string& address, Frames body) {
  body.insert(body.begin(), {"", "MDPW01", "\x03", address, ""});
  return body;
}
inline const Frames heartbeat01 = {"", "MDPW01", "\x04"};
inline const Frames disconnect01 = {"", "MDPW01", "\x05"};
// 18/MDP
inline Frames client02(const std::string& service, Frames body) {
  body.insert(body.begin(), {"MDPC02", "\x01", service});
  return body;
}
inline Frames ready02(const std::string& service) {
  return {"MDPW02", "\x01", service};
}
inline Frames partial02(const std::string& address, Frames body) {
  body.insert(body.begin(), {"MDPW02", "\x03", address, ""});
  return body;
}
inline Frames final02(const std::string& address, Frames body) {
  body.insert(body.begin(), {"MDPW02", "\x04", address, ""});
  return body;
}
inline const Frames heartbeat02 = {"MDPW02", "\x05"};
inline const Frames disconnect02 = {"MDPW02", "\x06"};

/// A request of our own client.
inline Frames submit(const std::string& service, Envelope envelope, const std::string& body = "body") {
  envelope.kind = EnvelopeKind::submit;
  return client02(service, {encode_envelope(envelope), body});
}
inline Frames control(EnvelopeKind kind, std::vector<RequestId> ids) {
  return client02(std::string(control_service), {encode_envelope({.kind = kind, .ids = std::move(ids)})});
}

/// Identities of workers of ours, as the broker sees them.
inline const std::string own_a = "ssphh1:a#1", own_b = "ssphh1:b#2", own_c = "ssphh1:c#3";

/// The FINAL of a worker of ours.
inline Frames result(const std::string& address, Envelope envelope, const std::string& body = "result") {
  envelope.kind = EnvelopeKind::result;
  envelope.token = Token::parse(address);
  return final02(address, {encode_envelope(envelope), body});
}

class Harness {
 public:
  explicit Harness(BrokerLimits limits = {}, BrokerTimers timers = {}, bool has_store = false)
      : core(limits, timers, sequence(), has_store) {
    core.tick(now);
  }

  void send(const std::string& peer, Frames frames, const Rights& rights = {}) {
    core.receive(now, peer, std::move(frames), rights);
    collect();
  }
  void gone(const std::string& peer) {
    core.peer_gone(now, peer);
    collect();
  }
  void revoke(const std::string& peer) {
    core.revoke(now, peer);
    collect();
  }
  /// Lets time pass and everything happen that is due on the way.
  void pass(Millis time) {
    const Millis end = now + time;
    while (core.next_deadline() <= end) {
      now = std::max(now, core.next_deadline());
      core.tick(now);
      collect();
    }
    now = end;
  }
  /// What came for a peer since the last call; HEARTBEATs without a body only when asked for.
  std::vector<Frames> taken(const std::string& peer, bool heartbeats = false) {
    std::vector<Frames> result;
    for (Frames& frames : inbox[peer])
      if (heartbeats || (frames != heartbeat01 && frames != heartbeat02)) result.push_back(std::move(frames));
    inbox.erase(peer);
    return result;
  }
  /// The client-address frame of the one REQUEST that came for a worker of 0.2; empty when there is none.
  std::string job_of(const std::string& worker) {
    const auto all = taken(worker);
    if (all.size() != 1 || all[0].size() < 5 || all[0][1] != "\x02") return {};
    return all[0][2];
  }
  /// The envelopes that came for a client of ours.
  std::vector<Envelope> envelopes(const std::string& peer) {
    std::vector<Envelope> result;
    for (const Frames& frames : taken(peer))
      if (frames.size() > 3)
        if (const auto envelope = decode_envelope(frames[3])) result.push_back(*envelope);
    return result;
  }
  std::size_t count_events(const std::string& name) const {
    std::size_t count = 0;
    for (const BrokerEvent& event : events) count += event.name == name;
    return count;
  }

  Millis now = 1000;
  BrokerCore core;
  std::map<std::string, std::vector<Frames>> inbox;
  std::vector<BrokerEvent> events;
  std::vector<StoreOperation> store;

 private:
  void collect() {
    BrokerOutputs out = core.take();
    for (Outgoing& message : out.messages) {
      Frames frames = std::move(message.head);
      if (message.body) frames.insert(frames.end(), message.body->begin(), message.body->end());
      inbox[message.peer].push_back(std::move(frames));
    }
    std::move(out.events.begin(), out.events.end(), std::back_inserter(events));
    std::move(out.store.begin(), out.store.end(), std::back_inserter(store));
  }
};

}  // namespace ssphh::majordomo::test

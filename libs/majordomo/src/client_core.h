#pragma once
/// A client as a pure state machine: requests, frames and the time in; frames and news out.

#include <deque>
#include <functional>
#include <list>
#include <unordered_map>

#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>

#include "timers.h"

namespace ssphh::majordomo {

/// Frames to the broker: `head`, then `body` unless it is null.
struct ToBroker {
  Frames head;
  Body body;
};

class ClientCore {
 public:
  ClientCore(const ClientOptions& options, std::function<RequestId()> new_id)
      : options_(options), new_id_(std::move(new_id)) {}

  RequestId submit(Millis now, const std::string& service, Frames&& body, const RequestOptions& options);
  void cancel(Millis now, const RequestId& id);
  void receive(Millis now, Frames&& frames);
  /// The connection stands, perhaps again: what was on its way may be lost.
  void connected(Millis now);
  void tick(Millis now);
  Millis next_deadline() const { return timers_.next(); }

  std::vector<ToBroker> take() { return std::exchange(out_, {}); }
  std::optional<ClientEvent> next_event();
  /// Requests whose FINAL next_event() has not given yet.
  std::size_t outstanding() const { return pending_.size() + finals_; }
  bool heard() const { return heard_; }
  /// Whether a foreign broker wants to be asked on a new socket; true once per occasion.
  bool take_reconnect() { return std::exchange(reconnect_, false); }
  /// Ids of what is outstanding and not persistent.
  std::vector<RequestId> to_cancel() const;

 private:
  struct Pending {
    std::string service;
    Body body;
    RequestOptions options;
    Millis expires = Timers::never;
    Timers::Handle deadline;
    bool sent = false;
    Millis asked = 0;                      ///< when it was last sent or asked for
    std::list<RequestId>::iterator place;  ///< in sent_ or waiting_
    std::uint32_t partials = 0;
    int tries = 0;
  };
  using Entry = std::unordered_map<RequestId, Pending>::iterator;

  bool own() const { return options_.dialect == Dialect::own; }
  void fill_window(Millis now);
  void send(Millis now, Entry entry);
  void wait_again(Entry entry);
  void ask(Millis now);
  void arm(Millis now);
  void finish(Millis now, Entry entry, ClientEvent&& event);
  void receive_own(Millis now, Message&& message);
  void receive_foreign(Millis now, Message&& message);
  void foreign_overdue(Millis now, const RequestId& id);
  void query(std::vector<RequestId>&& ids);
  void acknowledge(Millis now, const RequestId& id);
  void flush_acks();
  void control(const Envelope& envelope);

  ClientOptions options_;
  std::function<RequestId()> new_id_;
  Timers timers_;
  std::unordered_map<RequestId, Pending> pending_;
  std::list<RequestId> waiting_, sent_;  ///< sent_: longest without news first
  std::vector<RequestId> acks_;
  Timers::Handle ask_timer_, ack_timer_, pause_;
  std::deque<ClientEvent> events_;
  std::size_t finals_ = 0;  ///< in events_
  std::vector<ToBroker> out_;
  bool heard_ = false, reconnect_ = false;
};

}  // namespace ssphh::majordomo

#include "outbox.h"

namespace ssphh::majordomo {
namespace {

std::size_t size_of(const Outgoing& message) {
  return byte_count(message.head) + (message.body ? byte_count(*message.body) : 0);
}

}  // namespace

void Outbox::send(zmq::socket_t& socket, Outgoing&& message, std::vector<std::string>& lost) {
  auto found = waiting_.find(message.peer);
  if (found == waiting_.end()) {
    const Sent sent = send_message(socket, &message.peer, message.head, message.body);
    if (sent == Sent::yes) return;
    if (sent == Sent::unreachable) return lost.push_back(std::move(message.peer));
    found = waiting_.emplace(message.peer, Queue{}).first;
  }
  Queue& queue = found->second;
  queue.bytes += size_of(message);
  queue.messages.push_back(std::move(message));
  if (queue.bytes <= limit_) return;
  lost.push_back(found->first);
  waiting_.erase(found);
}

void Outbox::flush(zmq::socket_t& socket, std::vector<std::string>& lost) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    Queue& queue = it->second;
    Sent sent = Sent::yes;
    while (!queue.messages.empty()) {
      const Outgoing& message = queue.messages.front();
      sent = send_message(socket, &message.peer, message.head, message.body);
      if (sent != Sent::yes) break;
      queue.bytes -= size_of(message);
      queue.messages.pop_front();
    }
    if (sent == Sent::unreachable) lost.push_back(it->first);
    it = sent == Sent::full ? std::next(it) : waiting_.erase(it);
  }
}

}  // namespace ssphh::majordomo

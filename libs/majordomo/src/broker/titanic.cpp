/// 9/TSP: requests that a client leaves at the broker and asks for later, by uuid.
#include "state.h"

namespace ssphh::majordomo {

Frames BrokerCore::Impl::titanic(const Message& message, const Frames& body, const std::string& owner) {
  if (message.name == "titanic.request") {
    if (body.size() < 2 || !is_service_name(body[0], limits.service_name_bytes) || is_internal(body[0]))
      return {"400"};
    const std::size_t bytes = byte_count(body);
    if (draining || over_limits(owner, bytes) || stored_bytes + bytes > limits.stored_bytes ||
        (!services.contains(body[0]) && services.size() >= limits.services))
      return {"500"};
    const auto bits = random();
    const RequestId id{bits[0], bits[1]};
    const auto job = std::make_shared<const Frames>(body.begin() + 1, body.end());
    stored_bytes += byte_count(*job);
    out.store.push_back({StoreOperation::add, {.id = id, .service = body[0], .body = job}});
    enqueue({.id = id, .route = Route::stored, .persistent = true}, owner, body[0], job, {});
    return {"200", id.hex()};
  }
  const auto id = RequestId::parse(body[0]);
  if (message.name == "titanic.reply") {
    if (!id) return {"400"};
    if (requests.contains(*id)) return {"300"};
    const auto found = records.find(*id);
    if (found == records.end()) return {"400"};
    const Record& record = found->second;
    if (record.outcome != Outcome::ok) return {"500"};
    Frames reply = {"200"};
    for (const Body& part : record.partials) reply.insert(reply.end(), part->begin(), part->end());
    reply.insert(reply.end(), record.reply->begin(), record.reply->end());
    return reply;
  }
  if (message.name == "titanic.close") {
    if (!id) return {"400"};
    forget_record(*id);
    end_request(*id, Outcome::cancelled, "closed");
    return {"200"};
  }
  return {"501"};
}

}  // namespace ssphh::majordomo

/// What cannot be sent yet is kept to the byte that it may be, and sent in its order.

#include "outbox.h"

#include <thread>

#include <gmock/gmock.h>

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A ROUTER with a peer that reads nothing, and whose queue is full.
class FullOutbox : public testing::Test {
 protected:
  FullOutbox() : router(context, zmq::socket_type::router), peer(context, zmq::socket_type::dealer) {
    for (zmq::socket_t* socket : {&router, &peer}) socket->set(zmq::sockopt::linger, 0);
    router.set(zmq::sockopt::sndhwm, 1);
    router.set(zmq::sockopt::router_mandatory, true);
    router.bind("inproc://outbox");
    peer.set(zmq::sockopt::rcvhwm, 1);
    peer.set(zmq::sockopt::routing_id, "p");
    peer.connect("inproc://outbox");
    send_message(peer, nullptr, {"hello"}, nullptr);
    receive_message(router);
    while (send_message(router, &name, {"fills"}, nullptr) == Sent::yes) ++sent;
  }

  Outgoing message(const std::string& head, const std::string& body = {}) const {
    return {name, {head}, body.empty() ? nullptr : std::make_shared<const Frames>(Frames{body})};
  }

  const std::string name = "p";
  zmq::context_t context;
  zmq::socket_t router, peer;
  int sent = 0;
  std::vector<std::string> lost;
};

TEST_F(FullOutbox, KeepsAsManyBytesAsItMay) {
  Outbox outbox(12);
  outbox.send(router, message("12345"), lost);
  outbox.send(router, message("123", "4567"), lost);
  EXPECT_FALSE(outbox.empty());
  EXPECT_THAT(lost, IsEmpty()) << "5 bytes and 3 + 4";
  outbox.send(router, message("1"), lost);
  EXPECT_THAT(lost, ElementsAre("p"));
  EXPECT_TRUE(outbox.empty()) << "a peer that is too slow is given up whole";
}

TEST_F(FullOutbox, SendsWhatWaitsInItsOrderWhenThereIsRoomAgain) {
  Outbox outbox(100);
  outbox.send(router, message("first"), lost);
  outbox.send(router, message("second", "with a body"), lost);
  outbox.flush(router, lost);
  EXPECT_FALSE(outbox.empty()) << "there is still no room";
  for (int i = 0; i < sent; ++i) EXPECT_TRUE(receive_message(peer));
  std::vector<Frames> come;
  for (int i = 0; i < 200 && come.size() < 2; ++i) {
    outbox.flush(router, lost);
    if (const auto next = receive_message(peer)) come.push_back(next->frames);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // ZeroMQ looks for room once in a while
  }
  EXPECT_THAT(come, ElementsAre(ElementsAre("first"), ElementsAre("second", "with a body")));
  EXPECT_TRUE(outbox.empty());
  EXPECT_THAT(lost, IsEmpty());
}

TEST_F(FullOutbox, ForgetsAPeerThatIsGone) {
  Outbox outbox(100);
  outbox.send(router, message("first"), lost);
  outbox.forget("p");
  EXPECT_TRUE(outbox.empty());
  outbox.send(router, {"nobody", {"x"}, nullptr}, lost);
  EXPECT_THAT(lost, ElementsAre("nobody")) << "a peer that there is not";
}

}  // namespace
}  // namespace ssphh::majordomo::test

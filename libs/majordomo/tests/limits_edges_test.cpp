/// Every limit of the broker, on both sides: the last that is taken and the first that is not.

#include "broker_harness.h"
#include "json_text.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string* reason(const BrokerEvent& event) {
  for (const auto& [name, value] : event.fields)
    if (name == std::string_view("reason")) return &value;
  return nullptr;
}

class Edge : public testing::Test {
 protected:
  /// Starts over with these limits.
  void begin(const BrokerLimits& limits) { h = std::make_unique<Harness>(limits, BrokerTimers{}, true); }
  /// What becomes of a request with a body of so many bytes: empty, or why it was not taken.
  std::string submitted(std::size_t bytes, bool persistent = false, const std::string& client = "c") {
    const RequestId id{++number_, 3};
    h->send(client, submit("gen", {.ids = {id}, .persistent = persistent}, std::string(bytes, 'x')));
    for (const Envelope& news : h->envelopes(client)) {
      if (news.kind == EnvelopeKind::busy) return "busy: " + news.reason;
      if (news.kind == EnvelopeKind::final) return std::string(name_of(news.outcome)) + ": " + news.reason;
    }
    return "";
  }
  void cancel_last() { h->send("c", control(EnvelopeKind::cancel, {{number_, 3}})), h->taken("c"); }
  /// Why a message of these frames is dropped; empty when it is not.
  std::string dropped(Frames frames, const std::string& peer = "p") {
    const std::size_t before = h->events.size();
    const std::uint64_t drops = h->core.stats().dropped;
    h->send(peer, std::move(frames));
    if (h->core.stats().dropped == drops) return "";
    for (std::size_t i = before; i < h->events.size(); ++i)
      if (h->events[i].name == std::string("message-dropped")) return *reason(h->events[i]);
    return "dropped without a word";
  }

  std::unique_ptr<Harness> h = std::make_unique<Harness>(BrokerLimits{}, BrokerTimers{}, true);

 private:
  std::uint64_t number_ = 0;
};

TEST_F(Edge, FramesOfAMessage) {
  begin({.message_frames = 6});
  EXPECT_EQ(dropped(client02("gen", {"1", "2", "3"})), "");
  EXPECT_EQ(dropped(client02("gen", {"1", "2", "3", "4"})), "too many frames");
}

TEST_F(Edge, FramesOfAMessageAreSixtyFour) {
  EXPECT_EQ(dropped(client02("gen", Frames(61, "x"))), "");
  EXPECT_EQ(dropped(client02("gen", Frames(62, "x"))), "too many frames");
}

TEST_F(Edge, BytesOfAFrame) {
  begin({.frame_bytes = 50});
  EXPECT_EQ(dropped(client02("gen", {std::string(50, 'x')})), "");
  EXPECT_EQ(dropped(client02("gen", {std::string(51, 'x')})), "frame too large");
}

TEST_F(Edge, BytesOfAMessage) {
  begin({.message_bytes = 100});  // of which header, command and service are ten
  EXPECT_EQ(dropped(client02("gen", {std::string(44, 'x'), std::string(46, 'x')})), "");
  EXPECT_EQ(dropped(client02("gen", {std::string(45, 'x'), std::string(46, 'x')})), "message too large");
}

TEST_F(Edge, BytesOfAServiceName) {
  begin({.service_name_bytes = 20});
  EXPECT_EQ(dropped(client02(std::string(20, 's'), {"x"}), "a"), "");
  EXPECT_EQ(dropped(client02(std::string(21, 's'), {"x"}), "b"), "bad service name");
  EXPECT_EQ(dropped(ready02(std::string(20, 's')), "v"), "");
  EXPECT_EQ(dropped(ready02(std::string(21, 's')), "w"), "bad service name");
}

TEST_F(Edge, BytesOfAServiceNameAre255) {
  EXPECT_EQ(dropped(client02(std::string(255, 's'), {"x"}), "a"), "");
  EXPECT_EQ(dropped(client02(std::string(256, 's'), {"x"}), "b"), "bad service name");
}

TEST_F(Edge, CharactersOfAServiceName) {
  EXPECT_EQ(dropped(client02(" ~", {"x"}), "a"), "");
  EXPECT_EQ(dropped(client02("\x1f", {"x"}), "b"), "bad service name");
  EXPECT_EQ(dropped(client02("\x7f", {"x"}), "c"), "bad service name");
}

TEST_F(Edge, Services) {
  begin({.services = 2});
  EXPECT_EQ(dropped(client02("one", {"x"}), "a"), "");
  EXPECT_EQ(dropped(ready02("two"), "b"), "");
  EXPECT_EQ(dropped(client02("three", {"x"}), "a"), "too many services");
  EXPECT_EQ(dropped(ready02("three"), "d"), "too many services");
  EXPECT_EQ(submitted(1), "busy: too many services");
  h->send("t", client01("titanic.request", {"three", "x"}));
  EXPECT_EQ(h->taken("t").at(0).at(3), "500");
  EXPECT_EQ(dropped(ready02("one"), "e"), "") << "known ones are no more";
  EXPECT_EQ(dropped(client02("two", {"x"}), "f"), "");
}

TEST_F(Edge, Peers) {
  begin({.peers = 2});
  EXPECT_EQ(dropped(client02("mmi.service", {"x"}), "a"), "");
  EXPECT_EQ(dropped(client02("mmi.service", {"x"}), "b"), "");
  EXPECT_EQ(dropped(client02("mmi.service", {"x"}), "c"), "too many peers");
  EXPECT_EQ(dropped(client02("mmi.service", {"x"}), "a"), "");
  h->gone("a");
  EXPECT_EQ(dropped(client02("mmi.service", {"x"}), "c"), "");
}

TEST_F(Edge, RequestsOfAllClients) {
  begin({.queued_requests = 2});
  EXPECT_EQ(submitted(1, false, "a"), "");
  EXPECT_EQ(submitted(1, false, "b"), "");
  EXPECT_EQ(submitted(1, false, "c"), "busy: too many requests");
  EXPECT_EQ(dropped(client02("gen", {"x"})), "too many requests");
}

TEST_F(Edge, RequestsOfOneClient) {
  begin({.client_requests = 2});
  EXPECT_EQ(submitted(1), "");
  EXPECT_EQ(submitted(1), "");
  EXPECT_EQ(submitted(1), "busy: too many requests of this client");
  EXPECT_EQ(submitted(1, false, "another"), "");
  EXPECT_EQ(dropped(client02("gen", {"x"}), "c"), "too many requests of this client");
}

TEST_F(Edge, BytesOfAllClients) {
  begin({.queued_bytes = 100});
  EXPECT_EQ(submitted(101), "refused: request too large");
  EXPECT_EQ(submitted(60, false, "a"), "");
  EXPECT_EQ(submitted(41), "busy: too many bytes");
  EXPECT_EQ(submitted(40), "");
  EXPECT_EQ(submitted(1, false, "b"), "busy: too many bytes");
  cancel_last();
}

TEST_F(Edge, BytesOfAllClientsCanBeOneRequests) {
  begin({.queued_bytes = 100});
  EXPECT_EQ(submitted(100), "");
}

TEST_F(Edge, BytesOfOneClient) {
  begin({.client_bytes = 100});
  EXPECT_EQ(submitted(101), "refused: request too large");
  EXPECT_EQ(submitted(60), "");
  EXPECT_EQ(submitted(41), "busy: too many bytes of this client");
  EXPECT_EQ(submitted(40), "");
  EXPECT_EQ(submitted(100, false, "another"), "");
}

TEST_F(Edge, BytesOfTheStore) {
  begin({.stored_bytes = 100});
  EXPECT_EQ(submitted(60, true), "");
  EXPECT_EQ(submitted(41, true), "busy: the store is full");
  EXPECT_EQ(submitted(40, true), "");
  EXPECT_EQ(submitted(1, true), "busy: the store is full");
  EXPECT_EQ(submitted(1000), "") << "not for the store";
}

TEST_F(Edge, BytesOfTheStoreAreFreeAgainAfterACancellation) {
  begin({.stored_bytes = 100});
  EXPECT_EQ(submitted(30, true), "");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(submitted(70, true), "") << i;
    EXPECT_EQ(submitted(1, true), "busy: the store is full") << i;
    h->send("c", control(EnvelopeKind::cancel, {{2 + 2 * static_cast<std::uint64_t>(i), 3}}));
    h->taken("c");
  }
}

TEST_F(Edge, BytesOfTheStoreForTitanic) {
  begin({.stored_bytes = 100});
  const auto code = [&](std::size_t bytes) {
    h->send("t", client01("titanic.request", {"gen", std::string(bytes, 'x')}));
    return h->taken("t").at(0).at(3);
  };
  EXPECT_EQ(code(98), "500") << "the service's name counts";
  EXPECT_EQ(code(97), "200");
  EXPECT_EQ(code(1), "500");
}

TEST_F(Edge, RequestsOfOneClientForTitanic) {
  begin({.client_requests = 1});
  for (const char* code : {"200", "500"}) {
    h->send("t", client01("titanic.request", {"gen", "x"}));
    EXPECT_EQ(h->taken("t").at(0).at(3), code);
  }
}

TEST_F(Edge, BytesOfAReply) {
  begin({.reply_bytes = 10});
  for (const auto& [partial, last, outcome] :
       {std::tuple(4, 6, Outcome::ok), std::tuple(4, 7, Outcome::failed), std::tuple(10, 0, Outcome::ok)}) {
    h->send(own_a, ready02("gen"));
    EXPECT_EQ(submitted(1), "");
    const std::string address = h->job_of(own_a);
    h->send(own_a, partial02(address, {std::string(static_cast<std::size_t>(partial), 'p')}));
    h->send(own_a, result(address, {}, std::string(static_cast<std::size_t>(last), 'f')));
    h->send(own_a, disconnect02);
    const auto news = h->envelopes("c");
    ASSERT_THAT(news, SizeIs(2)) << partial;
    EXPECT_EQ(news[1].outcome, outcome) << partial << " + " << last;
    EXPECT_EQ(news[1].reason, outcome == Outcome::ok ? "" : "reply too large");
  }
}

TEST_F(Edge, BytesOfPartials) {
  begin({.reply_bytes = 10});
  h->send(own_a, ready02("gen"));
  EXPECT_EQ(submitted(1), "");
  const std::string address = h->job_of(own_a);
  h->send(own_a, partial02(address, {"12345"}));
  h->send(own_a, partial02(address, {"67890"}));
  EXPECT_THAT(h->envelopes("c"), SizeIs(2));
  h->send(own_a, partial02(address, {"!"}));
  const auto news = h->envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::failed);
  EXPECT_EQ(BrokerRecount::disagreements(h->core), "");
}

TEST_F(Edge, BytesOfRecords) {
  begin({.record_bytes = 2 * 307});
  h->send(own_a, ready02("gen"));
  const auto finish = [&](std::size_t bytes) {
    EXPECT_EQ(submitted(1), "");
    h->send(own_a, result(h->job_of(own_a), {}, std::string(bytes, 'r')));
    h->taken("c");
    return h->core.stats().records;
  };
  EXPECT_EQ(finish(7), 1u);
  EXPECT_EQ(finish(7), 2u) << "just so many";
  EXPECT_EQ(finish(7), 2u);
  h->send("c", control(EnvelopeKind::query, {{1, 3}, {2, 3}, {3, 3}}));
  const auto news = h->envelopes("c");
  ASSERT_THAT(news, SizeIs(3));
  EXPECT_THAT(news[2].ids, ElementsAre(RequestId{1, 3})) << "the oldest is forgotten";
  EXPECT_EQ(finish(8), 1u);
}

TEST_F(Edge, BytesOfResultsThatWaitForForeignClients) {
  begin({.record_bytes = 40});  // of which they may have a quarter
  for (const auto& [bytes, kept] : {std::pair(11, 0), std::pair(6, 6), std::pair(5, 6), std::pair(4, 10)}) {
    h->send("w", ready02("gen"));
    const std::string client = "f" + std::to_string(bytes);
    h->send(client, client02("gen", {client}));
    h->gone(client);
    h->send("w", final02(h->job_of("w"), {std::string(static_cast<std::size_t>(bytes), 'r')}));
    h->send("w", disconnect02);
    EXPECT_EQ(BrokerRecount::books(h->core).orphans, static_cast<std::size_t>(kept)) << bytes;
    EXPECT_EQ(BrokerRecount::disagreements(h->core), "");
  }
}

TEST_F(Edge, MessagesPerSecondAndTheirBurst) {
  begin({.messages_per_second = 4});
  const auto taken = [&](int messages) {
    for (int i = 0; i < messages; ++i) h->send("p", client02("mmi.service", {"x"}));
    return h->taken("p").size();
  };
  EXPECT_EQ(taken(4), 4u);
  EXPECT_EQ(taken(1), 0u);
  h->pass(249);
  EXPECT_EQ(taken(1), 0u);
  h->pass(1);
  EXPECT_EQ(taken(2), 1u);
  h->pass(60'000 - 1);
  EXPECT_EQ(taken(9), 4u) << "no more is saved up than a second's";
  h->pass(1);
}

TEST_F(Edge, MessagesWithoutALimit) {
  begin({.messages_per_second = 0});
  for (int i = 0; i < 1000; ++i) h->send("p", client02("mmi.service", {"x"}));
  EXPECT_THAT(h->taken("p"), SizeIs(1000));
}

/// Parking: every job fails on one worker.
class ParkedEdge : public Edge {
 protected:
  void park(std::size_t bytes) {
    EXPECT_EQ(submitted(bytes), "");
    h->send("w", ready02("gen"));
    h->gone("w");
    h->inbox.clear();
  }
  std::vector<std::size_t> sizes() {
    h->send("admin", client02("mmi.parked", {""}));
    const auto answer = ssphh::test::parse_json(h->taken("admin").at(0).at(4));
    std::vector<std::size_t> all;
    for (const auto& job : answer["jobs"].elements()) all.push_back(ssphh::test::count_of(job["bytes"]));
    return all;
  }
};

TEST_F(ParkedEdge, Attempts) {
  for (const int attempts : {1, 2, 4}) {
    begin({.attempts = attempts});
    EXPECT_EQ(submitted(1), "");
    for (int i = 1; i <= attempts; ++i) {
      EXPECT_EQ(h->core.stats().parked, 0u) << i << " of " << attempts;
      h->send("w", ready02("gen"));
      h->pass(1000);
      h->gone("w");
    }
    EXPECT_EQ(h->core.stats().parked, 1u) << attempts;
  }
}

TEST_F(ParkedEdge, Jobs) {
  begin({.parked_jobs = 3, .attempts = 1});
  for (const std::size_t bytes : {11, 12, 13}) park(bytes);
  EXPECT_THAT(sizes(), ElementsAre(11, 12, 13));
  park(14);
  EXPECT_THAT(sizes(), ElementsAre(12, 13, 14)) << "the oldest is forgotten";
  EXPECT_EQ(BrokerRecount::books(h->core).parked, 39u);
}

TEST_F(ParkedEdge, JobsAreAThousand) {
  begin({.attempts = 1});
  for (int i = 0; i < 1001; ++i) park(1);
  EXPECT_THAT(sizes(), SizeIs(1000));
}

TEST_F(ParkedEdge, Bytes) {
  begin({.parked_bytes = 50, .attempts = 1});
  for (const std::size_t bytes : {20, 30}) park(bytes);
  EXPECT_THAT(sizes(), ElementsAre(20, 30));
  park(1);
  EXPECT_THAT(sizes(), ElementsAre(30, 1));
  park(60);
  EXPECT_THAT(sizes(), ElementsAre(60)) << "the last one is kept, however large";
  EXPECT_EQ(BrokerRecount::books(h->core).parked, 60u);
}

}  // namespace
}  // namespace ssphh::majordomo::test

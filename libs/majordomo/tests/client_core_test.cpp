/// The client's times, on both sides, its window and what it makes of the broker's words.

#include "client_core.h"

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class ClientTimes : public testing::Test {
 protected:
  explicit ClientTimes(ClientOptions options = {})
      : client(options, [this] {
          return RequestId{++made, 5};
        }) {}

  RequestId submit(const RequestOptions& options = {}) {
    return client.submit(now, "gen", {"body"}, options);
  }
  void pass(Millis time) { client.tick(now += time); }
  /// The envelopes that go to the broker.
  std::vector<Envelope> sent() {
    std::vector<Envelope> all;
    for (const ToBroker& message : client.take()) all.push_back(*decode_envelope(message.head.back()));
    return all;
  }
  void hear(Command command, Envelope envelope, Frames body = {""}) {
    Frames frames = encode_head(Version::v02, Side::client, command, "gen");
    frames.push_back(encode_envelope(envelope));
    frames.insert(frames.end(), body.begin(), body.end());
    client.receive(now, std::move(frames));
  }
  void hear_final(const RequestId& id, Envelope envelope = {}) {
    envelope.kind = EnvelopeKind::final;
    envelope.ids = {id};
    hear(Command::reply, envelope, {"result"});
  }
  void hear_busy(const RequestId& id, Millis retry_after) {
    hear(Command::partial, {.kind = EnvelopeKind::busy, .ids = {id}, .retry_after = retry_after});
  }

  Millis now = 70'000;
  std::uint64_t made = 0;
  ClientCore client;
};

TEST_F(ClientTimes, AsksAfterTwoAndAHalfSecondsWithoutNews) {
  const RequestId id = submit();
  EXPECT_EQ(sent().at(0).kind, EnvelopeKind::submit);
  EXPECT_EQ(client.next_deadline(), now + 2500);
  for (int i = 0; i < 2; ++i) {
    pass(2499);
    EXPECT_THAT(sent(), IsEmpty());
    pass(1);
    const auto asked = sent();
    ASSERT_THAT(asked, SizeIs(1));
    EXPECT_EQ(asked[0].kind, EnvelopeKind::query);
    EXPECT_THAT(asked[0].ids, ElementsAre(id));
  }
}

TEST_F(ClientTimes, AcknowledgesEachResultOnceWithin200MillisecondsOr256AtATime) {
  for (int i = 0; i < 257; ++i) submit();
  for (std::uint64_t i = 1; i <= 256; ++i) hear_final({i, 5});
  const auto acks = [&] {
    std::vector<std::size_t> counts;
    for (const Envelope& envelope : sent()) {
      if (envelope.kind == EnvelopeKind::ack) counts.push_back(envelope.ids.size());
    }
    return counts;
  };
  EXPECT_THAT(acks(), ElementsAre(256));
  pass(200);
  EXPECT_THAT(acks(), IsEmpty()) << "nothing is left to acknowledge";
  hear_final({257, 5});
  pass(199);
  EXPECT_THAT(acks(), IsEmpty());
  pass(1);
  EXPECT_THAT(acks(), ElementsAre(1));
}

TEST_F(ClientTimes, AsksOnlyAboutThoseThatAreDue) {
  const RequestId first = submit();
  pass(1000);
  const RequestId second = submit();
  sent();
  pass(1500);
  EXPECT_THAT(sent().at(0).ids, ElementsAre(first));
  pass(1000);
  EXPECT_THAT(sent().at(0).ids, ElementsAre(second));
}

TEST_F(ClientTimes, NewsPutAskingOff) {
  const RequestId id = submit();
  sent();
  pass(2000);
  hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = 0});
  pass(2499);
  EXPECT_THAT(sent(), IsEmpty());
  pass(1);
  EXPECT_THAT(sent(), SizeIs(1));
}

TEST_F(ClientTimes, AsksAboutFourThousandAtOnceWhenConnectedAgain) {
  ClientOptions options;
  options.window = 5000;
  client = ClientCore(options, [this] { return RequestId{++made, 5}; });
  for (int i = 0; i < 4001; ++i) submit();
  sent();
  client.connected(now);
  const auto asked = sent();
  ASSERT_THAT(asked, SizeIs(2));
  EXPECT_THAT(asked[0].ids, SizeIs(4000));
  EXPECT_THAT(asked[1].ids, SizeIs(1));
}

TEST_F(ClientTimes, WindowIsAThousand) {
  for (int i = 0; i < 1001; ++i) submit();
  EXPECT_THAT(sent(), SizeIs(1000));
  hear_final({1, 5});
  EXPECT_THAT(sent(), SizeIs(1)) << "the next one";
  EXPECT_EQ(client.outstanding(), 1001u) << "the first one's event was not taken yet";
  ASSERT_TRUE(client.next_event());
  EXPECT_EQ(client.outstanding(), 1000u);
}

TEST_F(ClientTimes, DeadlineIsTheBrokersToTellForOneSecondMore) {
  submit({.deadline = 4000});
  EXPECT_EQ(sent().at(0).deadline, 4000);
  pass(4999);
  EXPECT_FALSE(client.next_event());
  pass(1);
  const auto event = client.next_event();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::expired);
  EXPECT_EQ(client.outstanding(), 0u);
}

TEST_F(ClientTimes, DeadlineSentAgainIsWhatIsLeftOfIt) {
  const RequestId id = submit({.deadline = 4000, .attempt_timeout = 77});
  sent();
  pass(1500);
  hear(Command::partial, {.kind = EnvelopeKind::unknown, .ids = {id}});
  auto again = sent();
  ASSERT_THAT(again, SizeIs(1));
  EXPECT_EQ(again[0].deadline, 2500);
  EXPECT_EQ(again[0].attempt_timeout, 77);
  pass(2500 - 1);
  hear(Command::partial, {.kind = EnvelopeKind::unknown, .ids = {id}});
  EXPECT_EQ(sent().back().deadline, 1);
  pass(500);
  hear(Command::partial, {.kind = EnvelopeKind::unknown, .ids = {id}});
  EXPECT_EQ(sent().back().deadline, 1) << "0 would be none";
}

TEST_F(ClientTimes, BusyBrokerIsLeftAloneAsLongAsItSays) {
  const RequestId first = submit();
  sent();
  hear_busy(first, 250);
  submit();
  pass(249);
  EXPECT_THAT(sent(), IsEmpty());
  pass(1);
  const auto again = sent();
  ASSERT_THAT(again, SizeIs(2));
  EXPECT_THAT(again[0].ids, ElementsAre(first)) << "the first stays the first";
}

TEST_F(ClientTimes, BusyBrokerIsLeftAloneForTenMillisecondsToAMinute) {
  const RequestId id = submit();
  for (const auto& [told, kept] : {std::pair<Millis, Millis>{0, 10}, {1'000'000, 60'000}}) {
    sent();
    hear_busy(id, told);
    pass(kept - 1);
    EXPECT_THAT(sent(), IsEmpty()) << told;
    pass(1);
    EXPECT_THAT(sent(), SizeIs(1)) << told;
  }
}

TEST_F(ClientTimes, FinalsAreAcknowledgedTogetherAfterAFifthOfASecond) {
  const RequestId first = submit(), second = submit();
  sent();
  hear_final(first);
  pass(150);
  hear_final(second);
  pass(49);
  EXPECT_THAT(sent(), IsEmpty());
  pass(1);
  const auto acks = sent();
  ASSERT_THAT(acks, SizeIs(1));
  EXPECT_EQ(acks[0].kind, EnvelopeKind::ack);
  EXPECT_THAT(acks[0].ids, ElementsAre(first, second));
  pass(1000);
  EXPECT_THAT(sent(), IsEmpty());
}

TEST_F(ClientTimes, FinalsAreAcknowledgedAtOnceWhenTheyAreTwoHundredAndFiftySix) {
  for (int i = 0; i < 256; ++i) submit();
  sent();
  for (std::uint64_t i = 1; i <= 255; ++i) hear_final({i, 5});
  EXPECT_THAT(sent(), IsEmpty());
  hear_final({256, 5});
  const auto acks = sent();
  ASSERT_THAT(acks, SizeIs(1));
  EXPECT_THAT(acks[0].ids, SizeIs(256));
}

TEST_F(ClientTimes, FinalOfAnUnknownRequestIsAcknowledgedSoThatTheBrokerForgetsIt) {
  hear_final({77, 78});
  pass(200);
  EXPECT_THAT(sent().at(0).ids, ElementsAre(RequestId{77, 78}));
}

TEST_F(ClientTimes, FinalBeforeItsPartialsIsAskedForAgain) {
  const RequestId id = submit();
  sent();
  hear_final(id, {.sequence = 1});
  EXPECT_FALSE(client.next_event());
  EXPECT_EQ(sent().at(0).kind, EnvelopeKind::query);
  hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = 0}, {"p"});
  hear_final(id, {.attempts = 3, .sequence = 1});
  EXPECT_FALSE(client.next_event()->final);
  EXPECT_EQ(client.outstanding(), 1u) << "a PARTIAL ends nothing";
  const auto event = client.next_event();
  EXPECT_TRUE(event->final);
  EXPECT_EQ(event->attempts, 3);
  EXPECT_THAT(event->body, ElementsAre("result"));
}

TEST_F(ClientTimes, PartialsOutOfTurnAreNotHeard) {
  const RequestId id = submit();
  hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = 1}, {"second"});
  hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = 0}, {"first"});
  hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = 0}, {"first"});
  EXPECT_THAT(client.next_event()->body, ElementsAre("first"));
  EXPECT_FALSE(client.next_event());
}

// A broker that has started again knows nothing, and the job runs anew with the same PARTIALs.
TEST_F(ClientTimes, PartialsAreHeardOnceThoughTheBrokerForgotTheRequest) {
  const RequestId id = submit();
  const auto hear_partial = [&](std::uint32_t sequence, const char* body) {
    hear(Command::partial, {.kind = EnvelopeKind::partial, .ids = {id}, .sequence = sequence}, {body});
  };
  hear_partial(0, "first");
  hear(Command::partial, {.kind = EnvelopeKind::unknown, .ids = {id}});
  hear_partial(0, "first");
  hear_partial(1, "second");
  hear_final(id, {.sequence = 2});
  std::vector<std::string> heard;
  while (const auto event = client.next_event()) heard.push_back(event->body.at(0));
  EXPECT_THAT(heard, ElementsAre("first", "second", "result"));
}

TEST_F(ClientTimes, LastWordOfABusyBrokerCounts) {
  const RequestId first = submit(), second = submit();
  sent();
  hear_busy(first, 1000);
  pass(400);
  hear_busy(second, 5000);
  pass(4999);
  EXPECT_THAT(sent(), IsEmpty());
  pass(1);
  EXPECT_THAT(sent(), SizeIs(2));
}

TEST_F(ClientTimes, FailureHasItsReasonAndNoBody) {
  const RequestId id = submit();
  hear_final(id, {.outcome = Outcome::parked, .reason = "failed on 3 workers", .attempts = 4, .sequence = 9});
  const auto event = client.next_event();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::parked);
  EXPECT_EQ(event->reason, "failed on 3 workers");
  EXPECT_EQ(event->attempts, 4);
  EXPECT_THAT(event->body, IsEmpty());
}

TEST_F(ClientTimes, CancelTellsTheBrokerOfWhatWasSentAndFreesTheWindow) {
  ClientOptions options;
  options.window = 1;
  client = ClientCore(options, [this] { return RequestId{++made, 5}; });
  const RequestId first = submit(), second = submit(), third = submit();
  sent();
  client.cancel(now, third);
  EXPECT_THAT(sent(), IsEmpty()) << "the broker never heard of it";
  client.cancel(now, first);
  const auto told = sent();
  ASSERT_THAT(told, SizeIs(2));
  EXPECT_EQ(told[0].kind, EnvelopeKind::cancel);
  EXPECT_THAT(told[0].ids, ElementsAre(first));
  EXPECT_THAT(told[1].ids, ElementsAre(second));
  client.cancel(now, first);
  EXPECT_THAT(sent(), IsEmpty());
  EXPECT_EQ(client.next_event()->id, third);
  EXPECT_EQ(client.next_event()->outcome, Outcome::cancelled);
  EXPECT_FALSE(client.next_event());
  EXPECT_EQ(client.outstanding(), 1u);
}

TEST_F(ClientTimes, WhatIsNotPersistentIsToBeCancelledAtTheEnd) {
  const RequestId plain = submit();
  submit({.persistent = true});
  EXPECT_THAT(client.to_cancel(), ElementsAre(plain));
}

class ForeignClientTimes : public ClientTimes {
 protected:
  ForeignClientTimes() : ClientTimes({.dialect = Dialect::mdp02}) {}
};

TEST_F(ForeignClientTimes, ReplyIsAskedForThreeTimesOnNewSocketsAndThenGivenUp) {
  submit();
  for (int tries = 1; tries <= 3; ++tries) {
    EXPECT_THAT(client.take(), SizeIs(1)) << tries;
    pass(2499);
    EXPECT_FALSE(client.take_reconnect());
    pass(1);
    EXPECT_TRUE(client.take_reconnect());
    EXPECT_FALSE(client.take_reconnect()) << "once";
    EXPECT_EQ(client.outstanding(), 1u);
  }
  EXPECT_THAT(client.take(), IsEmpty());
  const auto event = client.next_event();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::no_answer);
}

TEST_F(ForeignClientTimes, DeadlineIsItsOwnToKeep) {
  submit({.deadline = 2000});
  pass(1999);
  EXPECT_FALSE(client.next_event());
  pass(1);
  EXPECT_EQ(client.next_event()->outcome, Outcome::expired);
}

TEST_F(ForeignClientTimes, OneRequestIsOnItsWayAtATime) {
  submit();
  submit();
  EXPECT_THAT(client.take(), SizeIs(1));
  client.receive(now, {"MDPC02", "\x03", "other", "x"});
  EXPECT_FALSE(client.next_event()) << "of another service";
  client.receive(now, {"MDPC02", "\x03", "gen", "x"});
  EXPECT_THAT(client.next_event()->body, ElementsAre("x"));
  EXPECT_THAT(client.take(), SizeIs(1));
}

}  // namespace
}  // namespace ssphh::majordomo::test

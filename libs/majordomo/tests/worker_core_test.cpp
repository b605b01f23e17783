/// The worker's times, on both sides, and what it does with a job when connection or broker go.

#include "worker_core.h"

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const Frame address = Token{1, 2, 3, 4, 5}.frame();

Frames request02(const Frame& client, Frames body) {
  body.insert(body.begin(), {"MDPW02", "\x02", client, ""});
  return body;
}
Frames told02(EnvelopeKind kind, std::optional<Token> token = {}) {
  return {"MDPW02", "\x05", encode_envelope({.kind = kind, .token = token})};
}

class WorkerTimes : public testing::Test {
 protected:
  /// What goes to the broker, whole messages.
  std::vector<Frames> sent() {
    std::vector<Frames> all;
    for (ToBroker& message : worker.take()) {
      if (message.body) message.head.insert(message.head.end(), message.body->begin(), message.body->end());
      all.push_back(std::move(message.head));
    }
    return all;
  }
  void connect() {
    worker.connected(now);
    EXPECT_THAT(sent(), ElementsAre(ready02("gen")));
  }
  void pass(Millis time) { worker.tick(now += time); }
  void hear(Frames frames) { worker.receive(now, std::move(frames)); }
  void begin_job() {
    hear(request02(address, {"body"}));
    ASSERT_TRUE(worker.take_job());
  }
  Frames answer(Frames body) {
    const Frames whole = {"MDPW02", "\x04", address, "",
                          encode_envelope({.kind = EnvelopeKind::result, .token = Token::parse(address)})};
    body.insert(body.begin(), whole.begin(), whole.end());
    return body;
  }

  Millis now = 50'000;
  WorkerCore worker{WorkerOptions{.endpoint = "ipc://x", .service = "gen"}};
};

TEST_F(WorkerTimes, HeartbeatFollowsTwoAndAHalfSecondsOfSayingNothing) {
  connect();
  EXPECT_EQ(worker.next_deadline(), now + 2500);
  pass(2499);
  EXPECT_THAT(sent(), IsEmpty());
  pass(1);
  EXPECT_THAT(sent(), ElementsAre(heartbeat02));
  begin_job();
  pass(1500);
  worker.partial(now, {"p"});
  EXPECT_THAT(sent(), SizeIs(1));
  pass(2499);
  EXPECT_THAT(sent(), IsEmpty()) << "the PARTIAL was one";
  pass(1);
  EXPECT_THAT(sent(), ElementsAre(heartbeat02)) << "while it computes, too";
}

TEST_F(WorkerTimes, BrokerIsGivenUpAfterTenSecondsOfSilence) {
  connect();
  pass(4000);
  hear(heartbeat02);
  pass(9999);
  EXPECT_FALSE(worker.wants_close());
  EXPECT_EQ(worker.next_deadline(), now + 1);
  pass(1);
  EXPECT_TRUE(worker.wants_close());
  EXPECT_EQ(worker.connect_at(), now + 250);
}

TEST_F(WorkerTimes, NonsenseFromTheBrokerIsSilence) {
  connect();
  pass(4000);
  hear({"MDPW02", "\x09"});
  hear(heartbeat01);
  pass(5999);
  EXPECT_FALSE(worker.wants_close());
  pass(1);
  EXPECT_TRUE(worker.wants_close());
}

TEST_F(WorkerTimes, PauseBeforeReconnectingDoublesToTenSecondsAndStartsAnewOnceTheBrokerIsHeard) {
  for (const Millis pause : {250, 500, 1000, 2000, 4000, 8000, 10'000, 10'000}) {
    connect();
    pass(10'000);
    EXPECT_TRUE(worker.wants_close());
    EXPECT_EQ(worker.connect_at(), now + pause);
    EXPECT_EQ(worker.next_deadline(), now + pause);
    now += pause;
    sent();
  }
  connect();
  hear(heartbeat02);
  pass(10'000);
  EXPECT_EQ(worker.connect_at(), now + 250);
}

TEST_F(WorkerTimes, DisconnectIsAnsweredByANewConnection) {
  connect();
  hear(disconnect02);
  EXPECT_TRUE(worker.wants_close());
  EXPECT_EQ(worker.connect_at(), now + 250);
}

TEST(WorkerOptionsOfItsOwn, AreKept) {
  const WorkerOptions options{
      .service = "gen", .heartbeat = 30, .broker_expiry = 70, .reconnect = 11, .reconnect_max = 15};
  WorkerCore worker(options);
  worker.connected(0);
  EXPECT_EQ(worker.next_deadline(), 30);
  worker.tick(30);
  EXPECT_EQ(worker.next_deadline(), 60);
  worker.tick(60);
  EXPECT_EQ(worker.next_deadline(), 70);
  worker.tick(70);
  EXPECT_EQ(worker.connect_at(), 81);
  worker.connected(81);
  worker.tick(151);
  EXPECT_EQ(worker.connect_at(), 166);
}

TEST_F(WorkerTimes, ResultIsAnsweredAndCounted) {
  connect();
  begin_job();
  worker.done(now, {.body = {"r", "s"}});
  EXPECT_THAT(sent(), ElementsAre(answer({"r", "s"})));
  EXPECT_EQ(worker.served(), 1u);
}

TEST_F(WorkerTimes, EmptyResultIsOneEmptyFrame) {
  connect();
  begin_job();
  worker.done(now, {});
  EXPECT_THAT(sent(), ElementsAre(answer({""})));
}

TEST_F(WorkerTimes, ResultOfAJobThatOutlivedItsConnectionIsSentOverTheNext) {
  connect();
  begin_job();
  pass(10'000);
  sent();
  EXPECT_EQ(worker.connect_at(), std::nullopt) << "not while it computes";
  now += 60'000;
  worker.done(now, {.body = {"late"}});
  EXPECT_LE(worker.connect_at(), now);
  worker.connected(now);
  EXPECT_THAT(sent(), ElementsAre(ready02("gen"), answer({"late"})));
  hear(heartbeat02);
  hear(disconnect02);
  worker.connected(now);
  EXPECT_THAT(sent(), ElementsAre(ready02("gen"))) << "once";
}

TEST_F(WorkerTimes, ResultIsDroppedWhenItsPartialsWereLost) {
  connect();
  begin_job();
  hear(disconnect02);
  worker.partial(now, {"lost"});
  worker.done(now, {.body = {"late"}});
  worker.connected(now += 1000);
  EXPECT_THAT(sent(), ElementsAre(ready02("gen")));
}

TEST_F(WorkerTimes, FailureThatOutlivedItsConnectionIsNotTold) {
  connect();
  begin_job();
  hear(disconnect02);
  worker.done(now, {.outcome = Outcome::failed, .reason = "x"});
  worker.connected(now += 1000);
  EXPECT_THAT(sent(), ElementsAre(ready02("gen")));
}

TEST_F(WorkerTimes, OnlyTheTokenOfTheJobInHandCancels) {
  connect();
  begin_job();
  hear(told02(EnvelopeKind::cancel_job, Token{1, 2, 3, 4, 6}));
  EXPECT_FALSE(worker.cancelled());
  hear(told02(EnvelopeKind::cancel_job, Token::parse(address)));
  EXPECT_TRUE(worker.cancelled());
  worker.done(now, {.outcome = Outcome::cancelled});
  begin_job();
  EXPECT_FALSE(worker.cancelled()) << "the next job is another";
}

TEST_F(WorkerTimes, SecondRequestIsIgnoredWhileOneIsInHand) {
  connect();
  begin_job();
  hear(request02(Token{9, 9, 9, 9, 9}.frame(), {"other"}));
  EXPECT_FALSE(worker.take_job());
  worker.done(now, {.body = {"r"}});
  EXPECT_THAT(sent(), ElementsAre(answer({"r"})));
}

TEST_F(WorkerTimes, LeavesAtOnceWhenIdle) {
  connect();
  worker.stop(now);
  EXPECT_THAT(sent(), ElementsAre(disconnect02));
  EXPECT_TRUE(worker.finished());
  EXPECT_FALSE(worker.wants_close());
}

TEST_F(WorkerTimes, ToldToLeaveFinishesItsJobFirst) {
  connect();
  begin_job();
  hear(told02(EnvelopeKind::leave));
  EXPECT_FALSE(worker.finished());
  EXPECT_THAT(sent(), IsEmpty());
  worker.done(now, {.body = {"r"}});
  EXPECT_THAT(sent(), ElementsAre(answer({"r"}), disconnect02));
  EXPECT_TRUE(worker.finished());
}

TEST_F(WorkerTimes, StoppedWithoutAConnectionDeliversItsResultFirst) {
  connect();
  begin_job();
  hear(disconnect02);
  worker.stop(now);
  worker.done(now, {.body = {"late"}});
  EXPECT_FALSE(worker.finished());
  worker.connected(now += 250);
  EXPECT_THAT(sent(), ElementsAre(ready02("gen"), answer({"late"}), disconnect02));
  EXPECT_TRUE(worker.finished());
}

TEST_F(WorkerTimes, StoppedWithoutAConnectionOrResultIsFinished) {
  worker.stop(now);
  EXPECT_TRUE(worker.finished());
}

}  // namespace
}  // namespace ssphh::majordomo::test

/// The rules of 7/MDP, 18/MDP and 8/MMI, with foreign peers, on the state machine.

#include <ssphh/majordomo/mdp.h>

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Mdp01, RequestAndReply) {
  Harness h;
  h.send("w", ready01("echo"));
  h.send("c", client01("echo", {"a", "", "b"}));
  const auto jobs = h.taken("w");
  ASSERT_THAT(jobs, SizeIs(1));
  const Frames& job = jobs[0];
  ASSERT_EQ(job.size(), 8u);
  EXPECT_EQ(Frames(job.begin(), job.begin() + 3), Frames({"", "MDPW01", "\x02"}));
  EXPECT_EQ(Frames(job.begin() + 4, job.end()), Frames({"", "a", "", "b"}));
  EXPECT_LE(job[3].size(), 200u);  // what guide workers echo faithfully
  h.send("w", reply01(job[3], {"x", "y"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"", "MDPC01", "echo", "x", "y"}));
}

TEST(Mdp02, PartialsThenFinal) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  const std::string address = h.job_of("w");
  ASSERT_FALSE(address.empty());
  h.send("w", partial02(address, {"1"}));
  h.send("w", partial02(address, {"2"}));
  h.send("w", final02(address, {"3"}));
  EXPECT_THAT(h.taken("c"),
              ElementsAre(Frames{"MDPC02", "\x02", "echo", "1"}, Frames{"MDPC02", "\x02", "echo", "2"},
                          Frames{"MDPC02", "\x03", "echo", "3"}));
}

TEST(Mixed, PartialsAreFoldedForOldClients) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client01("echo", {"a"}));
  const std::string address = h.job_of("w");
  h.send("w", partial02(address, {"1"}));
  EXPECT_THAT(h.taken("c"), IsEmpty());
  h.send("w", final02(address, {"2", "3"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"", "MDPC01", "echo", "1", "2", "3"}));
}

TEST(Mixed, ReplyOfOldWorkersIsFinal) {
  Harness h;
  h.send("w", ready01("echo"));
  h.send("c", client02("echo", {"a"}));
  h.send("w", reply01(h.taken("w").at(0).at(3), {"1"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"MDPC02", "\x03", "echo", "1"}));
}

TEST(Mdp, CommandFourDependsOnTheVersion) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  h.send("w", {"MDPW02", "\x04", h.job_of("w"), "", "done"});
  EXPECT_THAT(h.taken("c"), SizeIs(1));
  h.send("v", ready01("echo"));
  h.send("v", {"", "MDPW01", "\x04"});
  EXPECT_THAT(h.taken("v"), IsEmpty());
  EXPECT_EQ(h.core.stats().workers, 2u);
}

TEST(Mdp, QueuesForServicesWithoutWorkers) {
  Harness h;
  h.send("c", client01("echo", {"a"}));
  h.pass(5000);
  h.send("w", ready01("echo"));
  EXPECT_THAT(h.taken("w"), SizeIs(1));
}

TEST(Mdp, ForeignRequestsWithoutWorkersExpire) {
  BrokerTimers timers;
  timers.request_expiry = 1000;
  Harness h({}, timers);
  h.send("c", client01("echo", {"a"}));
  h.pass(2000);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
  h.send("w", ready01("echo"));
  EXPECT_THAT(h.taken("w"), IsEmpty());
}

TEST(Mdp, LongestIdleWorkerIsFirst) {
  Harness h;
  for (const char* w : {"w1", "w2", "w3"}) h.send(w, ready02("echo"));
  for (int round = 0; round < 2; ++round)
    for (const char* w : {"w1", "w2", "w3"}) {
      h.send("c", client02("echo", {"a"}));
      const std::string address = h.job_of(w);
      ASSERT_FALSE(address.empty()) << w;
      h.send(w, final02(address, {"b"}));
    }
}

TEST(Mdp, OneRequestPerWorkerAtATime) {
  Harness h;
  h.send("w", ready02("echo"));
  for (int i = 0; i < 3; ++i) h.send("c" + std::to_string(i), client02("echo", {"a"}));
  const std::string address = h.job_of("w");
  ASSERT_FALSE(address.empty());
  h.send("w", heartbeat02);
  EXPECT_THAT(h.taken("w"), IsEmpty());
  h.send("w", final02(address, {"b"}));
  EXPECT_FALSE(h.job_of("w").empty());
}

TEST(Mdp, ClientsTakeTurns) {
  Harness h;
  for (int i = 0; i < 5; ++i) h.send("greedy", client02("echo", {"g"}));
  h.send("modest", client02("echo", {"m"}));
  h.send("w", ready02("echo"));
  std::string order;
  for (int i = 0; i < 6; ++i) {
    const Frames job = h.taken("w").at(0);
    order += job.at(4);
    h.send("w", final02(job.at(2), {"b"}));
  }
  EXPECT_EQ(order, "gmgggg");
}

TEST(Mdp, BrokerBeatsItsHeartAlsoToBusyWorkers) {
  Harness h;
  h.send("idle", ready01("a"));
  h.send("busy", ready02("b"));
  h.send("c", client02("b", {"x"}));
  h.taken("busy");
  for (int i = 0; i < 4; ++i) {
    h.pass(2600);
    for (const char* w : {"idle", "busy"}) EXPECT_THAT(h.taken(w, true), SizeIs(1)) << w << i;
    h.send("idle", heartbeat01);
    h.send("busy", heartbeat02);
  }
}

TEST(Mdp, NoHeartbeatBesideOtherCommands) {
  Harness h;
  h.send("w", ready02("echo"));
  for (int i = 0; i < 10; ++i) {
    h.pass(2000);
    h.send("c", client02("echo", {"a"}));
    const auto all = h.taken("w", true);
    ASSERT_THAT(all, SizeIs(1));
    h.send("w", final02(all[0].at(2), {"b"}));
  }
}

TEST(Mdp, SilentIdleWorkerExpiresButNotBeforeTheGuidesSevenAndAHalfSeconds) {
  Harness h;
  h.send("w", ready01("echo"));
  h.pass(7500);
  EXPECT_EQ(h.core.stats().workers, 1u);
  h.pass(1000);
  EXPECT_EQ(h.core.stats().workers, 0u);
  h.send("c", client01("mmi.service", {"echo"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"", "MDPC01", "mmi.service", "404"}));
  h.send("w", heartbeat01);  // it lives after all, and must register again
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect01));
}

TEST(Mdp, AnyCommandIsAHeartbeat) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  const std::string address = h.job_of("w");
  for (int i = 0; i < 5; ++i) {
    h.pass(6000);
    h.send("w", partial02(address, {"."}));
  }
  EXPECT_EQ(h.core.stats().workers, 1u);
  EXPECT_EQ(h.count_events("worker-suspect"), 0u);
}

struct Unexpected {
  const char* name;
  Frames frames;
  Frames answer;
};
class ValidButUnexpected : public testing::TestWithParam<Unexpected> {};

TEST_P(ValidButUnexpected, IsAnsweredWithOneDisconnect) {
  Harness h;
  h.send("w", GetParam().frames);
  EXPECT_THAT(h.taken("w"), ElementsAre(GetParam().answer));
  h.send("w", GetParam().frames);
  h.send("w", ready02("echo"));
  h.pass(10'000);
  EXPECT_THAT(h.taken("w", true), IsEmpty()) << "nothing may follow a DISCONNECT";
  EXPECT_EQ(h.core.stats().workers, 0u);
}

INSTANTIATE_TEST_SUITE_P(Mdp, ValidButUnexpected,
                         testing::Values(Unexpected{"Heartbeat01", heartbeat01, disconnect01},
                                         Unexpected{"Heartbeat02", heartbeat02, disconnect02},
                                         Unexpected{"Reply01", reply01("address", {"b"}), disconnect01},
                                         Unexpected{"Final02", final02("address", {"b"}), disconnect02},
                                         Unexpected{"Partial02", partial02("address", {"b"}), disconnect02},
                                         Unexpected{"Mmi01", ready01("mmi.service"), disconnect01},
                                         Unexpected{"Mmi02", ready02("mmi.new"), disconnect02}),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(Mdp, SecondReadyIsUnexpected) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("w", ready02("echo"));
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect02));
  EXPECT_EQ(h.core.stats().workers, 0u);
}

TEST(Mdp, SecondReplyIsUnexpectedAndListsTheWorkerNotTwice) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  const std::string address = h.job_of("w");
  h.send("w", final02(address, {"1"}));
  h.send("w", final02(address, {"2"}));
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect02));
  EXPECT_THAT(h.taken("c"), SizeIs(1));
  EXPECT_EQ(h.core.stats().workers, 0u);
}

TEST(Mdp, StrayReplyOfABusyWorkerCostsItNothing) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  h.send("c", client02("echo", {"b"}));
  const std::string first = h.job_of("w");
  h.send("w", final02(first, {"1"}));
  const std::string second = h.job_of("w");
  h.send("w", final02(first, {"again"}));
  h.send("w", final02(second, {"2"}));
  EXPECT_THAT(h.taken("c"),
              ElementsAre(Frames{"MDPC02", "\x03", "echo", "1"}, Frames{"MDPC02", "\x03", "echo", "2"}));
  EXPECT_EQ(h.core.stats().late_replies, 1u);
  EXPECT_EQ(h.core.stats().workers, 1u);
  EXPECT_EQ(h.core.stats().workers_lost, 0u);
}

TEST(Mdp, WorkerCannotAnswerWhatItWasNotAsked) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("w2", ready02("other"));
  h.send("c", client02("echo", {"a"}));
  ASSERT_FALSE(h.job_of("w1").empty());
  h.send("w2", final02("c", {"spoofed"}));
  h.send("w2", final02(Token{1, 2, 1, 0, 1}.frame(), {"spoofed"}));
  EXPECT_THAT(h.taken("c"), IsEmpty());
  EXPECT_EQ(h.core.stats().workers, 1u);
}

TEST(Mdp, DisconnectBeforeReadyIsAllowed) {
  Harness h;
  h.send("w", disconnect02);
  EXPECT_THAT(h.taken("w"), IsEmpty());
  h.send("w", ready02("echo"));
  EXPECT_EQ(h.core.stats().workers, 1u);
}

TEST(Mdp, NothingIsSentToAWorkerThatDisconnected) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("w", disconnect02);
  h.send("c", client02("echo", {"a"}));
  h.pass(20'000);
  EXPECT_THAT(h.taken("w", true), IsEmpty());
}

TEST(Mmi, ServiceStatusFollowsTheWorkers) {
  Harness h;
  const auto status = [&] {
    h.send("c", client01("mmi.service", {"echo"}));
    return h.taken("c").at(0).at(3);
  };
  EXPECT_EQ(status(), "404");
  h.send("w", ready01("echo"));
  EXPECT_EQ(status(), "200");
  h.send("c2", client01("echo", {"x"}));
  EXPECT_EQ(status(), "200") << "a busy worker is registered";
  h.send("w", disconnect01);
  EXPECT_EQ(status(), "404");
  h.send("v", ready01("echo"));
  h.gone("v");
  EXPECT_EQ(status(), "404");
}

TEST(Mmi, UnknownOnesAreNotImplemented) {
  Harness h;
  h.send("c", client01("mmi.nonsense", {"echo"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"", "MDPC01", "mmi.nonsense", "501"}));
  h.send("d", client02("mmi.", {"echo"}));
  EXPECT_THAT(h.taken("d"), ElementsAre(Frames{"MDPC02", "\x03", "mmi.", "501"}));
}

// Every malformed message is dropped and counted, its sender treated as invalid, and nobody else notices.
TEST(Mdp, MalformedMessagesAreDropped) {
  const std::vector<Frames> malformed = {
      {},
      {""},
      {"", ""},
      {"MDPC01", "echo", "x"},
      {"", "MDPC01"},
      {"", "MDPC01", "echo"},
      {"", "MDPC01", "", "x"},
      {"", "MDPC01", "a\nb", "x"},
      {"", "MDPC01", std::string(256, 'a'), "x"},
      {"", "MDPX01", "echo", "x"},
      {"MDPC02"},
      {"MDPC02", "\x01"},
      {"MDPC02", "\x01", "echo"},
      {"MDPC02", "\x02", "echo", "x"},
      {"MDPC02", "\x09", "echo", "x"},
      {"MDPC02", "", "echo", "x"},
      {"MDPC02", "\0"s, "echo", "x"},
      {"", "MDPW01"},
      {"", "MDPW01", ""},
      {"", "MDPW01", "\x01"},
      {"", "MDPW01", "\x01", "echo", "more"},
      {"", "MDPW01", "\x01", ""},
      {"", "MDPW01", "\x02", "c", "", "x"},
      {"", "MDPW01", "\x03"},
      {"", "MDPW01", "\x03", "c"},
      {"", "MDPW01", "\x03", "c", ""},
      {"", "MDPW01", "\x03", "c", "not empty", "x"},
      {"", "MDPW01", "\x05", "more"},
      {"", "MDPW01", "\x06"},
      {"MDPW02", "\x07"},
      {"MDPW02", "\x03", "c", "", ""s + '\0', Frame(1, '\xff')},  // valid shape, no such job: DISCONNECT
      Frames(65, "MDPC02"),
  };
  for (std::size_t i = 0; i < malformed.size(); ++i) {
    Harness h;
    h.send("good", ready02("echo"));
    h.send("bad", malformed[i]);
    EXPECT_EQ(h.taken("bad").size(), i == malformed.size() - 2 ? 1u : 0u) << i;
    h.send("c", client02("echo", {"x"}));
    const std::string address = h.job_of("good");
    ASSERT_FALSE(address.empty()) << i;
    h.send("good", final02(address, {"y"}));
    EXPECT_THAT(h.taken("c"), SizeIs(1)) << i;
    if (i != malformed.size() - 2) {
      EXPECT_EQ(h.core.stats().dropped, 1u) << i;
      h.send("bad", client02("echo", {"x"}));
      EXPECT_THAT(h.taken("good"), IsEmpty()) << "an invalid peer is not served: " << i;
      h.gone("bad");
      h.send("bad", client02("echo", {"x"}));
      EXPECT_THAT(h.taken("good"), SizeIs(1)) << "its next connection is another peer: " << i;
    }
  }
}

TEST(Mdp, MalformedMessageOfABusyWorkerCostsARetry) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  h.send("w2", ready02("echo"));
  h.send("w1", {"MDPW02"});
  h.pass(200);
  h.send("w2", final02(h.job_of("w2"), {"b"}));
  EXPECT_THAT(h.taken("c"), SizeIs(1));
}

TEST(Codec, WhatIsEncodedIsDecoded) {
  for (const Version version : {Version::v01, Version::v02})
    for (const Side side : {Side::client, Side::worker})
      for (const Command command : {Command::ready, Command::request, Command::partial, Command::reply,
                                    Command::heartbeat, Command::disconnect}) {
        majordomo::Message message{version, side, command, "name", {"x", "", "y"}};
        if (command == Command::heartbeat || command == Command::disconnect || command == Command::ready)
          message.body.clear();
        if (command == Command::heartbeat || command == Command::disconnect) message.name.clear();
        for (const Direction direction : {Direction::to_broker, Direction::to_peer}) {
          const Decoded again = decode(encode(message), direction);
          if (!again.message) continue;  // a command of the other side, or unknown to this version
          if (version == Version::v01 && side == Side::client) continue;  // REQUEST and REPLY look the same
          EXPECT_EQ(encode(*again.message), encode(message));
        }
      }
}

TEST(Decode, FramesWithoutAHeaderAreToldAsSuch) {
  EXPECT_STREQ(decode({}, Direction::to_broker).problem, "no frames");
  EXPECT_STREQ(decode({""}, Direction::to_broker).problem, "no header");
  EXPECT_STREQ(decode({"", "MDPX01"}, Direction::to_broker).problem, "unknown header");
}

}  // namespace
}  // namespace ssphh::majordomo::test

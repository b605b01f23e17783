/// PARTIALs of results that are given again, of clients that come later, and of peers whose version has none;
/// beside them the corners of the client's and the worker's side.

#include "broker_harness.h"
#include "client_core.h"
#include "recount.h"
#include "worker_core.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Of each message for one of our clients: kind, place in the sequence (of a final: their number), body.
struct News {
  EnvelopeKind kind;
  std::uint32_t sequence;
  std::string body;
  friend bool operator==(const News&, const News&) = default;
};

std::vector<News> news(Harness& h, const std::string& peer) {
  std::vector<News> all;
  for (const Frames& frames : h.taken(peer)) {
    const auto envelope = decode_envelope(frames.at(3));
    all.push_back({envelope->kind, envelope->sequence, frames.size() > 4 ? frames[4] : ""});
  }
  return all;
}

const News p0{EnvelopeKind::partial, 0, "p0"}, p1{EnvelopeKind::partial, 1, "p1"},
    last{EnvelopeKind::final, 2, "result"};

TEST(Partials, StandOnRecordWithTheirResult) {
  Harness h;
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  const std::string address = h.job_of(own_a);
  h.send(own_a, partial02(address, {"p0"}));
  EXPECT_THAT(news(h, "c"), ElementsAre(p0));
  h.send("d", submit("gen", {.ids = {{1, 1}}}));
  EXPECT_THAT(news(h, "d"), ElementsAre(p0)) << "who comes while it runs";
  h.send(own_a, partial02(address, {"p1"}));
  h.send(own_a, result(address, {}));
  EXPECT_THAT(news(h, "d"), ElementsAre(p1, last));
  h.send("e", submit("gen", {.ids = {{1, 1}}}));
  EXPECT_THAT(news(h, "e"), ElementsAre(p0, p1, last)) << "who comes afterwards";
}

/// A foreign client whose job has sent one PARTIAL when it vanishes.
struct Vanished : testing::Test {
  void begin() {
    h.send("w", ready02("slow"));
    h.send("c", client02("slow", {"a"}));
    address = h.job_of("w");
    h.send("w", partial02(address, {"p0"}));
    EXPECT_THAT(h.taken("c"), ElementsAre(partial("p0")));
    h.gone("c");
  }
  static Frames partial(const std::string& body) { return {"MDPC02", "\x02", "slow", body}; }
  static Frames final_of(const std::string& body) { return {"MDPC02", "\x03", "slow", body}; }
  Harness h;
  std::string address;
};

TEST_F(Vanished, ClientThatAsksAgainWhileItRunsGetsAllPartials) {
  begin();
  h.send("d", client02("slow", {"a"}));
  EXPECT_THAT(h.taken("d"), ElementsAre(partial("p0")));
  h.send("w", partial02(address, {"p1"}));
  h.send("w", final02(address, {"r"}));
  EXPECT_THAT(h.taken("d"), ElementsAre(partial("p1"), final_of("r")));
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST_F(Vanished, ClientThatAsksAgainAfterwardsGetsAllPartials) {
  begin();
  h.send("w", partial02(address, {"p1"}));
  h.send("w", final02(address, {"r"}));
  h.send("d", client02("slow", {"a"}));
  EXPECT_THAT(h.taken("d"), ElementsAre(partial("p0"), partial("p1"), final_of("r")));
  h.send("d", client02("slow", {"a"}));
  EXPECT_THAT(h.taken("d"), IsEmpty()) << "it is given once, and computed anew";
  EXPECT_EQ(h.core.stats().attempts, 2u);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST_F(Vanished, ClientsResultIsOnRecordForOneOfOurs) {
  begin();
  h.send("w", partial02(address, {"p1"}));
  h.send("w", final02(address, {"result"}));
  for (int i = 0; i < 2; ++i) {  // the second time from the record
    h.send("d", submit("slow", {.ids = {{1, 1}}}, "a"));
    const auto all = h.taken("d");
    ASSERT_THAT(all, SizeIs(3));
    EXPECT_EQ(decode_envelope(all[2].at(3))->sequence, 2u);
    EXPECT_EQ(decode_envelope(all[2].at(3))->attempts, 1u);
    EXPECT_EQ(all[0].at(4), "p0");
    EXPECT_EQ(all[1].at(4), "p1");
    EXPECT_EQ(all[2].at(4), "result");
  }
  EXPECT_EQ(h.core.stats().attempts, 1u);
}

// Two stored requests for the same work fail together, are released together and get one result.
TEST(Parked, EqualPersistentRequestsAreReleasedAsOneJob) {
  Harness h({.attempts = 1}, {}, true);
  for (const std::uint64_t i : {1, 2})
    h.send("c", submit("gen", {.ids = {{i, i}}, .content_key = Hash128{7, 7}, .persistent = true}));
  h.send(own_a, ready02("gen"));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .retry = true}));
  EXPECT_EQ(h.core.stats().parked, 1u);
  h.taken("c"), h.store.clear();
  h.send("admin", client02("mmi.release", {"all"}));
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  h.send(own_a, result(h.job_of(own_a), {}));
  std::vector<RequestId> added, finished;
  for (const StoreOperation& operation : h.store) {
    if (operation.kind == StoreOperation::add) added.push_back(operation.request.id);
    if (operation.kind == StoreOperation::finish) finished.push_back(operation.request.id);
  }
  EXPECT_THAT(added, ElementsAre(RequestId{1, 1}, RequestId{2, 2}));
  EXPECT_THAT(finished, ElementsAre(RequestId{1, 1}, RequestId{2, 2}));
  EXPECT_EQ(h.core.stats().attempts, 2u);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST(Dropped, EnvelopesOfTheBrokersSideAreNoClients) {
  Harness h;
  h.send("c", control(EnvelopeKind::accepted, {{1, 1}}));
  ASSERT_FALSE(h.events.empty());
  EXPECT_EQ(h.events.back().text(), "message-dropped peer=c reason=\"envelope of the other side\"");
  EXPECT_EQ(h.core.stats().dropped, 1u);
}

TEST(Dropped, RequestsOfAForeignClientThatTalksNonsense) {
  Harness h;
  h.send("c", client01("echo", {"a"}));
  h.send("own", submit("echo", {.ids = {{1, 1}}}));
  EXPECT_EQ(h.core.stats().outstanding, 2u);
  h.send("c", {"nonsense"});
  h.send("own", {"nonsense"});
  EXPECT_EQ(h.core.stats().outstanding, 1u) << "that of ours has an id by which it may be asked for";
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST(ForeignPeers, PartialIsHeardAndPutsTheEndOfPatienceOff) {
  ClientCore client({.dialect = Dialect::mdp02}, [] { return RequestId{1, 5}; });
  client.submit(1000, "gen", {"body"}, {});
  client.tick(3000);
  client.receive(3000, {"MDPC02", "\x02", "gen", "p"});
  const auto event = client.next_event();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->id, (RequestId{1, 5}));
  EXPECT_FALSE(event->final);
  EXPECT_THAT(event->body, ElementsAre("p"));
  EXPECT_EQ(client.outstanding(), 1u);
  client.tick(5499);
  EXPECT_FALSE(client.take_reconnect());
  client.tick(5500);
  EXPECT_TRUE(client.take_reconnect()) << "2.5 s after the PARTIAL";
}

class OldWorker : public testing::Test {
 protected:
  std::vector<Frames> sent() {
    std::vector<Frames> all;
    for (ToBroker& message : worker.take()) {
      if (message.body) message.head.insert(message.head.end(), message.body->begin(), message.body->end());
      all.push_back(std::move(message.head));
    }
    return all;
  }
  void begin_job() {
    worker.receive(1000, {"", "MDPW01", "\x02", "client", "", "body"});
    ASSERT_TRUE(worker.take_job());
  }
  OldWorker() {
    worker.connected(1000);
    EXPECT_THAT(sent(), ElementsAre(ready01("gen")));
  }
  WorkerCore worker{WorkerOptions{.endpoint = "ipc://x", .service = "gen", .dialect = Dialect::mdp01}};
};

TEST_F(OldWorker, SendsItsPartialsWithTheReply) {
  for (int job = 0; job < 2; ++job) {
    begin_job();
    worker.partial(1000, {"a", "b"});
    worker.partial(1000, {});
    EXPECT_THAT(sent(), IsEmpty());
    worker.done(1000, {.body = {"c"}});
    EXPECT_THAT(sent(), ElementsAre(reply01("client", {"a", "b", "", "c"}))) << "each job its own";
  }
}

TEST_F(OldWorker, LeavesForAMomentWhenItFails) {
  begin_job();
  worker.partial(1000, {"a"});
  worker.done(1000, {.outcome = Outcome::failed, .reason = "no word for it"});
  EXPECT_THAT(sent(), ElementsAre(disconnect01));
  EXPECT_TRUE(worker.wants_close());
  EXPECT_EQ(worker.connect_at(), 1250);
  worker.connected(1250);
  EXPECT_THAT(sent(), ElementsAre(ready01("gen"))) << "what it had is forgotten";
}

}  // namespace
}  // namespace ssphh::majordomo::test

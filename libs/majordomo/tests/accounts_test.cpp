/// What a broker counts of bytes and requests: given back whenever a request ends, whatever it was at.

#include "broker_harness.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t record_overhead = 300;

/// Three requests of one client, each of its own size, and what their bodies weigh in the books.
class Accounts : public testing::Test {
 protected:
  static constexpr std::size_t sizes[] = {101, 210, 430};
  static RequestId id(std::uint64_t i) { return {i, 70 + i}; }

  void submit_all(bool persistent) {
    for (std::uint64_t i = 0; i < 3; ++i)
      h.send("c",
             submit("gen", {.ids = {id(i)}, .persistent = persistent}, std::string(sizes[i], char('a' + i))));
    h.taken("c");
    h.store.clear();
  }
  void cancel(std::uint64_t i) { h.send("c", control(EnvelopeKind::cancel, {id(i)})); }
  std::size_t stored() const { return BrokerRecount::books(h.core).stored; }
  /// Bytes of the jobs, bytes of the store.
  void expect(std::size_t jobs, std::size_t in_store) const {
    EXPECT_EQ(h.core.stats().bytes, jobs);
    EXPECT_EQ(stored(), in_store);
    EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  }
  /// The client was told once that its request `i` was cancelled, and the store forgets it.
  void expect_cancelled(std::uint64_t i, bool persistent) {
    const auto news = h.envelopes("c");
    ASSERT_THAT(news, SizeIs(1));
    EXPECT_EQ(news[0].kind, EnvelopeKind::final);
    EXPECT_EQ(news[0].outcome, Outcome::cancelled);
    EXPECT_THAT(news[0].ids, ElementsAre(id(i)));
    EXPECT_EQ(h.core.stats().cancelled, 1u);
    ASSERT_EQ(h.store.size(), persistent ? 1u : 0u);
    if (!persistent) return;
    EXPECT_EQ(h.store[0].kind, StoreOperation::forget);
    EXPECT_EQ(h.store[0].request.id, id(i));
  }
  /// Lets one worker after the other die of the job that waits.
  void kill_workers(int count) {
    for (int i = 0; i < count; ++i) {
      const std::string worker = "mortal" + std::to_string(i);
      h.send(worker, ready02("gen"));
      h.pass(500);
      ASSERT_FALSE(h.job_of(worker).empty()) << worker;
      h.gone(worker);
    }
  }

  Harness h{{}, {}, true};
};

TEST_F(Accounts, FallByWhatIsCancelledWhileItWaits) {
  submit_all(true);
  expect(741, 741);
  cancel(1);
  expect_cancelled(1, true);
  expect(531, 531);
  EXPECT_EQ(h.core.stats().queued, 2u);
}

TEST_F(Accounts, OfRequestsThatAreNotPersistentLeaveTheStoreAlone) {
  submit_all(false);
  expect(741, 0);
  cancel(2);
  expect_cancelled(2, false);
  expect(311, 0);
}

TEST_F(Accounts, FallByWhatIsCancelledWhileItRuns) {
  submit_all(true);
  h.send(own_a, ready02("gen"));
  const std::string address = h.job_of(own_a);
  cancel(0);
  expect_cancelled(0, true);
  expect(640, 640);
  EXPECT_EQ(h.core.stats().running, 0u);
  h.send(own_a, result(address, {}, "nobody wants it"));
  EXPECT_EQ(h.core.stats().running, 1u) << "the worker has the next job";
  EXPECT_EQ(h.core.stats().late_replies, 1u);
  EXPECT_EQ(h.core.stats().finished, 0u);
  expect(640, 640);
}

TEST_F(Accounts, FallByWhatIsCancelledBeforeItsNextAttempt) {
  h.send("c", submit("gen", {.ids = {id(0)}, .persistent = true}, std::string(101, 'a')));
  h.send("w", ready02("gen"));
  h.gone("w");
  h.taken("c");
  h.store.clear();
  EXPECT_EQ(h.core.stats().queued + h.core.stats().running, 0u) << "it backs off";
  cancel(0);
  expect_cancelled(0, true);
  expect(0, 0);
  h.send("v", ready02("gen"));
  h.pass(1000);
  EXPECT_TRUE(h.job_of("v").empty());
}

TEST_F(Accounts, FallByWhatIsCancelledAfterBeingHandedBack) {
  submit_all(true);
  h.send("w", ready02("gen"));
  h.send("w", disconnect02);
  EXPECT_EQ(h.core.stats().queued, 3u);
  cancel(0);
  expect_cancelled(0, true);
  expect(640, 640);
  EXPECT_EQ(h.core.stats().queued, 2u);
}

TEST_F(Accounts, FallByTheResultThatIsCancelledAndNothingIsCountedTwice) {
  submit_all(true);
  h.send(own_a, ready02("gen"));
  h.send(own_a, partial02(h.job_of(own_a), {"12345"}));
  h.send(own_a, disconnect02);
  h.send(own_b, ready02("gen"));
  const std::string address = h.job_of(own_b);
  h.send(own_b, partial02(address, {"12345"}));
  h.send(own_b, result(address, {}, "1234567"));
  h.taken("c");
  h.store.clear();
  expect(640, 640 + record_overhead + 12);
  for (int twice = 0; twice < 2; ++twice) {
    cancel(0);
    EXPECT_THAT(h.taken("c"), IsEmpty()) << "its client has the result, and no second outcome";
    expect(640, 640);
    ASSERT_THAT(h.store, SizeIs(1)) << "forgotten once";
    EXPECT_EQ(h.store[0].kind, StoreOperation::forget);
    EXPECT_EQ(h.store[0].request.id, id(0));
  }
  EXPECT_EQ(h.core.stats().cancelled, 0u);
  EXPECT_EQ(h.core.stats().finished, 1u);
  EXPECT_EQ(h.core.stats().records, 0u);
}

TEST_F(Accounts, OfARecordFallWhenItIsCancelled) {
  submit_all(false);
  h.send(own_a, ready02("gen"));
  h.send(own_a, result(h.job_of(own_a), {}, "1234567"));
  h.taken("c");
  EXPECT_EQ(BrokerRecount::books(h.core), (BrokerBooks{.records = record_overhead + 7}));
  cancel(0);
  EXPECT_EQ(BrokerRecount::books(h.core), BrokerBooks{});
  EXPECT_THAT(h.taken("c"), IsEmpty());
  EXPECT_EQ(h.core.stats().cancelled, 0u);
  EXPECT_THAT(h.store, IsEmpty());
  expect(640, 0);
}

TEST_F(Accounts, FallByTheReplyOfAParkedRequestThatIsCancelledAndItsBodyStaysParked) {
  h.send("c", submit("gen", {.ids = {id(1)}, .persistent = true}, std::string(210, 'b')));
  kill_workers(3);
  EXPECT_EQ(h.core.stats().parked, 1u);
  EXPECT_EQ(BrokerRecount::books(h.core), (BrokerBooks{.stored = record_overhead, .parked = 210}));
  h.taken("c");
  cancel(1);
  EXPECT_EQ(BrokerRecount::books(h.core), (BrokerBooks{.parked = 210}));
  EXPECT_THAT(h.taken("c"), IsEmpty()) << "it was told already";
  EXPECT_EQ(h.core.stats().cancelled, 0u);
  expect(0, 0);
  h.send("admin", client02("mmi.drop", {"all"}));
  EXPECT_EQ(BrokerRecount::books(h.core), BrokerBooks{});
}

TEST_F(Accounts, FallByTheReplyOfAParkedRequestThatIsDropped) {
  h.send("c", submit("gen", {.ids = {id(1)}, .persistent = true}, std::string(210, 'b')));
  kill_workers(3);
  h.store.clear();
  h.send("admin", client02("mmi.drop", {"all"}));
  EXPECT_EQ(BrokerRecount::books(h.core), BrokerBooks{});
  ASSERT_THAT(h.store, SizeIs(1));
  EXPECT_EQ(h.store[0].kind, StoreOperation::forget);
}

TEST_F(Accounts, OfAReleasedJobAreThoseOfItsRequest) {
  h.send("c", submit("gen", {.ids = {id(1)}, .persistent = true}, std::string(210, 'b')));
  kill_workers(3);
  h.send("admin", client02("mmi.release", {"all"}));
  expect(210, 210);
  EXPECT_EQ(BrokerRecount::books(h.core).parked, 0u);
  h.taken("c");
  h.store.clear();
  cancel(1);
  expect_cancelled(1, true);
  expect(0, 0);
}

TEST_F(Accounts, OfEqualRequestsAreOnceTheJobsAndForEachTheStores) {
  const auto equal = [&](std::uint64_t i) {
    h.send("c",
           submit("gen", {.ids = {id(i)}, .content_key = Hash128{5, 6}, .persistent = true}, "0123456789"));
  };
  equal(1);
  equal(2);
  expect(10, 20);
  cancel(1);
  expect(10, 10);
  cancel(2);
  expect(0, 0);
  EXPECT_EQ(h.core.stats().cancelled, 2u);
}

TEST_F(Accounts, FallByWhatExpires) {
  h.send("c", submit("gen", {.ids = {id(0)}, .deadline = 300, .persistent = true}, std::string(101, 'a')));
  h.pass(299);
  expect(101, 101);
  h.pass(1);
  expect(0, 0);
  EXPECT_EQ(h.core.stats().expired, 1u);
  EXPECT_EQ(h.core.stats().cancelled, 0u);
  EXPECT_EQ(h.store.back().kind, StoreOperation::forget);
}

TEST_F(Accounts, FallByWhatTitanicCloses) {
  h.send("t", client01("titanic.request", {"gen", "0123456789", "ab"}));
  const std::string uuid = h.taken("t").at(0).at(4);
  expect(12, 12);
  for (int twice = 0; twice < 2; ++twice) {
    h.send("t", client01("titanic.close", {uuid}));
    expect(0, 0);
    EXPECT_EQ(h.core.stats().cancelled, 1u) << "once";
  }
}

TEST_F(Accounts, AreAsIfNothingHadBeenWhenAnUnknownRequestIsCancelled) {
  submit_all(true);
  cancel(7);
  expect(741, 741);
  EXPECT_THAT(h.taken("c"), IsEmpty());
  EXPECT_THAT(h.store, IsEmpty());
  EXPECT_EQ(h.core.stats().cancelled, 0u);
}

TEST_F(Accounts, OfWhatTheStoreHeldAreThereAfterARestart) {
  const auto body = std::make_shared<const Frames>(Frames{"01234", "56"});
  const auto reply = std::make_shared<const Frames>(Frames{"01234567890"});
  h.core.restore(h.now, {.id = id(1), .service = "gen", .body = body});
  h.core.restore(
      h.now, {.id = id(2), .service = "gen", .body = body, .finished = true, .attempts = 2, .reply = reply});
  expect(7, 7 + record_overhead + 11);
  cancel(1);
  expect(0, record_overhead + 11);
  cancel(2);
  expect(0, 0);
}

TEST_F(Accounts, OfAVanishedClientAreGivenBackAfterItsGraceButNotThePersistentOnes) {
  submit_all(false);
  h.send("c", submit("gen", {.ids = {id(8)}, .persistent = true}, "0123456789"));
  h.gone("c");
  expect(751, 10);
  h.pass(10'000);
  expect(10, 10);
}

}  // namespace
}  // namespace ssphh::majordomo::test

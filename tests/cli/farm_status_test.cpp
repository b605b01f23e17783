// What `ssphh farm` makes of a broker's numbers, each another one, told by a broker that says what it is
// given.

#include <atomic>
#include <chrono>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <zmq.hpp>

#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>

#include "commands/farm.h"
#include "here.h"

namespace ssphh {
namespace {

using majordomo::Frames;
using test::json_here;
using test::text_here;

using Answers = std::map<std::string, std::vector<std::string>>;

/// Answers every question for a service with the next of its answers, then with the last one.
class ToldBroker {
 public:
  explicit ToldBroker(Answers answers)
      : answers_(std::move(answers)), router_(context_, zmq::socket_type::router) {
    router_.set(zmq::sockopt::linger, 0);
    router_.set(zmq::sockopt::rcvtimeo, 5);
    router_.bind("tcp://127.0.0.1:*");
    endpoint_ = router_.get(zmq::sockopt::last_endpoint);
    thread_ = std::thread([this] { serve(); });
  }
  ~ToldBroker() {
    ended_ = true;
    thread_.join();
  }
  const std::string& endpoint() const { return endpoint_; }

 private:
  void serve() {
    while (!ended_) {
      zmq::message_t part;
      if (!router_.recv(part)) continue;
      Frames frames = {part.to_string()};
      while (part.more()) {
        (void)router_.recv(part);
        frames.push_back(part.to_string());
      }
      const auto envelope = frames.size() > 4 ? majordomo::decode_envelope(frames[4]) : std::nullopt;
      if (!envelope || envelope->kind != majordomo::EnvelopeKind::submit) continue;
      Frames reply = majordomo::encode_head(majordomo::Version::v02, majordomo::Side::client,
                                            majordomo::Command::reply, frames[3]);
      reply.insert(reply.begin(), frames[0]);
      reply.push_back(
          majordomo::encode_envelope({.kind = majordomo::EnvelopeKind::final, .ids = envelope->ids}));
      std::vector<std::string>& answers = answers_.at(frames[3]);
      reply.insert(reply.end(), {"200", answers.front()});
      if (answers.size() > 1) answers.erase(answers.begin());
      for (std::size_t i = 0; i < reply.size(); ++i)
        router_.send(zmq::buffer(reply[i]),
                     i + 1 < reply.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
  }

  Answers answers_;
  zmq::context_t context_;
  zmq::socket_t router_;
  std::string endpoint_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

std::string stats(int finished) {
  return fmt::format(R"({{"now": {{"workers": 3, "idle": 2, "queued": 25, "running": 15}},
    "total": {{"finished": 70, "retries": 8, "parked": 9}},
    "services": [{{"name": "gen", "workers": 10, "idle": 11, "queued": 12, "finished": {}}},
                 {{"name": "viz", "workers": 14, "idle": 16, "queued": 17, "finished": 18}}]}})",
                     finished);
}
const std::string workers = R"({"workers": [
  {"name": "a", "state": "busy", "since_ms": 12345, "served": 21, "service": "gen"},
  {"name": "b", "state": "idle", "since_ms": 987654, "served": 22, "service": "viz"}]})";

const std::string head = "3 workers (2 idle), 25 jobs queued, 15 running, 70 finished, 8 retries, 9 parked";
const std::string table =
    "service                                          workers   idle  queued  finished\n"
    "gen                                                   10     11      12        13\n"
    "viz                                                   14     16      17        18\n"
    "worker                         state          for  served  service\n"
    "a                              busy        12.3 s      21  gen\n"
    "b                              idle       987.7 s      22  viz";

TEST(FarmStatus, ShowsEveryNumberInItsPlace) {
  const ToldBroker broker(Answers{{"mmi.stats", {stats(13)}}, {"mmi.workers", {workers}}});
  const std::vector<std::string> command = {"farm", "status", "--broker", broker.endpoint()};
  EXPECT_EQ(text_here(command), head + "\n" + table);
  const json::Value told = json_here(command);
  EXPECT_EQ(told["stats"], json::parse(stats(13), "stats"));
  EXPECT_EQ(told["workers"].size(), 2u);
}

TEST(FarmStatus, AnAnswerThatLacksItsPartsIsRefusedWithItsPlace) {
  const ToldBroker broker(
      Answers{{"mmi.stats", {R"({"now": {}, "total": {}})"}}, {"mmi.workers", {workers}}});
  EXPECT_EQ(test::problem_here({"farm", "status", "--broker", broker.endpoint()}),
            "mmi.stats: \"services\" is missing");
}

// 400 jobs between two looks that are a tenth of a second apart, and 40 left.
TEST(FarmTop, TellsRateAndTimeLeftFromTheSecondLookOn) {
  const ToldBroker broker(Answers{{"mmi.stats", {stats(13), stats(413)}}, {"mmi.workers", {workers}}});
  const std::vector<std::string> command = {"farm",    "top", "--broker",   broker.endpoint(),
                                            "--count", "2",   "--interval", "0.1"};
  const auto begin = std::chrono::steady_clock::now();
  const std::string text = text_here(command);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(seconds, 0.1) << "it waits between its looks";
  const std::string clear = "\x1b[H\x1b[2J";
  ASSERT_TRUE(text.starts_with(clear + head + "\n" + table + "\n" + clear + head + "\n")) << text;
  const std::string rate = text.substr(text.rfind(head) + head.size() + 1);
  const double per_second = std::stod(rate);
  EXPECT_LE(per_second, 400 / 0.1);
  EXPECT_GE(per_second, 400 / seconds);
  EXPECT_TRUE(rate.starts_with(
      fmt::format("{:.2f} jobs/s, about {:.0f} s left\nservice", per_second, 40 / per_second)))
      << rate;
}

TEST(FarmTop, RatesAreNotNegativeAndNothingIsLeftOfNoWork) {
  const ToldBroker broker(Answers{{"mmi.stats", {stats(413), stats(13)}}, {"mmi.workers", {workers}}});
  const std::string text =
      text_here({"farm", "top", "--broker", broker.endpoint(), "--count", "2", "--interval", "0.1"});
  EXPECT_NE(text.find(head + "\n0.00 jobs/s\nservice"), std::string::npos)
      << "the broker began anew: " << text;
}

TEST(FarmTop, CtrlCEndsWhatHasNoOtherEnd) {
  const ToldBroker broker(Answers{{"mmi.stats", {stats(13)}}, {"mmi.workers", {workers}}});
  for (const int count : {0, 9}) {
    CancelToken cancel;
    int looks = 0;
    const auto stop_at_two = [&](const app::FarmStatus&) {
      if (++looks == 2) cancel.request();
    };
    const auto top = [&] {
      app::run_farm_top({{broker.endpoint(), "", ""}, 0.05, count}, stop_at_two, {nullptr, &cancel});
    };
    if (count == 0) {
      EXPECT_NO_THROW(top());
    } else {
      EXPECT_THROW(top(), Cancelled);
    }
    EXPECT_EQ(looks, 2);
  }
}

TEST(FarmParked, ShowsSizesAndAges) {
  const std::string jobs = R"({"jobs": [
    {"job": 7, "service": "gen", "bytes": 12345, "since_ms": 98765, "failures": ["a: no memory", "b: gone"]},
    {"job": 8, "service": "viz", "bytes": 50, "since_ms": 1400, "failures": []}]})";
  const ToldBroker broker(Answers{{"mmi.parked", {jobs}}});
  EXPECT_EQ(text_here({"farm", "parked", "--broker", broker.endpoint()}),
            "job 7 of gen, 12.3 KB, set aside 99 s ago\n  a: no memory\n  b: gone\n"
            "job 8 of viz, 0.1 KB, set aside 1 s ago");
}

}  // namespace
}  // namespace ssphh

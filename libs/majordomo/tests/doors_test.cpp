/// The broker's side doors: metrics over HTTP, who is let in, and events as text.

#include <fstream>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ssphh/core/log.h>

#include "gate.h"
#include "metrics_server.h"
#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::TempDir;

/// A connection of plain TCP.
class Connection {
 public:
  explicit Connection(const std::string& endpoint) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(endpoint.substr(endpoint.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    timeval wait{0, 2000};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  }
  ~Connection() { ::close(fd_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  void send(const std::string& text) const {
    EXPECT_EQ(::send(fd_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  /// What has come; `ended` is set when the other side has closed.
  std::string receive(bool& ended) const {
    char buffer[4096];
    const ssize_t size = ::recv(fd_, buffer, sizeof buffer, 0);
    ended = size == 0;
    return size > 0 ? std::string(buffer, static_cast<std::size_t>(size)) : std::string();
  }

 private:
  int fd_;
};

struct MetricsDoor : testing::Test {
  /// The answer to what is sent, piece by piece; "" when none comes.
  std::string answer(const std::vector<std::string>& pieces, int tries = 2000) {
    const Connection connection(server.endpoint());
    std::string text;
    bool ended = false;
    const auto serve = [&] {
      server.serve([] { return std::string("a 1\n"); });
      text += connection.receive(ended);
    };
    for (const std::string& piece : pieces) {
      connection.send(piece);
      for (int i = 0; i < 5; ++i) serve();
    }
    for (int i = 0; i < tries && !ended; ++i) serve();
    return text;
  }
  zmq::context_t context;
  MetricsServer server{context, "tcp://127.0.0.1:*"};
};

std::string http(const std::string& status, const std::string& body) {
  return "HTTP/1.1 " + status +
         "\r\nContent-Type: text/plain; version=0.0.4\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\nConnection: close\r\n\r\n" + body;
}

TEST_F(MetricsDoor, AreAnsweredToGetAloneAndTheConnectionCloses) {
  EXPECT_EQ(answer({"GET /metrics HTTP/1.1\r\n\r\n"}), http("200 OK", "a 1\n"));
  EXPECT_EQ(answer({"GET /metr", "ics HTTP/1.1\r\nHost: x\r\n", "\r\n"}), http("200 OK", "a 1\n"));
  EXPECT_EQ(answer({"GET /metricsX HTTP/1.1\r\n\r\n"}), http("404 Not Found", ""));
  EXPECT_EQ(answer({"POST /metrics HTTP/1.1\r\n\r\n"}), http("404 Not Found", ""));
}

TEST_F(MetricsDoor, RequestsHaveLessThanEightKibibytes) {
  EXPECT_EQ(answer({"GET /metrics HTTP/1.1\r\nX: " + std::string(8191 - 26, 'x')}, 20), "")
      << "may have an end yet";
  EXPECT_EQ(answer({"GET /metrics HTTP/1.1\r\nX: " + std::string(8192 - 26, 'x')}),
            http("400 Bad Request", ""));
}

TEST(Gates, LetInTheKeysOfTheirListAndNameThem) {
  const KeyPair known = make_key_pair(), other = make_key_pair();
  std::vector<std::string> warnings;
  const LogSink before = set_log_sink([&](LogLevel, const std::string& text) { warnings.push_back(text); });
  {
    zmq::context_t context;
    BrokerSecurity security;
    security.allowed = {{known.public_key, {.name = "ann", .admin = false}}};
    const Gate gate(context, security);
    EXPECT_FALSE(gate.follows_a_file());
    EXPECT_FALSE(gate.file_changed());
    ASSERT_NE(gate.rights(known.public_key), nullptr);
    EXPECT_EQ(gate.rights(known.public_key)->name, "ann");
    EXPECT_EQ(gate.rights(other.public_key), nullptr);
    zmq::socket_t asking(context, zmq::socket_type::req);
    asking.connect("inproc://zeromq.zap.01");
    const auto ask = [&](const Frames& request) {
      send_message(asking, nullptr, request, nullptr);
      zmq::pollitem_t item{asking.handle(), 0, ZMQ_POLLIN, 0};
      zmq::poll(&item, 1, std::chrono::milliseconds(10'000));
      const auto reply = receive_message(asking);
      return reply ? reply->frames : Frames();
    };
    const auto raw = [](const std::string& key) {
      std::string bytes(32, '\0');
      zmq_z85_decode(reinterpret_cast<std::uint8_t*>(bytes.data()), key.c_str());
      return bytes;
    };
    const std::string in = raw(known.public_key), out = raw(other.public_key);
    const Frames refused = {"1.0", "7", "400", "unknown key", "", ""};
    EXPECT_EQ(ask({"1.0", "7", "d", "1.2.3.4", "id", "CURVE", in}),
              (Frames{"1.0", "7", "200", "OK", known.public_key, ""}));
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(ask({"1.0", "7", "d", "1.2.3.4", "id", "CURVE", out}), refused);
    EXPECT_EQ(ask({"1.0", "7", "d", "1.2.3.4", "id", "PLAIN", in}), refused);
    EXPECT_EQ(ask({"2.0", "7", "d", "1.2.3.4", "id", "CURVE", in}), refused);
    EXPECT_EQ(ask({"1.0", "7", "d", "1.2.3.4", "id", "CURVE", in, "more"}), refused);
    EXPECT_EQ(ask({"1.0"}), (Frames{"1.0", "", "400", "unknown key", "", ""}));
  }
  set_log_sink(before);
  ASSERT_EQ(warnings.size(), 5u);
  EXPECT_EQ(warnings[0], "connection-refused address=1.2.3.4 reason=\"key is not in the allow-list\"");
  EXPECT_EQ(warnings[4], "connection-refused address= reason=\"key is not in the allow-list\"");
}

TEST(Gates, FollowTheirFile) {
  const TempDir dir;
  const KeyPair a = make_key_pair(), b = make_key_pair();
  const auto write = [&](const std::string& text) { std::ofstream(dir / "allow.txt") << text; };
  write("ann " + a.public_key + " client\n");
  zmq::context_t context;
  BrokerSecurity security;
  security.allow_file = dir / "allow.txt";
  security.allowed = read_allow_list(security.allow_file);
  Gate gate(context, security);
  EXPECT_TRUE(gate.follows_a_file());
  EXPECT_FALSE(gate.file_changed());
  write("ann " + a.public_key + " client\nbob " + b.public_key + " admin\n");
  EXPECT_TRUE(gate.file_changed());
  EXPECT_EQ(gate.rights(b.public_key), nullptr);
  EXPECT_EQ(gate.reload().text(), "allow-list-read keys=2");
  EXPECT_FALSE(gate.file_changed());
  ASSERT_NE(gate.rights(b.public_key), nullptr);
  EXPECT_TRUE(gate.rights(b.public_key)->admin);
  write("nonsense\n");
  EXPECT_TRUE(gate.file_changed());
  const BrokerEvent refused = gate.reload();
  EXPECT_EQ(refused.level, LogLevel::error);
  EXPECT_TRUE(refused.text().starts_with("allow-list-refused reason=\"" + (dir / "allow.txt").string() +
                                         ":1: is not"))
      << refused.text();
  EXPECT_NE(gate.rights(a.public_key), nullptr);
  EXPECT_FALSE(gate.file_changed());
}

TEST(Events, AreALineOrAnObject) {
  const BrokerEvent event{LogLevel::warning,
                          "job-retry",
                          {{"job", "12"},
                           {"why", "peer gone"},
                           {"odd", "a=b"},
                           {"none", ""},
                           {"q", "\"\\"},
                           {"end", "~!"},
                           {"high", "\x7f"}}};
  EXPECT_EQ(event.text(),
            R"(job-retry job=12 why="peer gone" odd="a=b" none="" q="\"\\" end=~! high="\u007f")");
  EXPECT_EQ(event.json(),
            R"({"event":"job-retry","level":"warning","job":"12","why":"peer gone","odd":"a=b",)"
            R"("none":"","q":"\"\\","end":"~!","high":"\u007f"})");
  const char* const names[] = {"debug", "info", "warning", "error"};
  const LogLevel levels[] = {LogLevel::debug, LogLevel::info, LogLevel::warning, LogLevel::error};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ((BrokerEvent{levels[i], "x", {}}.json()),
              std::string(R"({"event":"x","level":")") + names[i] + "\"}");
  }
}

}  // namespace
}  // namespace ssphh::majordomo::test

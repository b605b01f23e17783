/// Keys, allow-lists and which endpoints may be plain.

#include <fstream>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>

#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using std::string_literals::operator""s;

TEST(Curve, KnownKeysComeInOthersDoNot) {
  TempDir dir;
  for (const char* name : {"broker", "alice", "worker", "mallory"})
    write_key_pair(dir.path(), name, make_key_pair());
  add_to_allow_list(dir / "allow.txt", "alice", read_public_key(dir / "alice.pub"), {"client"});
  add_to_allow_list(dir / "allow.txt", "worker", read_public_key(dir / "worker.pub"), {"worker:echo"});
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  RunningBroker broker({.security = read_broker_security(dir.path())});
  RunningWorker worker({.endpoint = broker.endpoint(),
                        .service = "echo",
                        .security = read_peer_security(dir.path(), "worker")},
                       echo);
  Client alice({.endpoint = broker.endpoint(), .security = read_peer_security(dir.path(), "alice")});
  EXPECT_THAT(alice.call("echo", {"x"}), ElementsAre("x"));
  EXPECT_THAT(alice.call("mmi.drain", {""}), ElementsAre("403"));

  PeerSecurity wrong_broker = read_peer_security(dir.path(), "alice");
  wrong_broker.broker_key = make_key_pair().public_key;
  Client mallory({.endpoint = broker.endpoint(), .security = read_peer_security(dir.path(), "mallory")});
  Client plain({.endpoint = broker.endpoint()});
  Client elsewhere({.endpoint = broker.endpoint(), .security = wrong_broker});
  Client not_a_client({.endpoint = broker.endpoint(), .security = read_peer_security(dir.path(), "worker")});
  for (Client* client : {&mallory, &plain, &elsewhere, &not_a_client}) client->submit("echo", {"x"});
  EXPECT_FALSE(mallory.poll(500) || mallory.connected());  // the others have as long
  EXPECT_FALSE(plain.poll(50) || plain.connected());
  EXPECT_FALSE(elsewhere.poll(50) || elsewhere.connected());
  EXPECT_FALSE(not_a_client.poll(50));
  set_log_sink(before);
}

/// Writes the list as an administrator's editor would, and waits until the broker has seen it.
class FollowedList {
 public:
  FollowedList() {
    for (const char* name : {"broker", "alice", "worker", "bob"})
      write_key_pair(dir_.path(), name, make_key_pair());
  }
  PeerSecurity of(const std::string& name) const { return read_peer_security(dir_.path(), name); }
  BrokerSecurity broker() const { return read_broker_security(dir_.path()); }
  void write(const std::vector<std::pair<std::string, std::string>>& names_and_roles) const {
    std::string text;
    for (const auto& [name, roles] : names_and_roles)
      text += name + " " + read_public_key(dir_ / (name + ".pub")) + " " + roles + "\n";
    write_text(text);
  }
  void write_text(const std::string& text) const { std::ofstream(dir_ / "allow.txt") << text; }

 private:
  TempDir dir_;
};

/// Whether a request of this client is answered within `timeout`.
bool answered(Client& client, Millis timeout) {
  client.submit("echo", {"x"}, {.deadline = timeout});
  const auto event = client.poll(timeout);
  return event && event->outcome == Outcome::ok;
}

TEST(Curve, AKeyThatIsTakenOffTheListIsRefusedFromThenOn) {
  const FollowedList list;
  list.write({{"alice", "client"}, {"bob", "client"}, {"worker", "worker:echo"}});
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  RunningBroker broker({.security = list.broker()});
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "echo", .security = list.of("worker")},
                       echo);
  Client alice({.endpoint = broker.endpoint(), .security = list.of("alice")});
  Client bob({.endpoint = broker.endpoint(), .security = list.of("bob")});
  ASSERT_TRUE(answered(alice, 5000));
  ASSERT_TRUE(answered(bob, 5000));
  list.write({{"bob", "client"}, {"worker", "worker:echo"}});
  (*broker).reload();
  EXPECT_TRUE(answered(bob, 5000));
  Client again({.endpoint = broker.endpoint(), .security = list.of("alice")});
  again.submit("echo", {"x"}, {.deadline = 500});
  EXPECT_FALSE(answered(alice, 400)) << "on the connection that was open";
  EXPECT_FALSE(again.connected()) << "on a new one";

  list.write_text("nonsense\n");
  (*broker).reload();
  EXPECT_TRUE(answered(bob, 5000)) << "a list that cannot be read changes nothing";

  list.write({{"bob", "client"}, {"alice", "client"}});
  (*broker).reload();
  EXPECT_FALSE(answered(bob, 300)) << "the worker's key is gone";
  set_log_sink(before);
}

// No SIGHUP: the file alone.
TEST(Curve, AChangedListIsReadByItself) {
  const FollowedList list;
  list.write({{"alice", "client"}});
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  RunningBroker broker({.security = list.broker()});
  Client bob({.endpoint = broker.endpoint(), .security = list.of("bob")});
  EXPECT_FALSE(bob.poll(0));
  list.write({{"alice", "client"}, {"bob", "client"}, {"worker", "worker"}});
  RunningWorker worker({.endpoint = broker.endpoint(),
                        .service = "echo",
                        .security = list.of("worker"),
                        .broker_expiry = 800},  // refused until then, it tries again
                       echo);
  EXPECT_TRUE(answered(bob, 10'000));
  set_log_sink(before);
}

TEST(Security, PlainOnlyOnThisMachine) {
  for (const char* local : {"tcp://127.0.0.1:5555", "tcp://127.1.2.3:*", "tcp://localhost:1", "tcp://[::1]:1",
                            "ipc:///tmp/x", "inproc://x"})
    EXPECT_TRUE(is_local_endpoint(local)) << local;
  for (const char* remote : {"tcp://*:5555", "tcp://0.0.0.0:5555", "tcp://10.0.0.1:1", "tcp://eth0:1",
                             "tcp://127.evil.org:1", "tcp://[::]:1", "tcp://localhost.evil.org:1", "pgm://x"})
    EXPECT_FALSE(is_local_endpoint(remote)) << remote;
  EXPECT_THROW(Broker({.bind = "tcp://0.0.0.0:0"}), Error);
  EXPECT_THROW(Client({.endpoint = "tcp://10.0.0.1:5555"}), Error);
  EXPECT_THROW(Worker({.endpoint = "tcp://10.0.0.1:5555", .service = "x"}), Error);
  EXPECT_THROW(Client({.endpoint = "nonsense"}), Error);
}

TEST(Security, KeyFilesAndAllowLists) {
  TempDir dir;
  const KeyPair keys = make_key_pair();
  write_key_pair(dir.path(), "a", keys);
  EXPECT_EQ(std::filesystem::status(dir / "a.key").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(read_key_pair(dir / "a.key").secret_key, keys.secret_key);
  EXPECT_EQ(read_public_key(dir / "a.pub"), keys.public_key);
  EXPECT_THROW(write_key_pair(dir.path(), "a", keys), Error);
  EXPECT_THROW(write_key_pair(dir.path(), "../a", keys), Error);
  std::filesystem::permissions(dir / "a.key", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW(read_key_pair(dir / "a.key"), Error);
  const auto list = [&](const std::string& text) {
    std::ofstream(dir / "allow.txt") << text;
    return read_allow_list(dir / "allow.txt");
  };
  const AllowList good =
      list("# comment\n\nann " + keys.public_key + " client worker:gen worker:viz.* # hers\n");
  ASSERT_EQ(good.size(), 1u);
  EXPECT_TRUE(good[0].rights.client);
  EXPECT_FALSE(good[0].rights.admin);
  EXPECT_TRUE(good[0].rights.may_serve("gen"));
  EXPECT_TRUE(good[0].rights.may_serve("viz.1"));
  EXPECT_FALSE(good[0].rights.may_serve("gen2"));
  std::string hash = keys.public_key;  // Z85 has a #
  hash[4] = '#';
  EXPECT_EQ(list("ann " + hash + " client #x\n").at(0).public_key, hash);
  for (const std::string& bad :
       {"ann\n"s, "ann short client\n"s, "ann " + keys.public_key + " king\n",
        "ann " + keys.public_key + " client\nbob " + keys.public_key + " client\n"}) {
    try {
      list(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), HasSubstr("allow.txt:"));
    }
  }
}

}  // namespace
}  // namespace ssphh::majordomo::test

/// Key files, allow-lists, endpoints and names: each rule at its edge, and what is said of who breaks it.

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/worker.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::memory_dir;
using ssphh::test::message_of;
using ssphh::test::TempDir;

class Keys : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text, mode_t mode = 0600) const {
    const std::string path = (dir_ / name).string();
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
    return path;
  }
  std::string said_of_list(const std::string& text) const {
    const std::string path = write("allow.txt", text);
    const std::string said = message_of([&] { read_allow_list(path); });
    return said.starts_with(path) ? said.substr(path.size()) : said;
  }
  TempDir dir_{memory_dir()};
  const KeyPair a_ = make_key_pair(), b_ = make_key_pair();
};

TEST_F(Keys, HaveNamesOfOneToAHundredPlainCharacters) {
  for (const std::string& good : {std::string("Az09._-"), std::string(100, 'x')})
    EXPECT_EQ(message_of([&] { write_key_pair(dir_.path(), good, a_); }), "no error") << good;
  for (const std::string& bad :
       {std::string(), std::string(101, 'x'), std::string("a b"), std::string("a/b"), std::string("a:b"),
        std::string("a@b"), std::string("a[b"), std::string("a`b"), std::string("a{b")}) {
    EXPECT_TRUE(message_of([&] {
                  write_key_pair(dir_.path(), bad, a_);
                }).ends_with("is no name for a key (use A-Z a-z 0-9 . _ -, at most 100)"))
        << bad;
  }
}

TEST_F(Keys, AreNeverOverwritten) {
  const TempDir dir;
  const auto said = [&] { return message_of([&] { write_key_pair(dir.path(), "k", a_); }); };
  std::ofstream(dir / "k.pub") << "x";
  EXPECT_EQ(said(), (dir / "k.pub").string() + ": exists already (choose another name or remove it first)");
  std::filesystem::remove(dir / "k.pub");
  std::ofstream(dir / "k.key") << "x";
  EXPECT_EQ(said(), (dir / "k.key").string() + ": exists already (choose another name or remove it first)");
}

TEST_F(Keys, FilesAreTheirOwnersAlone) {
  const std::string text = "public " + a_.public_key + "\nsecret " + a_.secret_key + "\n";
  for (const mode_t mode : {0600, 0400, 0700}) {
    const KeyPair read = read_key_pair(write("k.key", text, mode));
    EXPECT_EQ(read.public_key, a_.public_key);
    EXPECT_EQ(read.secret_key, a_.secret_key);
  }
  for (const mode_t bit : {0040, 0020, 0010, 0004, 0002, 0001}) {
    const std::string path = write("k.key", text, 0600 | bit);
    EXPECT_EQ(message_of([&] { read_key_pair(path); }),
              path + ": others can read the secret key (chmod 600 it, or make a new one)");
  }
}

TEST_F(Keys, FilesHoldKeysAndNothingElse) {
  const std::string no_key = ": is no key file (make one with `ssphh farm keygen`)";
  for (const std::string& bad :
       {"public " + a_.public_key, "public " + a_.public_key + " secret " + a_.secret_key + " more",
        "secret " + a_.public_key + " secret " + a_.secret_key,
        "public " + a_.public_key + " public " + a_.secret_key,
        "public " + a_.public_key + "x secret " + a_.secret_key,
        "public " + a_.public_key + " secret " + a_.secret_key.substr(1)}) {
    const std::string path = write("k.key", bad);
    EXPECT_EQ(message_of([&] { read_key_pair(path); }), path + no_key) << bad;
  }
  EXPECT_EQ(read_public_key(write("k.pub", " " + a_.public_key + "\n")), a_.public_key);
  for (const std::string& bad :
       {std::string(), a_.public_key + " " + b_.public_key, a_.public_key.substr(1)}) {
    const std::string path = write("k.pub", bad);
    EXPECT_EQ(message_of([&] { read_public_key(path); }), path + ": is no public key (copy NAME.pub here)")
        << bad;
  }
  const std::string large = write("k.pub", a_.public_key + std::string(4096, ' '));
  EXPECT_NE(message_of([&] { read_public_key(large); }), "no error");
  const std::string pair = "public " + a_.public_key + " secret " + a_.secret_key;
  for (const std::size_t size : {4096, 4097}) {
    const std::string path = write("k.key", pair + std::string(size - pair.size(), ' '));
    EXPECT_EQ(message_of([&] { read_key_pair(path); }) == "no error", size == 4096) << size;
  }
}

TEST_F(Keys, ListsNameAKeyAndItsRoles) {
  const std::string path =
      write("allow.txt", "# all\n\n  ann  " + a_.public_key + "\tclient worker # of both\nbob " +
                             b_.public_key + " admin worker:a.* worker:b #\n");
  const AllowList list = read_allow_list(path);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].public_key, a_.public_key);
  EXPECT_EQ(list[0].rights, (Rights{"ann", true, false, {"*"}}));
  EXPECT_EQ(list[1].public_key, b_.public_key);
  EXPECT_EQ(list[1].rights, (Rights{"bob", false, true, {"a.*", "b"}}));
}

TEST_F(Keys, ListsSayWhatIsWrongAndWhere) {
  const std::string line = "ann " + a_.public_key + " client\n";
  const std::string form = " is not NAME PUBLIC-KEY ROLE... (the key is the text in NAME.pub)";
  EXPECT_EQ(said_of_list(line + "bob " + b_.public_key + "\n"), ":2:" + form);
  EXPECT_EQ(said_of_list(line + "\nbob " + b_.public_key + " # client\n"), ":3:" + form);
  EXPECT_EQ(said_of_list("a@b " + a_.public_key + " client\n"), ":1:" + form);
  EXPECT_EQ(said_of_list("ann " + a_.public_key.substr(1) + " client\n"), ":1:" + form);
  const std::string roles = " (use client, admin, worker or worker:SERVICE)";
  EXPECT_EQ(said_of_list("ann " + a_.public_key + " king\n"), ":1: unknown role 'king'" + roles);
  EXPECT_EQ(said_of_list("ann " + a_.public_key + " client worker:\n"), ":1: unknown role 'worker:'" + roles);
  const std::string twice = " this name or key stands here twice (one line per key)";
  EXPECT_EQ(said_of_list(line + "bob " + a_.public_key + " client\n"), ":2:" + twice);
  EXPECT_EQ(said_of_list(line + "ann " + b_.public_key + " client\n"), ":2:" + twice);
  EXPECT_EQ(said_of_list(line + "bob " + b_.public_key + " client"), "no error") << "no newline at the end";
}

TEST_F(Keys, AreAddedToAListLineByLine) {
  const std::filesystem::path path = dir_ / "allow.txt";
  add_to_allow_list(path, "ann", a_.public_key, {"client", "worker:x"});
  const auto text = [&] {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string ann = "ann " + a_.public_key + " client worker:x\n",
                    bob = "bob " + b_.public_key + " admin\n";
  EXPECT_EQ(text(), ann);
  write("allow.txt", ann.substr(0, ann.size() - 1));
  add_to_allow_list(path, "bob", b_.public_key, {"admin"});
  EXPECT_EQ(text(), ann + bob);
  const std::string again = " stands there already (remove its line first)";
  const auto said = [&](const std::string& name, const std::string& key) {
    return message_of([&] { add_to_allow_list(path, name, key, {"client"}); });
  };
  const std::string fresh = make_key_pair().public_key;
  EXPECT_EQ(said("ann", fresh), path.string() + ": ann" + again);
  EXPECT_EQ(said("eve", b_.public_key), path.string() + ": eve" + again);
  EXPECT_TRUE(message_of([&] {
                add_to_allow_list(path, "eve", fresh, {});
              }).starts_with(path.string() + ": is not NAME"));
  EXPECT_EQ(text(), ann + bob);
}

TEST_F(Keys, OfAFolderAreFoundByName) {
  write_key_pair(dir_.path(), "broker", a_);
  write_key_pair(dir_.path(), "ann", b_);
  write("allow.txt", "ann " + b_.public_key + " client\n");
  const PeerSecurity peer = read_peer_security(dir_.path(), "ann");
  EXPECT_EQ(peer.broker_key, a_.public_key);
  EXPECT_EQ(peer.keys.public_key, b_.public_key);
  EXPECT_EQ(peer.keys.secret_key, b_.secret_key);
  const BrokerSecurity broker = read_broker_security(dir_.path());
  EXPECT_EQ(broker.keys.public_key, a_.public_key);
  EXPECT_EQ(broker.keys.secret_key, a_.secret_key);
  EXPECT_EQ(broker.allow_file, dir_ / "allow.txt");
  ASSERT_EQ(broker.allowed.size(), 1u);
  EXPECT_EQ(broker.allowed[0].rights.name, "ann");
}

TEST(RightsOf, ServicesMayEndInAStar) {
  const Rights rights{"w", false, false, {"a", "b.*"}};
  for (const char* good : {"a", "b.", "b.c"}) EXPECT_TRUE(rights.may_serve(good)) << good;
  for (const char* bad : {"", "aa", "b", "bc", "c"}) EXPECT_FALSE(rights.may_serve(bad)) << bad;
  EXPECT_TRUE((Rights{"w", false, false, {"*"}}.may_serve("")));
  EXPECT_FALSE((Rights{"w", false, false, {}}.may_serve("a")));
}

TEST(Endpoints, AreOfThisMachineOrNeedKeys) {
  for (const char* local : {"tcp://eth0:0;127.0.0.1:1", "tcp://10.0.0.1:1;localhost:1", "tcp://::1:1"})
    EXPECT_TRUE(is_local_endpoint(local)) << local;
  for (const char* remote :
       {"tcp://127.0.0.1:1;10.0.0.1:1", "udp://127.0.0.1:1", "tcp://127x:1", "tcp://128.0.0.1:1", ""})
    EXPECT_FALSE(is_local_endpoint(remote)) << remote;
  const auto said = [](const char* endpoint, bool keys) {
    return message_of([&] { require_keys(endpoint, keys, "--to"); });
  };
  for (const char* local : {"tcp://127.0.0.1:1", "ipc://x", "inproc://x"})
    EXPECT_EQ(said(local, false), "no error");
  EXPECT_EQ(said("tcp://10.0.0.1:1", true), "no error");
  EXPECT_EQ(
      said("tcp://10.0.0.1:1", false),
      "--to tcp://10.0.0.1:1: leaves this machine, and there are no keys (make keys with `ssphh farm keygen` "
      "and give their folder with --keys)");
  for (const bool keys : {false, true})
    EXPECT_EQ(said("pgm://x", keys), "--to pgm://x: is no endpoint (write tcp://HOST:PORT or ipc://PATH)");
}

TEST(Endpoints, HavePortsThatThereAre) {
  const auto said = [](const std::string& endpoint) {
    return message_of([&] { require_keys(endpoint, true, "--to"); });
  };
  for (const char* good : {"tcp://127.0.0.1:0", "tcp://127.0.0.1:65535", "tcp://[::1]:1", "tcp://127.0.0.1:*",
                           "ipc:///tmp/a:99999", "tcp://127.0.0.1:http"})
    EXPECT_EQ(said(good), "no error");
  for (const std::string bad : {"65536", "99999", "99999999999999999999999"}) {
    for (const std::string host : {"127.0.0.1", "[::1]", "farm"})
      EXPECT_EQ(said("tcp://" + host + ":" + bad),
                "--to tcp://" + host + ":" + bad + ": has the port " + bad + " (ports are 0 to 65535)");
  }
  EXPECT_EQ(
      message_of([] { Broker({.bind = "tcp://127.0.0.1:0", .metrics_bind = "tcp://127.0.0.1:65536"}); }),
      "--metrics tcp://127.0.0.1:65536: has the port 65536 (ports are 0 to 65535)");
}

TEST(Endpoints, AndNamesOfPeersAreLookedAtFirst) {
  const std::string local = "tcp://127.0.0.1:1";
  const auto worker = [&](const std::string& name, const std::string& service, const std::string& endpoint) {
    return message_of([&] { Worker({.endpoint = endpoint, .service = service, .name = name}); });
  };
  const std::string service =
      "service name: is empty, too long or not printable (use 1 to 255 ASCII characters)";
  for (const std::string& good : {std::string("Az09._:/-"), std::string(100, 'x')})
    EXPECT_EQ(worker(good, "x", local), "no error");
  for (const std::string& bad :
       {std::string(101, 'x'), std::string("a b"), std::string("a@"), std::string("[")}) {
    EXPECT_EQ(worker(bad, "x", local),
              "worker name: has characters other than A-Za-z0-9._:/- or more than 100 (choose another)");
  }
  EXPECT_EQ(worker("w", std::string(255, 's'), local), "no error");
  for (const std::string& bad :
       {std::string(), std::string(256, 's'), std::string("\x1f"), std::string("\x7f")}) {
    EXPECT_EQ(worker("w", bad, local), service);
    Client client({.endpoint = local});
    EXPECT_EQ(message_of([&] { client.submit(bad, {"x"}); }), service);
  }
  EXPECT_TRUE(worker("w", "x", "tcp://10.0.0.1:1")
                  .starts_with("broker endpoint tcp://10.0.0.1:1: leaves this machine"));
  EXPECT_TRUE(message_of([] {
                Client({.endpoint = "tcp://10.0.0.1:1"});
              }).starts_with("broker endpoint tcp://10.0.0.1:1: leaves this machine"));
  EXPECT_EQ(message_of([] { Client({.endpoint = "tcp://127.0.0.1:port"}); }),
            "tcp://127.0.0.1:port: cannot connect: Invalid argument (write tcp://HOST:PORT or ipc://PATH)");
  const auto broker = [](BrokerOptions options) { return message_of([&] { Broker{std::move(options)}; }); };
  EXPECT_TRUE(broker({.bind = "tcp://0.0.0.0:0"}).starts_with("--bind tcp://0.0.0.0:0: leaves this machine"));
  EXPECT_EQ(broker({.bind = "tcp://127.0.0.1:0", .timers = {.worker_expiry = 7499}}),
            "worker expiry: is shorter than three heartbeats (the guide's workers beat every 2500 ms: at "
            "least 7500 ms "
            "with them)");
  const Broker first({.bind = "tcp://127.0.0.1:0"});
  EXPECT_EQ(broker({.bind = first.endpoint()}),
            first.endpoint() +
                ": cannot bind: Address already in use (does another broker run there? Port 0 finds a "
                "free one)");
  EXPECT_EQ(broker({.bind = "tcp://127.0.0.1:port"}),
            "tcp://127.0.0.1:port: cannot bind: Invalid argument (write tcp://ADDRESS:PORT or ipc://PATH)");
  EXPECT_EQ(broker({.bind = "tcp://127.0.0.1:0", .metrics_bind = first.endpoint()}),
            first.endpoint() + ": cannot bind the metrics: Address already in use (choose another port)");
}

}  // namespace
}  // namespace ssphh::majordomo::test

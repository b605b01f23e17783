/// Contracts of libs/majordomo: its clients, workers, brokers, keys and messages.

#include <limits>

#include <ssphh/core/file.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/broker_core.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>
#include <ssphh/majordomo/security.h>
#include <ssphh/majordomo/worker.h>

#include "contract.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using namespace majordomo;

constexpr Millis never = std::numeric_limits<Millis>::max();
/// Where no broker is.
const std::string no_broker = "ipc:///tmp/ssphh-no-broker-is-here";

Contract refuses_client(const std::string& given, std::function<void(ClientOptions&)> spoil,
                        std::vector<std::string> words) {
  return refuses(
      "Client", given,
      [spoil] {
        ClientOptions options;
        options.endpoint = no_broker;
        spoil(options);
        Client client(options);
      },
      std::move(words));
}

/// A row for a call that leaves a client as it was.
Contract refuses_request(const std::string& entry, const std::string& given,
                         std::function<void(Client&)> call, std::vector<std::string> words) {
  return refuses(
      entry, given,
      [] {
        ClientOptions options;
        options.endpoint = no_broker;
        return std::make_unique<Client>(options);
      },
      std::move(call), std::move(words),
      [](Client& client) {
        EXPECT_EQ(client.outstanding(), 0u);
        client.cancel(client.submit("service", {}));
        EXPECT_EQ(client.poll(1000)->outcome, Outcome::cancelled);
      });
}

RequestOptions request_with(Millis deadline, Millis attempt_timeout) {
  RequestOptions options;
  options.deadline = deadline;
  options.attempt_timeout = attempt_timeout;
  return options;
}

std::vector<Contract> of_clients() {
  return {
      refuses_client("AtNoEndpoint", [](ClientOptions& o) { o.endpoint = ""; }, {"is no endpoint"}),
      refuses_client("AtHalfAnEndpoint", [](ClientOptions& o) { o.endpoint = "tcp://127.0.0.1"; },
                     {"tcp://127.0.0.1"}),
      refuses_client("WithKeysThatAreNone", [](ClientOptions& o) { o.security.emplace(); },
                     {"broker endpoint", "key"}),
      refuses_client("ThatSendsNothing", [](ClientOptions& o) { o.window = 0; }, {"window"}),
      refuses_client("ThatAsksWithoutPause", [](ClientOptions& o) { o.ask_again = 0; }, {"ask"}),
      refuses_client("ThatHasNoPatience",
                     [](ClientOptions& o) { o.dialect = Dialect::mdp01, o.foreign_timeout = -1; },
                     {"foreign"}),
      refuses_client("ThatNeverTries",
                     [](ClientOptions& o) { o.dialect = Dialect::mdp02, o.foreign_tries = 0; }, {"foreign"}),
      refuses_request("Submit", "ToNoService", [](Client& c) { c.submit("", {}); }, {"service name"}),
      refuses_request("Submit", "ToALongService", [](Client& c) { c.submit(std::string(256, 'x'), {}); },
                      {"service name"}),
      refuses_request("Submit", "ThatIsLateAlready",
                      [](Client& c) { c.submit("service", {}, request_with(-1, 0)); }, {"deadline"}),
      refuses_request("Submit", "AtTheEndOfTime",
                      [](Client& c) { c.submit("service", {}, request_with(never, 0)); }, {"deadline"}),
      refuses_request("Submit", "OfANegativeAttempt",
                      [](Client& c) { c.submit("service", {}, request_with(0, -5)); }, {"attempt"}),
      refuses_request("Call", "ToNoService", [](Client& c) { c.call("", {}); }, {"service name"}),
      gives("Poll", "UntilTheEndOfTime",
            [] {
              ClientOptions options;
              options.endpoint = no_broker;
              Client client(options);
              RequestOptions soon;
              soon.deadline = 50;
              client.submit("service", {}, soon);
              const auto event = client.poll(never);
              ASSERT_TRUE(event);
              EXPECT_EQ(event->outcome, Outcome::expired);
            }),
      gives("Client", "ThatWasMoved",
            [] {
              ClientOptions options;
              options.endpoint = no_broker;
              Client first(options), second = std::move(first);
              expect_refusal([&] { first.submit("service", {}); }, {"moved from"});
              expect_refusal([&] { first.call("service", {}); }, {"moved from"});
              expect_refusal([&] { first.poll(0); }, {"moved from"});
              expect_refusal([&] { first.cancel({}); }, {"moved from"});
              expect_refusal([&] { (void)first.outstanding(); }, {"moved from"});
              expect_refusal([&] { (void)first.connected(); }, {"moved from"});
              first = std::move(second);
              EXPECT_EQ(first.outstanding(), 0u);
            }),
  };
}

Contract refuses_worker(const std::string& given, std::function<void(WorkerOptions&)> spoil,
                        std::vector<std::string> words) {
  return refuses(
      "Worker", given,
      [spoil] {
        WorkerOptions options;
        options.endpoint = no_broker, options.service = "service", options.name = "a";
        spoil(options);
        Worker worker(options);
      },
      std::move(words));
}

std::vector<Contract> of_workers() {
  return {
      refuses_worker("AtNoEndpoint", [](WorkerOptions& o) { o.endpoint = ""; }, {"is no endpoint"}),
      refuses_worker("OfNoService", [](WorkerOptions& o) { o.service = ""; }, {"service name"}),
      refuses_worker("OfABadName", [](WorkerOptions& o) { o.name = "a#b"; }, {"worker name"}),
      refuses_worker("WithKeysThatAreNone", [](WorkerOptions& o) { o.security.emplace(); },
                     {"broker endpoint", "key"}),
      refuses_worker("ThatBeatsWithoutPause", [](WorkerOptions& o) { o.heartbeat = 0; }, {"heartbeat"}),
      refuses_worker("ThatGivesUpAtOnce", [](WorkerOptions& o) { o.broker_expiry = 0; }, {"broker expiry"}),
      refuses_worker("ThatConnectsWithoutPause", [](WorkerOptions& o) { o.reconnect = 0; }, {"reconnect"}),
      refuses_worker("ThatWaitsLessAndLess",
                     [](WorkerOptions& o) { o.reconnect = 100, o.reconnect_max = 10; }, {"reconnect"}),
      refuses("Worker", "WithoutAHandler",
              [] {
                WorkerOptions options;
                options.endpoint = no_broker, options.service = "service";
                Worker worker(options);
                worker.stop();
                worker.run({});
              },
              {"handler"}),
  };
}

Contract refuses_broker(const std::string& given, std::function<void(BrokerOptions&)> spoil,
                        std::vector<std::string> words) {
  return refuses(
      "Broker", given,
      [spoil] {
        BrokerOptions options;
        options.bind = "tcp://127.0.0.1:*";
        spoil(options);
        Broker broker(options);
      },
      std::move(words));
}

BrokerCore::Random zeros() {
  return [] { return std::array<std::uint64_t, 2>{}; };
}

std::vector<Contract> of_brokers() {
  const double none = double(nan);
  return {
      refuses_broker("AtNoEndpoint", [](BrokerOptions& o) { o.bind = ""; }, {"--bind", "is no endpoint"}),
      refuses_broker("AtAnEndpointOfLetters", [](BrokerOptions& o) { o.bind = "tcp://127.0.0.1:x"; },
                     {"cannot bind"}),
      refuses_broker("WithKeysThatAreNone", [](BrokerOptions& o) { o.security.emplace(); }, {"key"}),
      refuses_broker("WithMetricsNowhere", [](BrokerOptions& o) { o.metrics_bind = "here"; }, {"here"}),
      refuses_broker("WithAStoreInAFile", [](BrokerOptions& o) { o.store = "/dev/null/store"; },
                     {"/dev/null/store"}),
      refuses_broker("ThatNeverTries", [](BrokerOptions& o) { o.limits.attempts = 0; }, {"attempts"}),
      refuses_broker("OfARateThatIsNone", [none](BrokerOptions& o) { o.limits.messages_per_second = none; },
                     {"messages"}),
      refuses_broker("OfStragglersThatAreNone", [none](BrokerOptions& o) { o.timers.straggler = none; },
                     {"straggler"}),
      refuses_broker("OfAShareThatIsNone", [none](BrokerOptions& o) { o.timers.straggler_after = none; },
                     {"straggler"}),
      refuses_broker("ThatWaitsBackwards", [](BrokerOptions& o) { o.timers.retry_backoff = -1; },
                     {"retry_backoff"}),
      refuses_broker("ThatWaitsForEver", [](BrokerOptions& o) { o.timers.attempt_timeout = never; },
                     {"attempt_timeout"}),
      refuses_broker("ThatDrainsBackwards", [](BrokerOptions& o) { o.drain = -1; }, {"drain"}),
      refuses_broker("ThatClosesAtOnce", [](BrokerOptions& o) { o.connection_timeout = 0; },
                     {"connection timeout"}),
      refuses("BrokerCore", "WithoutRandomNumbers", [] { BrokerCore({}, {}, {}); }, {"random"}),
      refuses("BrokerCore", "WithoutHeartbeat",
              [] {
                BrokerTimers timers;
                timers.heartbeat = 0;
                BrokerCore({}, timers, zeros());
              },
              {"heartbeat"}),
      gives("BrokerCore", "MessagesOfNoFrames",
            [] {
              BrokerCore core({}, {}, zeros());
              core.receive(1, "", {});
              core.receive(2, std::string(300, 'x'), {"", "", ""});
              core.peer_gone(3, "nobody");
              core.revoke(4, "nobody");
              core.tick(5);
              EXPECT_EQ(core.stats().dropped, 2u);
            }),
  };
}

std::vector<Contract> of_keys() {
  const KeyPair keys = make_key_pair();
  return {
      refuses("WriteKeyPair", "OfNoName", [=] { write_key_pair(TempDir().path(), "", keys); },
              {"no name for a key"}),
      refuses("WriteKeyPair", "OfKeysThatAreNone",
              [] {
                write_key_pair(TempDir().path(), "a", {"public", "secret"});
              },
              {"CURVE key"}),
      refuses("WriteKeyPair", "IntoAFile", [=] { write_key_pair("/dev/null/keys", "a", keys); },
              {"/dev/null/keys"}),
      refuses("ReadKeyPair", "OfAFolder", [] { read_key_pair("/tmp"); }, {"/tmp"}),
      refuses("ReadPublicKey", "OfNoFile", [] { read_public_key(""); }, {"cannot"}),
      refuses("ReadPeerSecurity", "OfNoFolder", [] { read_peer_security("/nowhere", "a"); },
              {"/nowhere/broker.pub"}),
      refuses("ReadBrokerSecurity", "OfNoFolder", [] { read_broker_security("/nowhere"); },
              {"/nowhere/broker.key"}),
      refuses("AddToAllowList", "WithoutRoles",
              [=] { add_to_allow_list(TempDir().path() / "allow.txt", "a", keys.public_key, {}); }, {"ROLE"}),
      refuses("AddToAllowList", "OfARoleThatIsALine",
              [=] {
                const TempDir dir;
                add_to_allow_list(dir / "allow.txt", "a", keys.public_key,
                                  {"worker:x\nb " + make_key_pair().public_key + " admin"});
              },
              {"unknown role"}),
      refuses("RequirePort", "OfTooMuch", [] { require_port("tcp://a:65536", "--bind"); },
              {"--bind", "65535"}),
      gives("RequirePort", "Nothing", [] { require_port("", ""); }),
      gives("Local", "NoEndpoint", [] { EXPECT_FALSE(is_local_endpoint("")); }),
      gives("Local", "HalfAnEndpoint", [] { EXPECT_FALSE(is_local_endpoint("tcp://")); }),
      gives("Rights", "OfNoServices",
            [] {
              Rights rights;
              rights.services = {""};
              EXPECT_FALSE(rights.may_serve("gen"));
              rights.services.clear();
              EXPECT_FALSE(rights.may_serve(""));
            }),
  };
}

std::vector<Contract> of_messages() {
  return {
      gives("Decode", "NoFrames",
            [] { EXPECT_STREQ(decode({}, Direction::to_broker).problem, "no frames"); }),
      gives("DecodeEnvelope", "NoBytes", [] { EXPECT_FALSE(decode_envelope("")); }),
      gives("EncodeEnvelope", "OfTooManyIds",
            [] {
              Envelope envelope;
              envelope.ids.resize(envelope_ids + 5);
              EXPECT_EQ(decode_envelope(encode_envelope(envelope))->ids.size(), envelope_ids);
            }),
      gives("EncodeEnvelope", "OfNoKind",
            [] {
              Envelope envelope;
              envelope.kind = static_cast<EnvelopeKind>(200);
              EXPECT_FALSE(decode_envelope(encode_envelope(envelope)));
            }),
      gives("Token", "OfNoBytes", [] { EXPECT_FALSE(Token::parse("")); }),
      gives("RequestId", "OfNoDigits", [] { EXPECT_FALSE(RequestId::parse(std::string(32, 'g'))); }),
      gives("FillRandom", "NoBytes", [] { fill_random({}); }),
      gives("Event", "OfStrangeBytes",
            [] {
              const BrokerEvent event{LogLevel::info, "x", {{"peer", "\xff\n"}}};
              EXPECT_EQ(event.text().find('\n'), std::string::npos);
              EXPECT_EQ(event.json().find('\n'), std::string::npos);
            }),
      refuses("Encode", "OfNoCommand",
              [] {
                Message message;
                message.command = static_cast<Command>(99);
                encode(message);
              },
              {"message", "command"}),
      refuses("Encode", "OfNoVersion",
              [] {
                Message message;
                message.version = static_cast<Version>(7);
                encode(message);
              },
              {"message", "version"}),
  };
}

SSPHH_CONTRACTS(MajordomoClient, of_clients());
SSPHH_CONTRACTS(MajordomoWorker, of_workers());
SSPHH_CONTRACTS(MajordomoBroker, of_brokers());
SSPHH_CONTRACTS(MajordomoKeys, of_keys());
SSPHH_CONTRACTS(MajordomoMessages, of_messages());

}  // namespace
}  // namespace ssphh::test

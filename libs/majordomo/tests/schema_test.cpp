/// What the broker writes as JSON conforms to schemas/; the schemas refuse what it does not write.

#include <gmock/gmock.h>

#include "broker_harness.h"
#include "json_schema.h"
#include "json_text.h"
#include "places.h"

namespace ssphh::majordomo::test {
namespace {

using testing::IsEmpty;
using testing::Not;

std::vector<std::string> errors(const std::string& schema, const std::string& document) {
  return ssphh::test::schema_errors(ssphh::test::source_dir() / "schemas" / (schema + ".schema.json"),
                                    document);
}

/// A broker that has seen something of everything.
struct Eventful : Harness {
  Eventful() {
    send("ssphh1:host:1#x", ready02("gen"));
    send("w", ready01("viz"), {.name = "key"});
    for (std::uint64_t i = 1; i <= 3; ++i) send("c", submit("gen", {.ids = {{i, i}}}));
    send("bad\n\xff", {"nonsense"});
    for (int i = 0; i < 3; ++i) {
      const std::string worker = "k" + std::to_string(i);
      send("d", submit("poison", {.ids = {{9, 9}}}));
      send(worker, ready01("poison"));
      pass(1000);
      gone(worker);
    }
  }
  std::string ask(const std::string& service) {
    send("x", client01(service, {""}));
    return taken("x").at(0).at(4);
  }
};

TEST(BrokerSchemas, RepliesConform) {
  Eventful broker;
  for (const char* name : {"stats", "workers", "parked"}) {
    const std::string document = broker.ask(std::string("mmi.") + name);
    EXPECT_THAT(errors(std::string("broker-") + name, document), IsEmpty()) << document;
    json::Value changed = ssphh::test::parse_json(document);
    changed["version"] = 2;
    EXPECT_THAT(errors(std::string("broker-") + name, print(changed)), Not(IsEmpty()));
    changed = ssphh::test::parse_json(document);
    changed["more"] = 1;
    EXPECT_THAT(errors(std::string("broker-") + name, print(changed)), Not(IsEmpty()));
  }
  EXPECT_EQ(ssphh::test::parse_json(broker.ask("mmi.parked"))["jobs"].size(), 1u);
}

TEST(BrokerSchemas, EventsConform) {
  Eventful broker;
  ASSERT_FALSE(broker.events.empty());
  for (const BrokerEvent& event : broker.events)
    EXPECT_THAT(errors("broker-event", event.json()), IsEmpty()) << event.json();
  EXPECT_THAT(errors("broker-event", R"({"event": "unheard-of", "level": "info"})"), Not(IsEmpty()));
}

TEST(BrokerEvents, TextIsOneHarmlessLine) {
  const BrokerEvent event{LogLevel::warning, "peer-invalid", {{"peer", "a\nb\x1b[0m"}, {"reason", "plain"}}};
  EXPECT_EQ(event.text(), "peer-invalid peer=\"a\\nb\\u001b[0m\" reason=plain");
}

}  // namespace
}  // namespace ssphh::majordomo::test

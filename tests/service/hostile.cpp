#include "checks.h"
#include "peer.h"

namespace ssphh::probe {
namespace {

/// The broker serves others after a hostile message.
std::function<bool(const std::string&)> survives(Frames message) {
  return [message](const std::string& endpoint) {
    Peer hostile(endpoint);
    hostile.send(message);
    if (!hostile.connected()) return false;
    static int number = 0;
    const std::string service = "p.survivor" + std::to_string(++number);
    Worker01 worker(endpoint, service);
    Peer client(endpoint);
    client.send(request01(service, {"a"}));
    if (!worker.job()) return false;
    worker.reply({"b"});
    return client.receive() == Frames{"", "MDPC01", service, "b"};
  };
}

}  // namespace

std::vector<Check> hostile() {
  const std::string zero(1, '\0');
  return {
      {"one empty frame", "hostile", survives({""})},
      {"two empty frames", "hostile", survives({"", ""})},
      {"unknown header", "hostile", survives({"", "MDPX01", "echo", "x"})},
      {"client header alone (0.1)", "hostile", survives({"", "MDPC01"})},
      {"client without body (0.1)", "hostile", survives({"", "MDPC01", "echo"})},
      {"empty service", "hostile", survives({"", "MDPC01", "", "x"})},
      {"service with control characters", "hostile", survives({"", "MDPC01", "a\r\nb", "x"})},
      {"service of 100 KB", "hostile", survives({"", "MDPC01", std::string(100'000, 's'), "x"})},
      {"client header alone (0.2)", "hostile", survives({"MDPC02"})},
      {"client command alone (0.2)", "hostile", survives({"MDPC02", "\x01"})},
      {"client sends PARTIAL", "hostile", survives({"MDPC02", "\x02", "echo", "x"})},
      {"unknown client command", "hostile", survives({"MDPC02", "\x77", "echo", "x"})},
      {"worker header alone (0.1)", "hostile", survives({"", "MDPW01"})},
      {"empty worker command", "hostile", survives({"", "MDPW01", ""})},
      {"worker command of two bytes", "hostile", survives({"", "MDPW01", "\x01\x01", "echo"})},
      {"unknown worker command", "hostile", survives({"", "MDPW01", zero})},
      {"READY without service", "hostile", survives({"", "MDPW01", "\x01"})},
      {"READY with empty service", "hostile", survives({"", "MDPW01", "\x01", ""})},
      {"REPLY without address", "hostile", survives({"", "MDPW01", "\x03"})},
      {"REPLY without delimiter", "hostile", survives({"", "MDPW01", "\x03", "c"})},
      {"REPLY with a wrong delimiter", "hostile", survives({"", "MDPW01", "\x03", "c", "d", "x"})},
      {"REPLY without body", "hostile", survives({"", "MDPW01", "\x03", "c", ""})},
      {"worker sends REQUEST", "hostile", survives({"", "MDPW01", "\x02", "c", "", "x"})},
      {"DISCONNECT with more frames", "hostile", survives({"", "MDPW01", "\x05", "x"})},
      {"0.2 FINAL from nobody", "hostile", survives({"MDPW02", "\x04", "c", "", "x"})},
      {"a thousand frames", "hostile", survives(Frames(1000, "x"))},
      {"bytes 0 to 255", "hostile", survives([] {
         std::string all;
         for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
         return Frames{all, all, all};
       }())},
  };
}

}  // namespace ssphh::probe

#include <ssphh/core/json.h>
#include <ssphh/majordomo/event.h>

namespace ssphh::majordomo {
namespace {

// What a peer sent may be anything; ensure_ascii and `replace` make any bytes one harmless line.
std::string quoted(const std::string& text) {
  return json::print(text, -1, json::Letters::ascii);
}

bool is_plain(const std::string& text) {
  for (const char c : text)
    if (c <= ' ' || c > '~' || c == '"' || c == '=' || c == '\\') return false;
  return !text.empty();
}

}  // namespace

std::string BrokerEvent::text() const {
  std::string line = name;
  for (const auto& [key, value] : fields) {
    line += ' ';
    line += key;
    line += '=';
    line += is_plain(value) ? value : quoted(value);
  }
  return line;
}

std::string BrokerEvent::json() const {
  json::Value object = {{"event", name}, {"level", name_of(level)}};
  for (const auto& [key, value] : fields) object[key] = value;
  return json::print(object, -1, json::Letters::ascii);
}

}  // namespace ssphh::majordomo

#include <ssphh/core/error.h>
#include <ssphh/farm/ask.h>

namespace ssphh::farm {

majordomo::Client connect(const BrokerAddress& broker) {
  majordomo::ClientOptions options;
  options.endpoint = broker.endpoint;
  options.security = broker.security;
  return majordomo::Client(options);
}

std::string ask(majordomo::Client& client, const std::string& service, const std::string& body,
                const Control& control, const std::string& not_found) {
  majordomo::RequestOptions request;
  request.deadline = 5000;
  const majordomo::Frames reply = client.call(service, {body}, request, control);
  const std::string code = reply.empty() ? "" : reply[0];
  if (code == "403") throw Error(service, "this key has no admin role", "make one with --role admin");
  if (code == "404") throw Error(service, not_found);
  if (code != "200") throw Error(service, "the broker does not know it", "is it an older one?");
  return reply.size() > 1 ? reply[1] : "";
}

json::Value ask_json(majordomo::Client& client, const std::string& service, const Control& control) {
  json::Value object = json::parse(ask(client, service, "", control), service);
  if (!object.is_object()) throw Error(service, "the broker's answer is no JSON object");
  return object;
}

double told_number(const json::Cursor& of, const char* name) {
  const auto number = of.find(name);
  return number ? number->precise_number() : 0;
}

}  // namespace ssphh::farm

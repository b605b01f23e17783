#pragma once
/// Questions to a broker's management services (mmi.*, docs/protocol.md).

#include <string>

#include <ssphh/core/json_cursor.h>
#include <ssphh/farm/blob_server.h>
#include <ssphh/majordomo/client.h>

namespace ssphh::farm {

/// A client that waits for its broker where that is not there yet. Throws Error as majordomo::Client does.
majordomo::Client connect(const BrokerAddress& broker);

/// The second frame of the answer. Throws Error when the code is not 200 (`not_found` is what 404 means) or
/// none comes within five seconds.
std::string ask(majordomo::Client& client, const std::string& service, const std::string& body,
                const Control& control, const std::string& not_found = "the broker does not know it");
/// The same as an object of JSON, which a Cursor reads with the service as its file.
json::Value ask_json(majordomo::Client& client, const std::string& service, const Control& control);
/// A number that the answer may leave out, as older brokers do: 0 then.
double told_number(const json::Cursor& of, const char* name);

}  // namespace ssphh::farm

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ssphh::test {

/// What of a JSON document breaks a schema (draft 7), one line each; empty when it conforms. Throws
/// std::exception when either text is not JSON or the schema is not a schema.
std::vector<std::string> schema_errors(const std::filesystem::path& schema, const std::string& document);

}  // namespace ssphh::test

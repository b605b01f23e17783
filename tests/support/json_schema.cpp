#define VALIJSON_USE_EXCEPTIONS 1  // without it a bad schema aborts the process

#include "json_schema.h"

#include <fstream>
#include <map>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace ssphh::test {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

std::unique_ptr<valijson::Schema> load(const std::filesystem::path& path) {
  const nlohmann::json document = nlohmann::json::parse(std::ifstream(path));
  auto schema = std::make_unique<valijson::Schema>();
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(document), *schema);
  return schema;
}

}  // namespace

std::vector<std::string> schema_errors(const std::filesystem::path& schema_path, const std::string& text) {
  static std::map<std::filesystem::path, std::unique_ptr<valijson::Schema>> loaded;
  auto& schema = loaded[schema_path];
  if (!schema) schema = load(schema_path);
  const nlohmann::json document = nlohmann::json::parse(text);
  valijson::ValidationResults results;
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  std::vector<std::string> errors;
  if (validator.validate(*schema, Adapter(document), &results)) return errors;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    std::string place;
    for (const std::string& part : error.context) place += part;
    errors.push_back(place + ": " + error.description);
  }
  if (errors.empty()) errors.emplace_back("does not conform");
  return errors;
}

}  // namespace ssphh::test

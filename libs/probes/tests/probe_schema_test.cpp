/// The reader and schemas/probes.schema.json must accept and reject the same documents.

#include <gmock/gmock.h>

#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>

#include "json_schema.h"
#include "json_text.h"
#include "places.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

using test::random_set;

std::vector<std::string> errors_of(const std::string& document) {
  return test::schema_errors(test::source_dir() / "schemas/probes.schema.json", document);
}

bool reader_accepts(const std::string& document) {
  try {
    probes_from_json(document, "file");
    return true;
  } catch (const Error&) {
    return false;
  }
}

const json::Value valid_document() {
  ProbeSet set = random_set(42, 2, 1, 2, true);
  hier(set, {HierOperator::mean, 2, 0.1f});
  set.fitted = test::random_fitted(7, 3, 2);
  set.surface = test::random_records(8, 2, 2);
  set.surface->direct = {set.surface->groups[1], {}};
  set.baseline = test::random_baseline(9, 3, 2, 2);
  std::swap(set.fitted->weights[0], set.fitted->weights[2]);  // the first point has two probes
  return test::parse_json(probes_to_json(set));
}

TEST(ProbeSchema, EverythingWeWriteConforms) {
  for (int degree = 0; degree <= 10; ++degree) {
    EXPECT_THAT(errors_of(probes_to_json(random_set(1, 2, degree))), testing::IsEmpty()) << degree;
  }
  EXPECT_THAT(errors_of(probes_to_json(random_set(1, 0, 3, 0))), testing::IsEmpty());
  EXPECT_THAT(errors_of(print(valid_document())), testing::IsEmpty());
}

/// The value that a JSON pointer (RFC 6901, without escapes) leads to; a member that is not there is added.
json::Value& at(json::Value& document, std::string_view pointer) {
  json::Value* value = &document;
  while (!pointer.empty()) {
    const std::string_view rest = pointer.substr(1), part = rest.substr(0, rest.find('/'));
    value = value->is_array() ? &(*value)[std::stoul(std::string(part))] : &(*value)[part];
    pointer.remove_prefix(1 + part.size());
  }
  return *value;
}

struct Mutation {
  const char* pointer;
  json::Value value;
};

TEST(ProbeSchema, SchemaAndReaderRejectTheSameMutations) {
  const json::Value nine_numbers = json::Value::array({0, 0, 0, 0, 0, 0, 0, 0, 0});
  const std::vector<Mutation> mutations = {
      {"/format", "probes"},
      {"/version", 1},
      {"/version", 8},
      {"/light_groups/0/mode", "bakd"},
      {"/version", "5"},
      {"/degree", 11},
      {"/degree", -1},
      {"/degree", 1.5},
      {"/degree", 2},
      {"/generator", nullptr},
      {"/generator/operator", "photons"},
      {"/generator/operator", 0},
      {"/generator/directions", -1},
      {"/generator/directions", 0.5},
      {"/generator/surfel_size", -0.1},
      {"/generator/link_rays", 1e9},
      {"/generator/viz", "photons"},
      {"/generator/viz", 1},
      {"/generator/viz_source", "photons"},
      {"/generator/viz_paths", 1},
      {"/generator/viz_max_depth", 70000},
      {"/generator/viz_passes", 0},
      {"/generator/viz_spp", 0.5},
      {"/generator/gen", "half"},
      {"/generator/max_depth", -1},
      {"/generator/passes", 0},
      {"/generator/spp", 1e9},
      {"/generator/face_size", 100000},
      {"/generator/seed", 5},
      {"/generator/seed", ""},
      {"/generator/seed", "00000000000000000"},
      {"/generator/seed", "F"},
      {"/generator/scene", 1},
      {"/generator/scene", std::string(1025, 'x')},
      {"/generator/scene_hash", "0123"},
      {"/generator/scene_hash", std::string(32, 'g')},
      {"/generator/time", "0"},
      {"/generator/time", 2e9},
      {"/generator/extra", 1},
      {"/extra", 1},
      {"/light_groups", json::Value::object()},
      {"/light_groups/0/name", nullptr},
      {"/light_groups/0/scale", json::Value::array({1, 1})},
      {"/light_groups/0/scale/1", -1},
      {"/light_groups/0/extra", 1},
      {"/probes", nullptr},
      {"/probes/0", 3},
      {"/probes/0/name", 1},
      {"/probes/0/position", json::Value::array({1, 2, 3, 4})},
      {"/probes/0/position/2", 1e10},
      {"/probes/0/radius", 0},
      {"/probes/0/radius", -1},
      {"/probes/0/groups/0/reflected", json::Value::array()},
      {"/probes/0/groups/0/reflected", nine_numbers},
      {"/probes/0/groups/0/reflected/4", "x"},
      {"/probes/0/groups/0/reflected/4", 1e31},
      {"/probes/0/groups/0/emitted", nine_numbers},
      {"/probes/0/groups/0/emitted", nullptr},
      {"/probes/0/groups/1", json::Value::array()},
      {"/probes/0/edges", 0},
      {"/probes/0/edges/0/from", -1},
      {"/probes/0/edges/0/from", 0.5},
      {"/probes/0/edges/0/transfer", 1e31},
      {"/probes/0/edges/0/transfer", -0.01},
      {"/probes/0/edges/0/h", nine_numbers},
      {"/probes/0/edges/0/matrix", nine_numbers},
      {"/probes/0/edges/0/extra", 1},
      {"/probes/0/neighbor", nine_numbers},
      {"/probes/0/extra", 1},
      {"/fitted", nullptr},
      {"/fitted/0", 3},
      {"/fitted/0/extra", 1},
      {"/fitted/0/position/1", 1e10},
      {"/fitted/0/position", json::Value::array({1, 2})},
      {"/fitted/0/normal/0", 3},
      {"/fitted/0/normal", json::Value::array()},
      {"/fitted/0/probes/0", -1},
      {"/fitted/0/probes/0", 0.5},
      {"/fitted/0/probes", json::Value(std::vector<int>(17, 0))},
      {"/fitted/0/weights/0", -0.1},
      {"/fitted/0/weights/0", 1e7},
      {"/fitted/0/weights/0", "1"},
      {"/surface", nullptr},
      {"/surface/0", 3},
      {"/surface/0/extra", 1},
      {"/surface/1/position/1", 1e10},
      {"/surface/1/normal/0", 3},
      {"/surface/0/groups/0/0", -0.1},
      {"/surface/0/groups/0/0", 1e31},
      {"/surface/0/groups/1/3", 0.5},
      {"/surface/0/groups/1/9", 32768},
      {"/surface/0/groups/1/9", -32768},
      {"/surface/0/direct", nullptr},
      {"/surface/0/direct/0/0", -0.1},
      {"/surface/0/direct/0/9", 32768},
      {"/surface/0/groups/0", json::Value(std::vector<int>(9, 0))},
      {"/surface/0/groups/0", json::Value(std::vector<int>(11, 0))},
      {"/baseline", nullptr},
      {"/baseline/extra", 1},
      {"/baseline/neighbors", -2},
      {"/baseline/threshold", -1.5},
      {"/baseline/records", -1},
      {"/baseline/surfels", -1},
      {"/baseline/items/0/kind", "camera"},
      {"/baseline/items/0/extra", 1},
      {"/baseline/items/1/name", 3},
      {"/baseline/items/1/shape", "12"},
      {"/baseline/items/2/emission", nullptr},
      {"/baseline/trials", nullptr},
      {"/baseline/trials/0", 3},
      {"/baseline/trials/1/0/1", json::Value(std::vector<int>(26, 0))},
      {"/baseline/trials/1/0/1/5", 1e31},
      {"/baseline/trials/1", json::Value::array()},
      {"/hierarchy", nullptr},
      {"/hierarchy/operator", "tensor"},
      {"/hierarchy/neighbors", -2},
      {"/hierarchy/threshold", -2},
  };
  for (const Mutation& mutation : mutations) {
    json::Value document = valid_document();
    at(document, mutation.pointer) = mutation.value;
    const std::string text = print(document);
    EXPECT_FALSE(reader_accepts(text)) << mutation.pointer << " = " << print(mutation.value);
    EXPECT_FALSE(errors_of(text).empty()) << mutation.pointer << " = " << print(mutation.value);
  }
}

void collect_keys(const json::Value& value, const std::string& pointer, std::vector<std::string>& out) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.members()) {
      out.push_back(pointer + "/" + key);
      collect_keys(child, pointer + "/" + key, out);
    }
  } else if (value.is_array() && !value.empty() && value[0].is_object()) {
    collect_keys(value[0], pointer + "/0", out);
  }
}

TEST(ProbeSchema, SchemaAndReaderAgreeOnEveryMissingKey) {
  const json::Value document = valid_document();
  std::vector<std::string> keys;
  collect_keys(document, "", keys);
  ASSERT_GT(keys.size(), 25u);
  int optional = 0;
  for (const std::string& key : keys) {
    json::Value without = document;
    const std::size_t end = key.rfind('/');
    at(without, key.substr(0, end)).erase(key.substr(end + 1));
    const bool conforms = errors_of(print(without)).empty();
    EXPECT_EQ(conforms, reader_accepts(print(without))) << key;
    optional += conforms;
  }
  EXPECT_EQ(optional, 5)
      << "only an edge's matrix, fitted points, records, their direct light and a baseline may be "
         "missing; a hierarchy needs the neighbours' parts and they it";
}

TEST(ProbeSchema, SchemaAndReaderAcceptOtherSpellingsOfTheSame) {
  json::Value document = valid_document();
  document["hierarchy"]["neighbors"] = -1;
  document["generator"]["seed"] = "00ff";
  document["probes"][0]["edges"] = json::Value::array();
  EXPECT_THAT(errors_of(print(document)), testing::IsEmpty());
  EXPECT_TRUE(reader_accepts(print(document)));
}

TEST(ProbeSchema, RulesBeyondTheSchemaAreTheReadersAlone) {
  // Relations between parts of a document (docs/probe-files.md): the schema cannot state them.
  const std::vector<Mutation> mutations = {
      {"/probes/0/edges/0/from", 0},  // itself
      {"/probes/0/edges/0/from", 2},  // no such probe
      {"/light_groups", json::Value::array()},
      {"/fitted/0/probes/0", 2},                      // no such probe
      {"/fitted/0/probes", json::Value::array({0})},  // two weights
      {"/fitted/0/normal", json::Value::array({1, 1, 0})},
      {"/surface/0/groups", json::Value::array()},  // of no light group
      {"/surface/0/direct", json::Value::array()},
      {"/surface/0/direct/0", json::Value(std::vector<int>(9, 0))},
      {"/baseline/trials", json::Value::array({json::Value::array()})},  // of one probe
      {"/baseline/trials/0/1", json::Value::array()},
      {"/surface/0/normal", json::Value::array({1, 1, 0})},
      {"/probes/0/name", std::string(1024, 'x') + "\u00fc"},
  };
  for (const Mutation& mutation : mutations) {
    json::Value document = valid_document();
    at(document, mutation.pointer) = mutation.value;
    EXPECT_FALSE(reader_accepts(print(document))) << mutation.pointer;
  }
}

}  // namespace
}  // namespace ssphh::probes

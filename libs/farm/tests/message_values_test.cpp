/// Every number, text and list of every kind of message: which are taken, and what is said of those around
/// them.

#include <functional>

#include <gtest/gtest.h>

#include <ssphh/core/json.h>
#include <ssphh/farm/job_codec.h>

#include "error_message.h"
#include "expected_text.h"
#include "job_fields.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;

/// What limits may be, and the numbers beside them.
std::vector<json::Value> ladder(bool whole) {
  if (!whole) return {-1e39, -1, 0, 0.5, 1, 2, 3e38, 1e39};
  std::vector<json::Value> numbers = {-1e39, -2, -1, 0, 0.5, 1, 2, 3, 4, 5, 6, 10, 11, 12};
  for (const int power : {4, 6, 8, 10, 12, 14, 16, 20, 22, 24, 28, 31, 32, 36, 40, 44}) {
    const std::int64_t limit = std::int64_t{1} << power;
    for (const std::int64_t number : {limit - 1, limit, limit + 1, limit + limit / 8})
      numbers.emplace_back(number);
  }
  numbers.emplace_back(INT64_MAX);
  for (const double large : {1e20, 3e38, 1e39}) numbers.emplace_back(large);
  return numbers;
}

struct Place {
  std::string path;
  json::Value* value;
};

/// What a list or an object holds comes before it: it is gone when its holder has been another.
void add_places(const std::string& path, json::Value& value, std::vector<Place>& places) {
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      add_places(path + "[" + std::to_string(i) + "]", value[i], places);
  } else if (value.is_object()) {
    for (const auto& [name, unused] : value.members()) add_places(path + "." + name, value[name], places);
  }
  places.push_back({path, &value});
}

/// One line for each run of values of which the same is said.
class Said {
 public:
  explicit Said(std::function<std::string()> read) : read_(std::move(read)) {}

  void tell(const std::string& value) {
    std::string said = read_();
    // Which value it was, the line says
    for (const char* end : {" ", ";"}) {
      if (const std::size_t at = said.find(value + end); at != said.npos)
        said.replace(at, value.size(), "it");
    }
    if (said != last_) lines_ += (lines_.empty() ? "  " : " … " + before_ + "\n  ") + said + ": " + value;
    last_ = said, before_ = value;
  }
  std::string text() const { return lines_ + " … " + before_ + "\n"; }

 private:
  std::function<std::string()> read_;
  std::string lines_, last_ = "nothing yet", before_;
};

template <class Read>
std::string values_of(const std::string& message, const Read& read) {
  json::Value document = json::parse(message, "message");
  std::vector<Place> places;
  add_places("", document, places);
  std::string text;
  for (const Place& place : places) {
    const json::Value before = *place.value;
    Said said([&] { return message_of([&] { read(json::print(document)); }); });
    const auto tell = [&](const json::Value& value, const std::string& name) {
      *place.value = value;
      said.tell(name);
    };
    if (before.is_number()) {
      for (const json::Value& number : ladder(before.is_integer())) tell(number, json::print(number));
    } else if (before.is_string()) {
      tell("", "\"\"");
      for (const std::size_t length : {1, 16, 31, 32, 33, 64})
        tell(std::string(length, 'x'), std::to_string(length));
    } else if (before.is_boolean()) {
      tell(!before.boolean(), "the other");
    } else if (before.is_array() && before.size() > 0) {
      tell(json::Value::array(), "none");
      json::Value more = before;
      more.push_back(before[before.size() - 1]);
      tell(more, "the last twice");
    }
    tell(nullptr, "null");
    *place.value = before;
    text += place.path + "\n" + said.text();
  }
  return text;
}

void expect_values(const std::string& name, const std::string& text) {
  ssphh::test::expect_text_of("libs/farm/tests/expected/" + name + ".txt", text);
}

TEST(MessageValues, OfJobs) {
  const auto read = [](const std::string& body) { decode_job(body); };
  for (const auto& [name, stage] :
       {std::pair("gen-job", bake::BakeStage::gen), {"viz-job", bake::BakeStage::viz}}) {
    ProbeJob job = test::some_probe_job(stage);
    job.probes = {0, 2};
    if (stage == bake::BakeStage::gen) job.places.pop_back();
    expect_values(name, values_of(encode_job(job, ContentType::json), read));
  }
  TileJob job = test::some_tile_job();
  expect_values("ref-job", values_of(encode_job(job, ContentType::json), read));
}

TEST(MessageValues, OfResults) {
  const auto read = [](const std::string& body) { decode_result(body); };
  const auto expect = [&](const std::string& name, auto data) {
    const JobResult result{data, {1.5, 7, "w"}};
    expect_values(name, values_of(encode_result(result, ContentType::json), read));
  };
  sh::RadianceSh light(0);
  light[0] = vec3(1, 2, 3);
  expect(
      "gen-result",
      ProbeJobResult{
          bake::BakeStage::gen, 0, {{{bake::BakeStage::gen, 3}, 0.5, 6, {{light, light}, {{}, light}}, {}}}});
  probes::Edge edge{2, 0.25f, light, sh::TransferMatrix(0, 0)};
  edge.matrix.values = light.values;
  expect("viz-result",
         ProbeJobResult{bake::BakeStage::viz, 0, {{{bake::BakeStage::viz, 5}, 0.5, 6, {}, {edge}}}});
  TileResult tile{{1, 2, 2, 1}, {}};
  tile.state.passes_done = 3, tile.state.paths = 4, tile.state.rays = 5;
  tile.state.color = image::Image(2, 1), tile.state.depth = image::Image(2, 1, 1);
  tile.state.groups = {image::Image(2, 1)};
  expect("ref-result", TileJobResult{{tile}});
}

}  // namespace
}  // namespace ssphh::farm

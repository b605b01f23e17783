#include "results/lookup_figures.h"

#include <fmt/format.h>

#include "results/json_values.h"

namespace ssphh::app {
namespace {

using study::RelativeError;

constexpr std::pair<const char*, double RelativeError::*> figures[] = {
    {"mean_truth", &RelativeError::mean_truth},
    {"ratio", &RelativeError::ratio},
    {"mean_error", &RelativeError::mean_error},
    {"mean_relative", &RelativeError::mean_relative},
    {"median_relative", &RelativeError::median_relative},
    {"p95_relative", &RelativeError::p95_relative},
    {"noise", &RelativeError::noise},
    {"relmse", &RelativeError::relmse}};

json::Value to_json(const RelativeError& error) {
  json::Value object = json::Value::object();
  for (const auto& [name, figure] : figures) object[name] = finite_or_null(error.*figure);
  return object;
}

}  // namespace

json::Value to_json(const study::LookupError& error) {
  json::Value object = {{"points", error.points}};
  for (const auto& [name, figure] : figures) {
    json::Value& list = object[name] = json::Value::array();
    for (const RelativeError& channel : error.channels) list.push_back(finite_or_null(channel.*figure));
  }
  object["luminance"] = to_json(error.luminance);
  object["worst"] = to_json(study::worst_channel(error));
  const study::ChromaticityError& c = error.chromaticity;
  object["chromaticity"] = {
      {"mean_error", c.mean_error}, {"mean", c.mean}, {"p95", c.p95}, {"noise", c.noise}};
  return object;
}

std::string ratio_columns(const study::LookupError& error) {
  std::string text;
  for (const RelativeError& channel : error.channels) text += fmt::format(" {:>6.3f}", channel.ratio);
  return text;
}

}  // namespace ssphh::app

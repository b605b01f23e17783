#include "options/farm_options.h"

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::app {

Option add_broker_options(Command command, BrokerChoice& choice, const std::string& key) {
  choice.key = key;
  Option broker = command.option("--broker", choice.endpoint, "The farm's broker, e.g. tcp://127.0.0.1:5555");
  command
      .option("--keys", choice.keys,
              "Folder with broker.pub and NAME.key (`ssphh farm keygen`); wanted beyond loopback and ipc")
      .settable();
  command.option("--key", choice.key, "Name of the own key in --keys");
  return broker;
}

void add_required_broker(Command command, BrokerChoice& choice, const std::string& key) {
  add_broker_options(command, choice, key).required().settable();
}

farm::BrokerAddress broker_address(const BrokerChoice& choice) {
  farm::BrokerAddress address{choice.endpoint, std::nullopt};
  if (!choice.keys.empty()) address.security = majordomo::read_peer_security(choice.keys, choice.key);
  majordomo::require_keys(address.endpoint, address.security.has_value(), "--keys");
  return address;
}

void add_farm_options(Command command, FarmChoice& choice) {
  const Command shared = command.under("Farm: the same file, bit by bit, made by many machines");
  Option broker = add_broker_options(shared, choice.broker, "client");
  shared
      .option("--local", choice.local, "Start a broker and so many workers on this machine for this command")
      .range(1, 1024)
      .excludes(broker);
  shared.option("--cache", choice.cache,
                "Folder of finished results, which need not be computed again; none: keep none; default: " +
                    farm::default_cache_dir("results").string());
  shared.option("--cache-size", choice.cache_mb, "Of --cache, MB").range(1, 1 << 30);
  shared.option("--keep-messages", choice.messages,
                "Folder that gets every job and result, sent as JSON (docs/protocol-jobs.md); results from "
                "--cache are not sent");
}

FarmSession::FarmSession(const FarmChoice& choice) {
  if (choice.local > 0) {
    farm::LocalFarmOptions local;
    local.tool = choice.tool;
    local.workers = choice.local;
    local.renderer = choice.renderer;
    local.cache = farm::default_cache_dir("scenes");
    local_ = std::make_unique<farm::LocalFarm>(local);
    options_.broker = local_->address();
    options_.failure = [farm = local_.get()] { return farm->failure(); };
  } else {
    options_.broker = broker_address(choice.broker);
  }
  options_.renderer = choice.renderer;
  options_.messages = choice.messages;
  if (!choice.messages.empty()) options_.content = farm::ContentType::json;
  if (const std::optional<ResultCache> cache = result_cache(choice)) {
    results_ = std::make_unique<farm::DiskCache>(cache->folder, cache->bytes);
    options_.results = results_.get();
  }
}

std::optional<ResultCache> result_cache(const FarmChoice& choice) {
  if (choice.cache == "none") return std::nullopt;
  const std::filesystem::path chosen = choice.cache;
  return ResultCache{chosen.empty() ? farm::default_cache_dir("results") : chosen, choice.cache_mb << 20};
}

std::optional<FarmSession> farm_session(const FarmChoice& choice) {
  if (!choice.any() && !choice.messages.empty())
    throw Error("--keep-messages", "without a farm nothing is sent", "add --local 1 or --broker");
  return choice.any() ? std::make_optional<FarmSession>(choice) : std::nullopt;
}

json::Value farm_json(const farm::FarmReport& report) {
  return {{"jobs", report.jobs},       {"retries", report.retries},
          {"units", report.units},     {"cached", report.cached},
          {"workers", report.workers}, {"compute_seconds", report.compute_seconds},
          {"seconds", report.seconds}};
}

std::string farm_text(const farm::FarmReport& report) {
  std::string text =
      fmt::format("farm: {}, {}, {:.2f} s of computing in {:.2f} s", counted(report.jobs, "job"),
                  counted(report.workers, "worker"), report.compute_seconds, report.seconds);
  if (report.cached > 0)
    text +=
        fmt::format("; {} of {} known", report.cached, counted(report.units, "result was", "results were"));
  if (report.retries > 0) text += "; " + counted(report.retries, "retry", "retries");
  return text;
}

}  // namespace ssphh::app

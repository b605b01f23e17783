#include <nlohmann/json.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/cache.h>

#include "words.h"

namespace ssphh::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* record_name = "run.json";
constexpr const char* result_name = "stdout";

}  // namespace

std::optional<JobRecord> find_run(const fs::path& cache, const std::string& key, const std::string& build) {
  const fs::path folder = cache / key;
  std::error_code ignored;
  if (!fs::is_regular_file(folder / record_name, ignored)) return std::nullopt;
  const ordered_json json = ordered_json::parse(read_text_file(folder / record_name), nullptr, false);
  JobRecord record;
  try {
    record.command = json.at("command");
    record.build = json.at("build");
    record.machine = json.at("machine");
    record.started = json.at("started");
    record.seconds = json.at("seconds");
    record.cpu_seconds = json.at("cpu_seconds");
    record.peak_bytes = json.at("peak_bytes");
    for (const auto& [name, bytes] : json.at("files").items()) {
      if (fs::file_size(folder / name, ignored) != bytes.get<std::uint64_t>()) return std::nullopt;
      record.files[name] = bytes;
    }
    record.result = read_text_file(folder / result_name);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  if (!build.empty() && record.build != build) return std::nullopt;
  return record;
}

void keep_run(const fs::path& cache, const Job& job, const fs::path& work, JobRecord record) {
  for (const std::string& output : job.outputs) {
    if (!fs::exists(work / output)) throw Error(output, "was not written by " + join_words(job.words));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(work)) {
    if (entry.is_regular_file()) record.files[entry.path().filename().string()] = entry.file_size();
  }
  const ordered_json json = {{"key", job.key},
                             {"command", join_words(job.words)},
                             {"build", record.build},
                             {"machine", record.machine},
                             {"started", record.started},
                             {"seconds", record.seconds},
                             {"cpu_seconds", record.cpu_seconds},
                             {"peak_bytes", record.peak_bytes},
                             {"files", record.files}};
  write_file(work / record_name, json.dump(2) + "\n");
  fs::remove_all(cache / job.key);
  fs::rename(work, cache / job.key);
}

}  // namespace ssphh::report

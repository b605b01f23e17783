#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/report/cache.h>

#include "command_words.h"

namespace ssphh::report {
namespace {

namespace fs = std::filesystem;
constexpr const char* record_name = "run.json";
constexpr const char* result_name = "stdout";

}  // namespace

std::optional<JobRecord> find_run(const fs::path& cache, const std::string& key, const std::string& build) {
  const fs::path folder = cache / key;
  std::error_code ignored;
  if (!fs::is_regular_file(folder / record_name, ignored)) return std::nullopt;
  JobRecord record;
  try {
    const std::string file = (folder / record_name).string();
    const json::Value document = json::parse(read_text_file(file), file);
    const json::Cursor at(document, file);
    record.command = at["command"].text();
    record.build = at["build"].text();
    record.machine = at["machine"].text();
    record.started = at["started"].text();
    record.seconds = at["seconds"].precise_number();
    record.cpu_seconds = at["cpu_seconds"].precise_number();
    record.peak_bytes = at["peak_bytes"].unsigned_integer();
    for (const auto& [name, unused] : at["files"].entries()) {
      const std::uint64_t bytes = at["files"][name.c_str()].unsigned_integer();
      if (fs::file_size(folder / name, ignored) != bytes) return std::nullopt;
      record.files[name] = bytes;
    }
    record.result = read_text_file(folder / result_name);
  } catch (const Error&) {
    return std::nullopt;
  }
  if (!build.empty() && record.build != build) return std::nullopt;
  return record;
}

namespace {

/// Nothing but a run's own folder is ever replaced.
bool is_key(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

void keep_run(const fs::path& cache, const Job& job, const fs::path& work, JobRecord record) {
  if (!is_key(job.key)) throw Error("run \"" + job.key + "\"", "has no key of 32 hexadecimal digits");
  std::error_code error;
  fs::directory_iterator entries(work, error);
  if (error) throw Error(work.string(), "holds no run: " + error.message());
  for (const std::string& output : job.outputs) {
    if (!fs::exists(work / output)) throw Error(output, "was not written by " + join_words(job.words));
  }
  for (const fs::directory_entry& entry : entries) {
    if (entry.is_regular_file() && entry.path().filename() != record_name)
      record.files[entry.path().filename().string()] = entry.file_size();
  }
  const json::Value document = {{"key", job.key},
                                {"command", join_words(job.words)},
                                {"build", record.build},
                                {"machine", record.machine},
                                {"started", record.started},
                                {"seconds", record.seconds},
                                {"cpu_seconds", record.cpu_seconds},
                                {"peak_bytes", record.peak_bytes},
                                {"files", record.files}};
  write_file(work / record_name, json::print(document, 2) + "\n");
  fs::remove_all(cache / job.key, error);
  fs::rename(work, cache / job.key, error);
  if (error) throw Error((cache / job.key).string(), "cannot be kept: " + error.message());
}

}  // namespace ssphh::report

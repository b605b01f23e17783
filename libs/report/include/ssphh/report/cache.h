#pragma once
/// Finished runs on disk: one folder per key with the outputs, the command's JSON result, its log and a
/// record. A folder appears by renaming, so it is whole or not there.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <ssphh/report/expansion.h>

namespace ssphh::report {

/// What is known of a finished run.
struct JobRecord {
  std::string command;         ///< as a shell would take it; outputs by bare names, earlier ones as @KEY/NAME
  std::string build, machine;  ///< hash of the tool's executable; processor and number of its threads
  std::string started;         ///< UTC, ISO 8601
  double seconds = 0;          ///< wall time of the process
  double cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;                ///< largest resident set
  std::map<std::string, std::uint64_t> files;  ///< bytes of every output
  std::string result;                          ///< the JSON object that the command printed
};

/// The record of a finished run. None when there is no such folder, when its record or a file is not as it
/// was written, or (unless `build` is empty) when another build of the tool made it.
std::optional<JobRecord> find_run(const std::filesystem::path& cache, const std::string& key,
                                  const std::string& build);

/// Writes the record into `work` (where the run left its outputs and "stdout") and renames the folder to its
/// key, replacing what is there. Throws Error for a job without a key, without its outputs, and for folders
/// that are none.
void keep_run(const std::filesystem::path& cache, const Job& job, const std::filesystem::path& work,
              JobRecord record);

}  // namespace ssphh::report

#pragma once
/// Work in many units, done by whatever workers a broker has.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/farm/blob_server.h>
#include <ssphh/farm/disk_cache.h>
#include <ssphh/farm/job_codec.h>

namespace ssphh::farm {

struct FarmOptions {
  BrokerAddress broker;
  ContentType content = ContentType::binary;
  Renderer renderer = Renderer::path;  ///< that does jobs of probes: workers that have it are asked
  double job_seconds = 1.5;            ///< aimed at for one job
  DiskCache* results = nullptr;        ///< finished units are kept and found here; must outlive the work
  /// Folder in which every job and its result is kept, as sent: NNNN.job.json and NNNN.result.json (.bin
  /// where `content` is binary); empty: none.
  std::filesystem::path messages = {};
  /// Why no job will be done any more, told where somebody knows; an empty text: jobs are done. Asked again
  /// and again; empty: nobody knows.
  std::function<std::string()> failure = {};
  double patience = 5;  ///< seconds without a result after which it says once what it waits for
};

/// What spread work took.
struct FarmReport {
  std::uint64_t jobs = 0, retries = 0;  ///< retries: attempts beyond a job's first
  std::uint64_t units = 0, cached = 0;  ///< cached: units that the result cache had
  int workers = 0;                      ///< most that were seen at one time
  double compute_seconds = 0;           ///< of all workers together
  double seconds = 0;
};

/// Units 0..count−1 of one kind of job.
struct UnitGroup {
  std::size_t count = 0;
  /// Body of the job that does these units.
  std::function<std::string(std::span<const std::size_t> units)> body;
  /// Takes the result; throws Error for one that does not answer the job.
  std::function<void(std::span<const std::size_t> units, JobResult result)> done;
  std::size_t most_per_job = 1024;
};

/// Does all units of all groups, the first group first. `finished(units)` is told after each job. Throws
/// Cancelled, and Error with the reason when a job has failed for good; jobs under way are cancelled then.
void dispatch(const FarmOptions& options, const std::vector<UnitGroup>& groups, FarmReport& report,
              const std::function<void(std::size_t units, const FarmReport&)>& finished,
              const Control& control);

}  // namespace ssphh::farm

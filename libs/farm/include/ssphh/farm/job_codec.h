#pragma once
/// Jobs and results as bytes: JSON (schemas/farm-job.schema.json, schemas/farm-result.schema.json), or the
/// same document with its float arrays as raw floats behind it (docs/protocol-jobs.md). Both keep every bit.

#include <string>
#include <string_view>

#include <ssphh/farm/job.h>

namespace ssphh::farm {

enum class ContentType { json, binary };

/// Told from the first bytes.
ContentType content_type(std::string_view body);

std::string encode_job(const Job& job, ContentType type);
/// Throws Error naming the place for anything but a valid job of a version that this program reads.
Job decode_job(std::string_view body);

std::string encode_result(const JobResult& result, ContentType type);
/// Reads a result as decode_job() reads a job. Sizes are checked against the bytes that are there before
/// memory is taken.
JobResult decode_result(std::string_view body);

inline constexpr int job_version = 2;
inline constexpr std::size_t max_json_bytes = std::size_t{32} << 20;  ///< of a document, without raw floats

}  // namespace ssphh::farm

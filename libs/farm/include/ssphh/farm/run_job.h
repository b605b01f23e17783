#pragma once
/// What a worker does.

#include <ssphh/farm/job.h>
#include <ssphh/farm/scene_store.h>

namespace ssphh::farm {

/// The job's result, on all threads. Throws Error for a job that cannot be done anywhere, BlobUnavailable
/// when another worker may, Cancelled.
JobResult run_job(const Job& job, SceneStore& scenes, const FetchChunk& fetch, const Control& control = {});

}  // namespace ssphh::farm

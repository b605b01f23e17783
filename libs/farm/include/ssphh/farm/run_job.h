#pragma once
/// What a worker does.

#include <ssphh/farm/job.h>
#include <ssphh/farm/scene_store.h>

namespace ssphh::farm {

/// Another renderer's light of a scene, as a source for one job of probes.
using MakeSource =
    std::function<std::unique_ptr<rays::RadianceSource>(const PreparedScene& scene, float time)>;

/// The renderer that a worker has, beside this program's own.
struct OtherRenderer {
  Renderer renderer = Renderer::path;
  MakeSource make = {};
};

/// The job's result, on all threads. Throws Error for a job that cannot be done anywhere, and for one of a
/// renderer that is not `other`; BlobUnavailable when another worker may, Cancelled.
JobResult run_job(const Job& job, SceneStore& scenes, const FetchChunk& fetch, const Control& control = {},
                  const OtherRenderer& other = {});

}  // namespace ssphh::farm

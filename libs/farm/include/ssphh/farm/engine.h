#pragma once
/// Which programs compute the same bits. Only they serve each other's jobs: the id is part of the service's
/// name, so that a client and a worker of different builds never meet.

#include <string>

#include <ssphh/core/hash.h>
#include <ssphh/farm/job.h>

namespace ssphh::farm {

/// 16 hexadecimal digits: a digest of the sources of everything that computes, the compiler and its options,
/// and of a small scene traced on this machine, for the maths library and Embree choose code by CPU. The
/// first call traces (milliseconds).
const std::string& engine_id();

/// MDP service that does the jobs of this engine: "ssphh.jobs.ENGINE", and those that another renderer does
/// "ssphh.jobs.ENGINE.cycles".
std::string job_service(Renderer renderer = Renderer::path);
/// MDP service by which a client hands out a scene's parts: "ssphh.blobs.PACKAGE".
std::string blob_service(const Hash128& package);

}  // namespace ssphh::farm

#pragma once
/// Batches of rays.

#include <ssphh/core/parallel.h>

#include "rays.h"
#include "shared_count.h"

namespace ssphh::trace {

/// Calls body(begin, end, task) over [0, count), in parallel where that pays, and books the rays.
template <class Body>
void for_rays(std::size_t count, SharedCount& rays, const Body& body) {
  constexpr std::size_t many_rays = 1024, rays_at_once = 256;
  const auto range = [&](std::size_t begin, std::size_t end) {
    RayTask task;
    body(begin, end, task);
    rays.add(task.rays);
  };
  if (count < many_rays) {
    range(0, count);
  } else {
    parallel_for(count, rays_at_once, range);
  }
}

}  // namespace ssphh::trace

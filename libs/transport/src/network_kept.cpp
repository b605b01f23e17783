#include <algorithm>

#include "network_data.h"

namespace ssphh::transport {

bool TransportNetwork::Data::recall_pose() {
  if (!kept.find(poses)) return false;
  const KeptPoses::Pose pose = kept.current();
  std::ranges::copy(pose.sample_used, sample_used.begin());
  mixed_hits.clear();
  for (std::size_t i = 0; i < moving_hits.size(); ++i) {
    const std::uint32_t owner = moving_hits[i].owner;
    pose_work.report.hits_changed += SeenPatch{pose.hits[i].patch, pose.hits[i].albedo} != seen[owner];
    set_hit(owner, pose.hits[i]);
  }
  pose_work.report.rays_near_parts += moving_hits.size();
  for (std::size_t i = 0; i < moving_mirrored.size(); ++i)
    seen_mirrored[moving_mirrored[i].owner].patch = pose.mirrored[i];
  pose_work.target.resize(pose.links.size());
  pose_work.counted.resize(pose.links.size());
  pose_work.lost.resize(pose.links.size());
  for (std::size_t i = 0; i < pose.links.size(); ++i) {
    pose_work.target[i] = pose.links[i].patch;
    pose_work.counted[i] = pose.links[i].counted;
    pose_work.lost[i] = pose.links[i].lost;
  }
  return true;
}

void TransportNetwork::Data::keep_pose() {
  if (!kept.take({.parts = poses.size(),
                  .samples = sample_used.size(),
                  .hits = moving_hits.size(),
                  .mirrored = moving_mirrored.size(),
                  .links = pose_work.target.size()}))
    return;
  const KeptPoses::Pose pose = kept.current();
  std::ranges::copy(poses, pose.parts.begin());
  std::ranges::copy(sample_used, pose.sample_used.begin());
  for (std::size_t i = 0; i < moving_hits.size(); ++i) {
    const std::uint32_t owner = moving_hits[i].owner;
    pose.hits[i] = {seen[owner].index, seen[owner].albedo,
                    seen_emission.empty() ? std::uint16_t{0} : seen_emission[owner], seen_distance[owner]};
  }
  for (std::size_t i = 0; i < moving_mirrored.size(); ++i)
    pose.mirrored[i] = seen_mirrored[moving_mirrored[i].owner].patch;
  for (std::size_t i = 0; i < pose.links.size(); ++i)
    pose.links[i] = {pose_work.target[i], pose_work.counted[i], pose_work.lost[i]};
}

}  // namespace ssphh::transport

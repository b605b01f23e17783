#pragma once
/// Content hashes of what a scene consists of: neither names nor the numbers of things count, but for the
/// names of light groups.

#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::scene {

Hasher& add(Hasher& h, const vec2& v);
Hasher& add(Hasher& h, const vec3& v);
Hasher& add(Hasher& h, const quat& q);
Hasher& add(Hasher& h, const Hash128& hash);
Hash128 digest(const Texture& texture);
/// `textures` are the digests of the scene's.
Hash128 digest(const Material& material, const std::vector<Hash128>& textures);
Hash128 digest(const Mesh& mesh);
void add(Hasher& h, const Node& node);
void add(Hasher& h, const Camera& camera);
void add(Hasher& h, const Light& light);
void add(Hasher& h, const Sphl& sphl);
void add(Hasher& h, const AnimationChannel& channel);
void add(Hasher& h, const Environment& environment);

/// Of each node, where it stands and how it moves, whatever its number is.
std::vector<Hash128> node_digests(const Scene& scene);

}  // namespace ssphh::scene

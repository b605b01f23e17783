#pragma once

#include <string>

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// How errors name an object: 'mesh 3 "door"'.
std::string label(const char* kind, std::size_t index, const std::string& name);

/// The part of check_indices() for what poses a scene.
void check_nodes(const Scene& scene);

}  // namespace ssphh::scene

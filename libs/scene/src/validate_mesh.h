#pragma once

#include <ssphh/scene/scene.h>

#include "repairs.h"

namespace ssphh::scene {

/// The part of validate() for one mesh, whose indices are in range. `where` names it in errors.
void validate_mesh(Mesh& mesh, const std::string& where, Repairs& repairs);

}  // namespace ssphh::scene

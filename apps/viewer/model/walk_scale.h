#pragma once
/// How tall somebody is in scenes whose lengths are no metres.

#include "walk.h"

namespace ssphh::viewer {

/// The walker, or a taller one where floor and ceiling at the view are more than a hundred times as far apart
/// as its eye is high: nobody builds such a room, its lengths are millimetres.
Walker walker_in(const View& view, const Walker& walker, const rays::PosedWorld& world);

}  // namespace ssphh::viewer

#pragma once
/// GEN: the light that arrives at each probe, path traced and projected to spherical harmonics per light
/// group.

#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::bake {

/// S_i^g of one place, for every light group g of the source: cube maps of request.face_size² × 6 texels,
/// projected with exact texel solid angles. `emitted` is left empty where it is zero. Throws Error when the
/// source answers with a number that is not finite or with cube maps of another size or number.
std::vector<probes::GroupLight> gen(const rays::RadianceSource& source, const rays::CubeRequest& request,
                                    int degree, const Control& control = {});

}  // namespace ssphh::bake

#pragma once
/// Parts of a probe set as bytes, shared by the binary file and the checkpoint of a bake.

#include <ssphh/core/bytes.h>
#include <ssphh/gi/probe_set.h>

namespace ssphh::gi {

void write_sh(ByteWriter& out, const sh::RadianceSh& function);
/// `degree` as the set says; `may_be_empty` allows the empty (zero) function.
sh::RadianceSh read_sh(ByteReader& in, const char* what, int degree, bool may_be_empty);

void write_groups(ByteWriter& out, const std::vector<GroupLight>& groups);
std::vector<GroupLight> read_groups(ByteReader& in, int degree, std::size_t group_count);

void write_edges(ByteWriter& out, const std::vector<Edge>& edges);
/// Of probe `index` of `probe_count`; `from` must ascend and not be the probe itself.
std::vector<Edge> read_edges(ByteReader& in, int degree, std::size_t index, std::size_t probe_count);

void write_fitted(ByteWriter& out, const FittedPoints& fitted);
FittedPoints read_fitted(ByteReader& in, std::size_t probe_count);

}  // namespace ssphh::gi

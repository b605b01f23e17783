#include <optional>

#include <ssphh/methods/method_list.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/transport/session_sets.h>

#include "probe_volume/probe_volume.h"

namespace ssphh::methods::irradiance_volume {
namespace {

constexpr int irradiance_degree = 2;

/// Greger, Shirley, Hubbard & Greenberg, The Irradiance Volume, 1998, with spherical harmonics of degree 2
/// for irradiance (Ramamoorthi & Hanrahan 2001).
class IrradianceVolume final : public Method {
 public:
  IrradianceVolume(const MethodScene& scene, const MethodParameters& p, const Control& control)
      : volume_(scene, p, p.integer("degree"), control) {}

  void update(const scene::LightingState& state, const Control& control) override {
    volume_.update(state, -1, control);
    probes::LookupParams params;
    params.irradiance_degree = irradiance_degree;
    lookup_.emplace(transport::lookup_set(volume_.places(), volume_.radiance()), volume_.weights(), params);
  }

  const rays::IndirectLight& light() const override { return *lookup_; }

  sketch::Sketch drawing(Drawing what) const override { return volume_.drawing(what); }

  MethodMemory memory() const override {
    MethodMemory bytes = volume_.memory();
    // beside the radiance for glossy lookups, irradiance without negative values
    bytes.lookup += volume_.places().size() * sh::coefficient_count(irradiance_degree) * sizeof(vec3);
    return bytes;
  }
  MethodNumbers numbers() const override { return volume_.numbers(); }

 private:
  probe_volume::ProbeVolume volume_;
  std::optional<probes::IrradianceLookup> lookup_;
};

}  // namespace

MethodEntry entry() {
  std::vector<MethodParameter> parameters = probe_volume::probe_volume_parameters();
  parameters.push_back({"degree", 4, 2, 10, "of a probe's radiance, for glossy lookups", true});
  return {"irradiance-volume",
          "radiance probes interpolated within tetrahedra, without visibility",
          std::move(parameters),
          [](const MethodScene& scene, const MethodParameters& p, const Control& control)
              -> std::unique_ptr<Method> { return std::make_unique<IrradianceVolume>(scene, p, control); },
          false,
          {Drawing::tetrahedra, Drawing::surfels, Drawing::links}};
}

}  // namespace ssphh::methods::irradiance_volume

#pragma once
/// A relight session with the state of its next update, which tests change piece by piece.

#include <utility>

#include <ssphh/rays/transport_source.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::test {

struct LitSession : transport::RelightSession {
  LitSession(const rays::TransportSource& source, std::vector<scene::ProbePlace> places,
             const transport::RelightParams& params = {}, float time = 0)
      : RelightSession(source, std::move(places), params, time), state(lighting()) {}

  using RelightSession::update;
  transport::RelightReport update() { return update(state); }

  /// One probe shines, or no more.
  void shine(int probe, const sh::RadianceSh& leaving) {
    std::erase_if(state.emission, [&](const auto& given) { return given.probe == probe; });
    if (!leaving.empty()) state.emission.push_back({probe, leaving});
  }

  scene::LightingState state;
};

}  // namespace ssphh::test

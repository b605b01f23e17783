#pragma once
/// Methods of methods::all_methods() made for a scene in this process, with what they took.

#include <memory>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::pipeline {

/// Stays where it is made: its method looks at its source.
class LiveMethod {
 public:
  /// Bakes. `settings` as "name=value". Keeps a reference to the scene. Throws Error for unknown methods and
  /// settings.
  LiveMethod(const std::string& name, const std::vector<std::string>& settings,
             trace::SharedGeometry geometry, const scene::Scene& scene, const Control& control,
             bool keep_direct = false);
  LiveMethod(const std::string&, const std::vector<std::string>&, trace::SharedGeometry, const scene::Scene&&,
             const Control&, bool = false) = delete;  // it would be gone
  LiveMethod(const LiveMethod&) = delete;
  LiveMethod& operator=(const LiveMethod&) = delete;

  /// One frame; figures() has its time.
  void update(const scene::LightingState& state, const Control& control);

  methods::Method& method() { return *method_; }
  const methods::Method& method() const { return *method_; }
  const trace::TransportScene& source() const { return source_; }
  double bake_seconds() const { return bake_seconds_; }
  double update_seconds() const { return update_seconds_; }

  MethodFigures figures() const;
  json::Value json() const { return to_json(figures()); }
  std::string text() const { return to_text(figures()); }

 private:
  trace::TransportScene source_;
  std::unique_ptr<methods::Method> method_;
  double bake_seconds_ = 0, update_seconds_ = 0;
};

}  // namespace ssphh::pipeline

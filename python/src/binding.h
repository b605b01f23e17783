#pragma once
/// What every file of the Python module needs: pybind11, the parts of the module, and scenes as Python holds
/// them.

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <ssphh/pipeline/scene_options.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::python {

namespace py = pybind11;
using namespace py::literals;  // NOLINT: "name"_a

/// A scene as it was loaded. Nothing changes it, so that any number of threads may work with it.
class LoadedScene {
 public:
  LoadedScene(scene::Scene scene, std::string source, float time)
      : scene_(std::make_shared<const scene::Scene>(std::move(scene))),
        source_(std::move(source)),
        time_(time) {}

  const scene::Scene& scene() const { return *scene_; }
  const std::string& source() const { return source_; }
  float time() const { return time_; }  ///< pose [s]
  /// Built when first asked for; call it without the GIL.
  trace::SharedGeometry geometry() const {
    const std::scoped_lock lock(mutex_);
    if (!geometry_) geometry_ = trace::geometry_of(scene_);
    return geometry_;
  }

 private:
  std::shared_ptr<const scene::Scene> scene_;
  std::string source_;
  float time_;
  mutable std::mutex mutex_;
  mutable trace::SharedGeometry geometry_;
};
using SceneHandle = std::shared_ptr<LoadedScene>;

// Parts of the module, each in a file of its own.
void add_errors(py::module_& m);
void add_scene(py::module_& m);
void add_place(py::module_& m);
void add_probe_set(py::module_& m);
void add_bake(py::module_& m);
void add_lookup(py::module_& m);
void add_relight(py::module_& m);
void add_render(py::module_& m);
void add_images(py::module_& m);
void add_sh(py::module_& m);

/// Messages name options as the tool does; Python's keywords are the same words: --max-depth is max_depth.
std::string with_keywords(const std::string& text);

/// Of a string or a path object.
std::string path_of(const py::object& path);

/// Makes the type look at home in `ssphh`, where people find it.
template <class Type>
Type& at_home(Type& type) {
  type.attr("__module__") = "ssphh";
  return type;
}

}  // namespace ssphh::python

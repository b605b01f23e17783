/// The module ssphh._ssphh; ssphh/__init__.py gives its names to people.

#include <ssphh/core/version.h>

#include "binding.h"
#include "work.h"

PYBIND11_MODULE(_ssphh, m) {
  using namespace ssphh::python;  // NOLINT
  m.doc() = "Compiled part of the package ssphh";
  m.attr("__version__") = SSPHH_VERSION;
  py::options options;
  options.disable_enum_members_docstring();
  take_log();
  add_errors(m);
  add_scene(m);
  add_place(m);
  add_probe_set(m);
  add_bake(m);
  add_lookup(m);
  add_relight(m);
  add_render(m);
  add_images(m);
  add_sh(m);
}

#include <cctype>

#include <ssphh/core/error.h>

#include "binding.h"

namespace ssphh::python {

std::string with_keywords(const std::string& text) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::islower(static_cast<unsigned char>(text[i]));
  };
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const bool word_before =
        i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '-');
    if (text.compare(i, 2, "--") != 0 || word_before || !letter(i + 2)) {
      out += text[i++];
      continue;
    }
    for (i += 2; letter(i) || (i < text.size() && text[i] == '-' && letter(i + 1)); ++i)
      out += text[i] == '-' ? '_' : text[i];
  }
  return out;
}

std::string path_of(const py::object& path) {
  return py::str(py::module_::import("os").attr("fsdecode")(path));
}

void add_errors(py::module_& m) {
  // The class is Python's own, so that it can be pickled and subclassed as any other.
  m.attr("Error") = py::module_::import("ssphh._error").attr("Error");
  py::register_local_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& e) {
      const py::object type = py::module_::import("ssphh._error").attr("Error");
      const py::object error =
          type(with_keywords(e.where()), with_keywords(e.problem()), with_keywords(e.hint()));
      PyErr_SetObject(type.ptr(), error.ptr());
    }
  });
}

}  // namespace ssphh::python

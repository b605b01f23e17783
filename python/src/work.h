#pragma once
/// Long work, asked for by Python.

#include <functional>
#include <optional>
#include <type_traits>

#include <ssphh/core/control.h>

#include "binding.h"

namespace ssphh::python {

/// Does the work in a thread of its own and waits for it without the GIL. Twenty times a second the calling
/// thread hands messages to `logging`, tells `progress` (None, or a function of stage, done, total, unit) and
/// looks for signals. What these raise, KeyboardInterrupt first of all, cancels the work and is thrown when
/// it has stopped; else what the work threw.
void do_work(const py::object& progress, const std::function<void(const Control&)>& work);

/// The same for work that gives something back.
template <class Work>
auto run(const py::object& progress, Work&& work) {
  using Result = std::invoke_result_t<Work&, const Control&>;
  std::optional<Result> result;
  do_work(progress, [&](const Control& control) { result.emplace(work(control)); });
  return std::move(*result);
}

/// Sends the library's messages to Python's logger "ssphh" instead of stderr.
void take_log();

}  // namespace ssphh::python

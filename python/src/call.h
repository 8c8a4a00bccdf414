// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "mesamis/base/progress.h"

/// Long work for Python: without the interpreter's lock, with progress and Ctrl-C.
namespace mesamis::python {

namespace py = pybind11;

/// What each long function of the package takes.
struct CallOptions {
  py::object progress;  ///< called as progress(stage, fraction); None: nothing is called
  int threads = 0;      ///< 0: as many as the machine has
};

/// Runs work in a thread of its own, with at most so many threads, while the calling thread waits
/// without the interpreter's lock. The calling thread looks after signals and calls the progress
/// function, at most once in 50 ms for each stage, with every stage at least once.
///
/// Work that is stopped ends at its next call of Progress: after a signal, as Ctrl-C, after an
/// exception of the progress function, or if that returns what is false and not None.
/// @throws what the work throws; what the signal's handler or the progress function raised;
///         Cancelled if it said stop and nothing else failed, also where the work had ended by
///         then.
void run_released(const CallOptions& call, const std::function<void(const Progress&)>& work);

/// The same for work that returns a value.
template <class Work>
auto released(const CallOptions& call, Work&& work) {
  std::optional<decltype(work(Progress{}))> result;
  run_released(call, [&](const Progress& progress) { result.emplace(work(progress)); });
  return *std::move(result);
}

/// The same for work that nobody follows and that returns nothing.
template <class Work>
void without_lock(Work&& work) {
  run_released({py::none(), 0}, [&](const Progress&) { work(); });
}

}  // namespace mesamis::python

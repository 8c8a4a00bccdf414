// SPDX-License-Identifier: Apache-2.0
// mesamis._core: what the Python package needs of the library. The package around it is the door.
#include <string>

#include "arrays.h"
#include "binding.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/version.h"

namespace mesamis::python {
namespace {

/// Earlier versions of pybind11 look for the size of an element where NumPy 1 has it. NumPy 2 has
/// flags there, so that every row of an array would be the first one.
constexpr bool kKnowsNumpy2 = PYBIND11_VERSION_HEX >= 0x020C0000;

void require_known_numpy() {
  if (kKnowsNumpy2) return;
  const auto found = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (std::stoi(found) < 2) return;
  throw py::import_error("mesamis: expected NumPy 1, for which this module was built (pybind11 " +
                         std::to_string(PYBIND11_VERSION_MAJOR) + "." +
                         std::to_string(PYBIND11_VERSION_MINOR) + "), found NumPy " + found +
                         ": install numpy<2, or mesamis built with pybind11 2.12 or newer");
}

}  // namespace
}  // namespace mesamis::python

PYBIND11_MODULE(_core, module) {
  using namespace mesamis::python;
  require_known_numpy();
  module.attr("knows_numpy_2") = kKnowsNumpy2;
  module.doc() = "The library behind the package mesamis; not for use by itself.";
  module.attr("version") = mesamis::version();
  module.attr("commit") = mesamis::commit();
  module.def("thread_count", &mesamis::thread_count);
  bind_errors(module);
  bind_volume(module);
  bind_settings(module);
  bind_files(module);
  bind_run(module);
  bind_segment(module);
  bind_tools(module);
  bind_body(module);
}

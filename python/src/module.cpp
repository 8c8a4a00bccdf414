// SPDX-License-Identifier: Apache-2.0
// mesamis._core: what the Python package needs of the library. The package around it is the door.
#include "binding.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/version.h"

PYBIND11_MODULE(_core, module) {
  using namespace mesamis::python;
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

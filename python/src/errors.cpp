// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include "binding.h"
#include "mesamis/base/error.h"

namespace mesamis::python {
namespace {

template <class Error>
void add(pybind11::module_& module, const char* name, PyObject* base, const char* text) {
  auto& type = pybind11::register_exception<Error>(module, name, base);
  type.attr("__module__") = "mesamis";
  type.attr("__doc__") = text;
}

}  // namespace

void bind_errors(pybind11::module_& module) {
  add<InputError>(module, "InputError", PyExc_ValueError,
                  "An argument or a file that cannot be used; one line says what, where, expected "
                  "and found.");
  add<NumericalError>(
      module, "NumericalError", PyExc_RuntimeError,
      "A promise that could not be kept: a solve that broke down, an invalid mesh.");
  add<Cancelled>(module, "Cancelled", PyExc_RuntimeError, "The progress function returned False.");
}

}  // namespace mesamis::python

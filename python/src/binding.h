// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

/// Each function adds a topic to the module.
namespace mesamis::python {

void bind_errors(pybind11::module_& module);
void bind_volume(pybind11::module_& module);
void bind_settings(pybind11::module_& module);
void bind_files(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_segment(pybind11::module_& module);
void bind_tools(pybind11::module_& module);
void bind_body(pybind11::module_& module);

}  // namespace mesamis::python

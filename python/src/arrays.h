// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <type_traits>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/surface/tri_mesh.h"

/// NumPy arrays that share their memory with vectors of the library.
namespace mesamis::python {

namespace py = pybind11;

/// Keeps an owner alive as long as an array lives.
py::capsule keep_alive(std::shared_ptr<const void> owner);

/// A vector as an array that cannot be written to: of its numbers, or of n rows of the numbers of
/// an element. No copy; the array keeps the vector's owner.
template <class Number, class Element>
py::array view_of(const std::vector<Element>& values, std::shared_ptr<const void> owner) {
  static_assert(std::is_standard_layout_v<Element> && sizeof(Element) % sizeof(Number) == 0);
  constexpr std::size_t kColumns = sizeof(Element) / sizeof(Number);
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
  if (kColumns > 1) shape.push_back(kColumns);
  const auto* data = reinterpret_cast<const Number*>(values.data());
  py::array array(py::dtype::of<Number>(), shape, {}, data, keep_alive(std::move(owner)));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A vector as an array that owns it. No copy.
template <class Number, class Element>
py::array array_of(std::vector<Element> values) {
  const auto owner = std::make_shared<const std::vector<Element>>(std::move(values));
  return view_of<Number>(*owner, owner);
}

/// Numbers of any type as doubles in rows.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// Whole numbers of any type in rows.
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// @throws InputError  naming the argument, unless the array has n rows of three numbers.
std::vector<Vec3> points_of(const Doubles& array, const char* what);

/// @throws InputError  as points_of(), and for an index that is out of 32 bits.
std::vector<Triangle> triangles_of(const Indices& array, const char* what);

/// @throws InputError  as triangles_of(), for rows of four.
std::vector<Cell> cells_of(const Indices& array, const char* what);

/// @throws InputError  unless the array has n rows of six numbers: xx xy xz yy yz zz.
std::vector<Sym3> tensors_of(const Doubles& array, const char* what);

/// A surface whose triangles name points that there are.
/// @throws InputError  as points_of() and require_sound().
TriMesh surface_of(const Doubles& points, const Indices& triangles);

/// Objects as dicts of name, label, layer, colour, points, triangles and expected_error, which is
/// empty. No copy of points and triangles.
py::list dicts_of(std::vector<NamedSurface> objects);

/// Objects of such dicts.
/// @throws InputError  as surface_of().
std::vector<NamedSurface> named_surfaces_of(const py::list& dicts);

}  // namespace mesamis::python

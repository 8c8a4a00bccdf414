// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis::python {
namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t a = 0; a < array.ndim(); ++a) {
    text += (a > 0 ? ", " : "") + std::to_string(array.shape(a));
  }
  return text + ")";
}

/// @return  the number of rows.
std::size_t require_rows(const py::array& array, py::ssize_t columns, const char* what) {
  if (array.ndim() == 2 && array.shape(1) == columns) {
    return static_cast<std::size_t>(array.shape(0));
  }
  throw InputError(std::string(what) + ": expected an array of shape (n, " +
                   std::to_string(columns) + "), found " + shape_text(array));
}

template <std::size_t columns>
std::vector<std::array<Index, columns>> rows_of(const Indices& array, const char* what) {
  std::vector<std::array<Index, columns>> rows(require_rows(array, columns, what));
  const std::int64_t* numbers = array.data();
  for (auto& row : rows) {
    for (Index& index : row) {
      const std::int64_t number = *numbers++;
      if (number < 0 || number > std::numeric_limits<Index>::max()) {
        throw InputError(std::string(what) + ": expected indices of points, found " +
                         std::to_string(number));
      }
      index = static_cast<Index>(number);
    }
  }
  return rows;
}

}  // namespace

py::capsule keep_alive(std::shared_ptr<const void> owner) {
  auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
  py::capsule capsule(kept.get(),
                      [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  kept.release();
  return capsule;
}

std::vector<Vec3> points_of(const Doubles& array, const char* what) {
  std::vector<Vec3> points(require_rows(array, 3, what));
  const double* x = array.data();
  for (Vec3& p : points) {
    p = {x[0], x[1], x[2]};
    x += 3;
  }
  return points;
}

std::vector<Triangle> triangles_of(const Indices& array, const char* what) {
  return rows_of<3>(array, what);
}

std::vector<Cell> cells_of(const Indices& array, const char* what) {
  return rows_of<4>(array, what);
}

std::vector<Sym3> tensors_of(const Doubles& array, const char* what) {
  std::vector<Sym3> tensors(require_rows(array, 6, what));
  const double* x = array.data();
  for (Sym3& t : tensors) {
    t = {x[0], x[1], x[2], x[3], x[4], x[5]};
    x += 6;
  }
  return tensors;
}

TriMesh surface_of(const Doubles& points, const Indices& triangles) {
  TriMesh surface{points_of(points, "points"), triangles_of(triangles, "triangles")};
  require_sound(surface);
  return surface;
}

py::list dicts_of(std::vector<NamedSurface> objects) {
  using namespace py::literals;
  py::list dicts;
  for (NamedSurface& o : objects) {
    dicts.append(py::dict("name"_a = o.name, "label"_a = o.label, "layer"_a = 0,
                          "colour"_a = py::make_tuple(o.colour[0], o.colour[1], o.colour[2]),
                          "points"_a = array_of<double>(std::move(o.surface.points)),
                          "triangles"_a = array_of<Index>(std::move(o.surface.triangles)),
                          "expected_error"_a = array_of<double>(std::vector<double>{})));
  }
  return dicts;
}

std::vector<NamedSurface> named_surfaces_of(const py::list& dicts) {
  std::vector<NamedSurface> objects;
  objects.reserve(dicts.size());
  for (const py::handle one : dicts) {
    const auto object = one.cast<py::dict>();
    objects.push_back(
        {object["name"].cast<std::string>(), object["colour"].cast<std::array<std::uint8_t, 3>>(),
         object["label"].cast<Index>(),
         surface_of(object["points"].cast<Doubles>(), object["triangles"].cast<Indices>())});
  }
  return objects;
}

}  // namespace mesamis::python

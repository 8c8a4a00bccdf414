// SPDX-License-Identifier: Apache-2.0
#include "volume.h"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/image/grid_axes.h"
#include "mesamis/image/not_numbers.h"
#include "mesamis/image/orientation.h"
#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/write_volume.h"
#include "request.h"

namespace mesamis::python {
namespace {

Vector list(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Not orthonormal by more than rounding: as for a file's axes, the nearest that are.
constexpr double kRounding = 1e-12;

double flaw_of(const Mat3& m) {
  double flaw = 0;
  const Mat3 columns = transpose(m);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      const double wanted = a == b ? 1 : 0;
      flaw = std::max(flaw, std::abs(dot(columns.rows[a], columns.rows[b]) - wanted));
    }
  }
  return flaw;
}

/// Where voxels lie, as the file formats and libraries say it.
struct Place {
  Vec3 spacing, origin;
  Mat3 direction;
};

/// @param rows  a 4x4 matrix from voxel indices to RAS, by rows.
Place place_of_affine(const std::vector<double>& rows, double unit_mm) {
  const auto lps = [&](std::size_t column) {
    return Vec3{-unit_mm * rows[column], -unit_mm * rows[4 + column], unit_mm * rows[8 + column]};
  };
  const GridAxes axes = grid_axes({lps(0), lps(1), lps(2)});
  return {axes.spacing, lps(3) + Vec3{}, axes.direction};
}

Place place_of_axes(const Vector& spacing, const Vector& origin,
                    const std::vector<double>& direction) {
  Place place{vec(spacing), vec(origin) + Vec3{}, matrix_of(direction)};
  if (!(flaw_of(place.direction) <= kRounding)) {
    place.direction = grid_axes(transpose(place.direction).rows).direction;
  }
  return place;
}

std::shared_ptr<Scan> scan_of_array(const py::array& samples, const Place& place,
                                    const std::string& modality) {
  if (samples.ndim() != 3 || !py::isinstance<py::array_t<float>>(samples) ||
      (samples.flags() & py::array::f_style) == 0) {
    throw InputError("volume: expected three axes of float32, the first running fastest");
  }
  const auto scan = std::make_shared<Scan>();
  VolumeView& view = scan->view;
  for (py::ssize_t a = 0; a < 3; ++a) {
    if (samples.shape(a) > std::numeric_limits<Index>::max()) {
      throw InputError("volume: more voxels than can be counted");
    }
    view.size[static_cast<std::size_t>(a)] = static_cast<Index>(samples.shape(a));
  }
  view.spacing = place.spacing;
  view.origin = place.origin;
  view.direction = place.direction;
  view.modality = modality;
  view.samples = {static_cast<const float*>(samples.data()),
                  static_cast<std::size_t>(samples.size())};
  scan->array = samples;
  return scan;
}

std::shared_ptr<Scan> read(const std::string& path, const ReadOptions& options) {
  VolumeFile file =
      released({py::none(), 0}, [&](const Progress&) { return read_volume(path, options); });
  const NotNumbers nan = fill_not_numbers(file.volume.samples);
  if (nan.voxels > 0) {
    file.warnings.push_back(std::to_string(nan.voxels) + " voxels are NaN and count as background");
  }
  const auto scan = scan_of(std::move(file.volume));
  scan->path = path;
  scan->format = file.format;
  scan->warnings = std::move(file.warnings);
  scan->files = std::move(file.files);
  return scan;
}

/// @param a  keywords of read_volume(); None and absent ones say nothing.
std::shared_ptr<Scan> read_scan(const std::string& path, const py::dict& keywords) {
  const Arguments a(keywords);
  ReadOptions options;
  options.series = a.get<std::string>("series");
  if (const auto spacing = a.find<Vector>("spacing")) options.spacing = vec(*spacing);
  options.resample = a.get<bool>("resample");
  options.volume = a.find<Index>("volume_number");
  options.channel = a.find<Index>("channel");
  options.modality = a.get<std::string>("modality");
  options.limits.memory_gb = a.get<double>("memory");
  return read(path, options);
}

/// The samples with axes i, j, k; not to be written to.
py::array samples_of(const std::shared_ptr<Scan>& scan) {
  const VolumeView& v = scan->view;
  if (scan->spent) throw InputError("volume: its samples were given away");
  const std::vector<py::ssize_t> shape{v.size[0], v.size[1], v.size[2]};
  constexpr py::ssize_t kBytes = sizeof(float);
  const std::vector<py::ssize_t> strides{kBytes, kBytes * shape[0], kBytes * shape[0] * shape[1]};
  py::array array(py::dtype::of<float>(), shape, strides, v.samples.data(), keep_alive(scan));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

std::vector<double> direction_of(const Scan& scan) {
  std::vector<double> rows;
  for (const Vec3& row : scan.view.direction.rows) rows.insert(rows.end(), {row.x, row.y, row.z});
  return rows;
}

void write(const std::string& path, const Scan& scan, bool gzip) {
  const Volume copy = copy_volume(scan.view);
  write_nrrd(path, copy, {.gzip = gzip});
}

}  // namespace

Mat3 matrix_of(const std::vector<double>& n) {
  if (n.size() != 9) throw InputError("direction: expected nine numbers");
  return {{Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]}, Vec3{n[6], n[7], n[8]}}};
}

DicomSubject subject_of(const std::shared_ptr<Scan>& scan, const std::string& path) {
  if (!std::filesystem::path(path).extension().string().ends_with(".dcm")) {
    throw InputError("patient: expected a .dcm, found " + path);
  }
  if (!scan || scan->files.empty()) {
    throw InputError("patient: expected a scan read from DICOM, found none");
  }
  return read_dicom_subject(scan->files);
}

std::shared_ptr<Scan> scan_of(Volume volume) {
  auto scan = std::make_shared<Scan>();
  scan->own = std::move(volume);
  scan->view = scan->own;
  return scan;
}

InputFacts Scan::facts() const { return facts_of({path, format, warnings, files}, view); }

void bind_volume(py::module_& module) {
  using namespace py::literals;
  py::class_<Scan, std::shared_ptr<Scan>>(module, "Scan")
      .def_property_readonly("samples", &samples_of)
      .def(
          "keep", [](Scan& s, py::object owner) { s.owner = std::move(owner); }, "owner"_a)
      .def_property_readonly("spacing", [](const Scan& s) { return list(s.view.spacing); })
      .def_property_readonly("origin", [](const Scan& s) { return list(s.view.origin); })
      .def_property_readonly("direction", &direction_of)
      .def_property_readonly("size", [](const Scan& s) { return s.view.size; })
      .def_property_readonly("modality", [](const Scan& s) { return s.view.modality; })
      .def_property_readonly("orientation",
                             [](const Scan& s) {
                               const auto letters = orientation_of(s.view.direction).letters;
                               return std::string(letters.begin(), letters.end());
                             })
      .def_readonly("path", &Scan::path)
      .def_readonly("format", &Scan::format)
      .def_readonly("warnings", &Scan::warnings);
  module.def(
      "scan_with_affine",
      [](const py::array& samples, const std::vector<double>& affine, double unit_mm,
         const std::string& modality) {
        if (affine.size() != 16) throw InputError("affine: expected a matrix of 4 x 4");
        return scan_of_array(samples, place_of_affine(affine, unit_mm), modality);
      },
      "samples"_a, "affine"_a, "unit_mm"_a, "modality"_a);
  module.def(
      "scan_with_axes",
      [](const py::array& samples, const Vector& spacing, const Vector& origin,
         const std::vector<double>& direction, const std::string& modality) {
        return scan_of_array(samples, place_of_axes(spacing, origin, direction), modality);
      },
      "samples"_a, "spacing"_a, "origin"_a, "direction"_a, "modality"_a);
  module.def("read_scan", &read_scan, "path"_a, "keywords"_a);
  module.def("write_scan", &write, "path"_a, "scan"_a, "gzip"_a);
}

}  // namespace mesamis::python

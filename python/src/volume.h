// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/dicom_subject.h"
#include "mesamis/files/read_record.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/report/report.h"

namespace mesamis::python {

namespace py = pybind11;

/// Three numbers of Python, and the library's.
using Vector = std::array<double, 3>;
inline Vec3 vec(const Vector& v) { return {v[0], v[1], v[2]}; }

/// A scan of Python: a NumPy array that is read in place, or samples of its own.
struct Scan {
  VolumeView view;                    ///< of the array, or of `own`
  Volume own;                         ///< where the samples are not an array's
  py::array array;                    ///< that `view` lies in; kept alive
  py::object owner;                   ///< of the array's memory where the array does not hold it
  std::string path;                   ///< of the file it was read from; empty: none
  std::string format = "array";       ///< as VolumeFile::format
  std::vector<std::string> warnings;  ///< of the reader
  std::vector<ReadFile> files;        ///< that were read
  bool spent = false;                 ///< the samples were moved out

  /// The facts a report gives. @throws InputError  as facts_of().
  InputFacts facts() const;
};

/// The patient and the study of a scan in DICOM, for files of surfaces that belong to it.
/// @param path  of such a file, or what was asked for: must end with .dcm.
/// @throws InputError  for another extension, and a scan that is not DICOM.
DicomSubject subject_of(const std::shared_ptr<Scan>& scan, const std::string& path);

/// A scan that owns its samples.
std::shared_ptr<Scan> scan_of(Volume volume);

/// A matrix as nine numbers, by rows.
Mat3 matrix_of(const std::vector<double>& rows);

}  // namespace mesamis::python

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/base/types.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/run/segment.h"
#include "volume.h"

/// What a call of segment() asks for.
namespace mesamis::python {

/// The settings of a preset, overridden by those of a file, then by those of a JSON object.
/// @throws InputError  as read_settings() and from_json().
Settings settings_from(const std::string& preset, const std::string& file, const std::string& json);

/// The frame of "lps" and "ras".
/// @throws InputError  for another text.
Frame frame_of(const std::string& name);

/// What a type of C++ is called in messages.
template <class Value>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Value, bool>) return "True or False";
  if constexpr (std::is_integral_v<Value>) return "a whole number";
  if constexpr (std::is_floating_point_v<Value>) return "a number";
  if constexpr (std::is_same_v<Value, std::string>) return "a text";
  if constexpr (std::is_same_v<Value, std::vector<std::string>>) return "a list of texts";
  if constexpr (std::is_same_v<Value, std::shared_ptr<Scan>>) return "a path or an image";
  return "a list of pairs or of points";
}

/// Keyword arguments that the package has brought into plain form: a dict whose missing or None
/// entries mean the default. A value of a wrong type is an InputError that names its argument.
class Arguments {
 public:
  explicit Arguments(py::dict dict) : dict_(std::move(dict)) {}

  bool has(const char* name) const {
    return dict_.contains(name) && !py::object(dict_[name]).is_none();
  }
  template <class Value>
  Value get(const char* name, Value otherwise = {}) const {
    return has(name) ? cast<Value>(name) : otherwise;
  }
  template <class Value>
  std::optional<Value> find(const char* name) const {
    if (!has(name)) return std::nullopt;
    return cast<Value>(name);
  }
  py::object object(const char* name) const {
    return has(name) ? py::object(dict_[name]) : py::none();
  }

 private:
  template <class Value>
  Value cast(const char* name) const {
    const py::object value = dict_[name];
    try {
      return value.cast<Value>();
    } catch (const py::cast_error&) {
      throw InputError(std::string(name) + ": expected " + type_name<Value>() + ", found " +
                       Py_TYPE(value.ptr())->tp_name);
    }
  }

  py::dict dict_;
};

/// Marks or labels: of a file, or of whole numbers on the grid of a scan.
struct LabelSource {
  std::string path;            ///< empty: an array
  std::shared_ptr<Scan> scan;  ///< its samples are the labels
};

/// What is asked for, in the types of the library.
struct CallRequest {
  Settings settings;
  Frame frame = Frame::kLps;
  std::string tissue, box;
  std::vector<Vector> seeds;  ///< in the frame, mm
  std::optional<LabelSource> mask, remove, labels;
  std::vector<std::string> chosen;                   ///< names or numbers of labels; empty: all
  std::vector<std::pair<Index, std::string>> names;  ///< of labels
  std::string names_file;
  std::optional<double> margin, time_limit;
  std::optional<Vec3> spacing;  ///< of a file of labels alone, mm: instead of the file's
  bool resample = false;        ///< a file of labels alone, if its grid is sheared
  bool remove_body = false, keep_surroundings = false, mesh = false;
  PaddingRule padding{};
  double memory_gb = 0;

  bool wants_labels() const { return labels.has_value(); }
};

/// @throws InputError  for settings that are refused, and for what does not go together.
CallRequest request_of(const Arguments& arguments);

/// How labels are read beside a scan, which the options refer to; null: labels alone.
LabelOptions label_options(const CallRequest& request, const VoxelGrid* scan);

/// Reads the labels.
/// @param warnings  those of the reader are added.
/// @throws InputError  as read_label_map(), or for samples that are no labels.
LabelMap labels_of(const LabelSource& source, const LabelOptions& options,
                   std::vector<std::string>& warnings);

/// What the library is asked for; reads masks.
/// @param grid  of the scan, for the box.
/// @throws InputError  as labels_of() and box_to_range().
ObjectRequest object_request(const CallRequest& request, const VoxelGrid& grid,
                             std::vector<std::string>& warnings);

}  // namespace mesamis::python

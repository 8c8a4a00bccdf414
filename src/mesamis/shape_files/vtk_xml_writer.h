// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/files/bytes.h"
#include "mesamis/files/output_path.h"

/// VTK's XML files, written without VTK: raw appended data, blocks packed by zlib at level 1,
/// 64-bit headers, little endian. The bytes are those of VTK 9.1's own writers.
namespace mesamis::detail::shape_files {

/// VTK's name of a C++ type.
template <class Number>
constexpr const char* vtk_type_name();
template <>
constexpr const char* vtk_type_name<double>() {
  return "Float64";
}
template <>
constexpr const char* vtk_type_name<std::int32_t>() {
  return "Int32";
}
template <>
constexpr const char* vtk_type_name<std::int64_t>() {
  return "Int64";
}
template <>
constexpr const char* vtk_type_name<std::uint8_t>() {
  return "UInt8";
}

/// An array to write. Its values are computed block by block while they are written.
struct VtkArray {
  std::string name;
  const char* type = "";       ///< VTK's name of the type
  int components = 1;          ///< values per tuple
  std::size_t values = 0;      ///< tuples times components
  std::size_t value_size = 0;  ///< bytes per value
  /// Appends the values [begin, end) to bytes, little endian.
  std::function<void(std::size_t begin, std::size_t end, std::string& bytes)> append_values;
  std::size_t tuples = 0;       ///< stated where not 0: no piece counts the field data
  std::string least{}, most{};  ///< the range, where it is stated and not of doubles
};

/// An array of numbers.
/// @param values    tuples times components.
/// @param value_at  gives value i as something that converts to Number; called while the file is
///                  written, and more than once for each i.
template <class Number, class ValueAt>
VtkArray vtk_array(std::string name, int components, std::size_t values, ValueAt value_at) {
  auto append_values = [value_at = std::move(value_at)](std::size_t begin, std::size_t end,
                                                        std::string& bytes) {
    for (std::size_t i = begin; i < end; ++i) append(bytes, static_cast<Number>(value_at(i)));
  };
  return {std::move(name), vtk_type_name<Number>(), components,
          values,          sizeof(Number),          std::move(append_values)};
}

/// An array of one text.
VtkArray vtk_text(std::string name, std::string text);

/// An array of texts, none of which has a zero byte.
VtkArray vtk_texts(std::string name, const std::vector<std::string>& texts);

/// Texts as an array of numbers: their bytes, a zero between two texts. VtkXml reads it as it reads
/// texts. Readers that know numbers alone, as meshio, take it too.
/// @param texts  none has a zero byte; together they have a byte at least.
VtkArray vtk_text_bytes(std::string name, const std::vector<std::string>& texts);

/// The arrays in one element of a piece, e.g. <PointData>.
struct VtkArrayGroup {
  std::string element;
  std::vector<VtkArray> arrays;
  std::string scalars{};  ///< the array that viewers colour by; empty: none is named
};

/// A file of one piece.
struct VtkFile {
  std::string type;  ///< "PolyData" or "UnstructuredGrid"
  std::vector<VtkArray> field_data;
  std::vector<std::pair<std::string, std::size_t>> counts;  ///< e.g. NumberOfPoints
  std::vector<VtkArrayGroup> groups;                        ///< in VTK's order
};

/// Writes the file: whole or not at all. Memory: one block of 32 KiB and the sizes of the blocks of
/// one array.
/// @throws InputError  if two arrays of a group have the same name or the file cannot be written.
void write_vtk_xml(const OutputPath& path, const VtkFile& file);

/// The bytes of the same file.
/// @throws InputError  if two arrays of a group have the same name.
std::string vtk_xml_bytes(const VtkFile& file);

}  // namespace mesamis::detail::shape_files

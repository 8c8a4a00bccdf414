// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/scan_bytes.h"

namespace mesamis {

/// A matrix of doubles, by columns, as a variable of a MATLAB file.
struct MatlabVariable {
  std::string name;
  std::vector<double> values;
  std::int32_t rows = 4, columns = 4;
};

/// A file of level 4.
inline std::string matlab_4_bytes(const std::vector<MatlabVariable>& variables,
                                  bool big_endian = false) {
  std::string bytes;
  for (const MatlabVariable& v : variables) {
    const std::int32_t code = big_endian ? 1000 : 0;
    for (const std::int32_t field :
         {code, v.rows, v.columns, 0, static_cast<std::int32_t>(v.name.size() + 1)}) {
      bytes += bytes_of(field, big_endian);
    }
    bytes += v.name + std::string(1, '\0') + bytes_of_all(v.values, big_endian);
  }
  return bytes;
}

/// An element of a file of level 5, padded.
inline std::string matlab_element(std::uint32_t type, std::string data, bool big_endian = false) {
  const auto size = static_cast<std::uint32_t>(data.size());
  data.resize((data.size() + 7) / 8 * 8);
  return bytes_of(type, big_endian) + bytes_of(size, big_endian) + data;
}

/// A file of level 5. More than 16 values are a stack of matrices along a third axis.
inline std::string matlab_5_bytes(const std::vector<MatlabVariable>& variables, bool compressed,
                                  bool big_endian = false) {
  std::string bytes = "MATLAB 5.0 MAT-file, made by hand";
  bytes.resize(124, ' ');
  bytes += bytes_of(std::uint16_t{0x100}, big_endian) + bytes_of(std::uint16_t{0x4d49}, big_endian);
  for (const MatlabVariable& v : variables) {
    std::vector<std::int32_t> sizes{v.rows, v.columns};
    const auto count = static_cast<std::int32_t>(v.values.size()) / (v.rows * v.columns);
    if (count != 1) sizes.push_back(count);
    const std::uint32_t small_name = 1 | static_cast<std::uint32_t>(v.name.size()) << 16;
    std::string name = bytes_of(small_name, big_endian) + v.name;
    name.resize(8);
    const std::string flags = bytes_of_all<std::uint32_t>({6, 0}, big_endian);
    const std::string matrix =
        matlab_element(14,
                       matlab_element(6, flags, big_endian) +
                           matlab_element(5, bytes_of_all(sizes, big_endian), big_endian) +
                           (v.name.size() > 4 ? matlab_element(1, v.name, big_endian) : name) +
                           matlab_element(9, bytes_of_all(v.values, big_endian), big_endian),
                       big_endian);
    if (!compressed) {
      bytes += matrix;
      continue;
    }
    const std::string deflated = packed(matrix, 15);
    bytes += bytes_of(std::uint32_t{15}, big_endian) +
             bytes_of(static_cast<std::uint32_t>(deflated.size()), big_endian) + deflated;
  }
  return bytes;
}

}  // namespace mesamis

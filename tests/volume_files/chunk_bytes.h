// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <blosc.h>
#include <zstd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/scan_bytes.h"
#include "support/temp_folder.h"

/// Zarr stores made by hand.
namespace mesamis {

inline std::string with_blosc(const std::string& bytes, const char* name = "lz4",
                              std::size_t element = 2, int shuffle = BLOSC_SHUFFLE) {
  std::string out(bytes.size() + BLOSC_MAX_OVERHEAD, '\0');
  const int size = blosc_compress_ctx(5, shuffle, element, bytes.size(), bytes.data(), out.data(),
                                      out.size(), name, 0, 1);
  out.resize(static_cast<std::size_t>(size));
  return out;
}

inline std::string with_zstd(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

/// The value of voxel (i, j, k): all differ.
inline int voxel_value(std::uint64_t i, std::uint64_t j, std::uint64_t k) {
  return static_cast<int>(i + 10 * j + 100 * k) - 300;
}

/// What an array of 5 x 6 x 7 voxels (i, j, k) in chunks of 3 x 4 x 2 is written with.
struct ArrayBytes {
  std::array<std::uint64_t, 3> shape{7, 6, 5}, chunk{2, 4, 3};  // k, j, i
  bool fortran = false;                                         ///< i slowest
  bool big_endian = false;
  std::string separator = ".", prefix;
  std::function<std::string(const std::string&)> pack = [](const std::string& s) { return s; };

  /// The samples of one chunk; what is beyond the array counts 99.
  template <class Number>
  std::string chunk_bytes(const std::array<std::uint64_t, 3>& place) const {
    std::string bytes;
    const std::array<std::size_t, 3> axes =
        fortran ? std::array<std::size_t, 3>{2, 1, 0} : std::array<std::size_t, 3>{0, 1, 2};
    std::array<std::uint64_t, 3> at{};
    for (at[axes[0]] = 0; at[axes[0]] < chunk[axes[0]]; ++at[axes[0]]) {
      for (at[axes[1]] = 0; at[axes[1]] < chunk[axes[1]]; ++at[axes[1]]) {
        for (at[axes[2]] = 0; at[axes[2]] < chunk[axes[2]]; ++at[axes[2]]) {
          bool within = true;
          std::array<std::uint64_t, 3> voxel{};
          for (std::size_t a = 0; a < 3; ++a) {
            voxel[a] = place[a] * chunk[a] + at[a];
            within &= voxel[a] < shape[a];
          }
          const int value = within ? voxel_value(voxel[2], voxel[1], voxel[0]) : 99;
          bytes += bytes_of(static_cast<Number>(value), big_endian);
        }
      }
    }
    return bytes;
  }

  /// Writes all chunks below a folder; `lead` is put before their numbers ("0.0.").
  template <class Number>
  void write(const std::filesystem::path& folder, const std::string& lead = "") const {
    const auto count = [&](std::size_t a) { return (shape[a] + chunk[a] - 1) / chunk[a]; };
    for (std::uint64_t k = 0; k < count(0); ++k) {
      for (std::uint64_t j = 0; j < count(1); ++j) {
        for (std::uint64_t i = 0; i < count(2); ++i) {
          const std::string name = prefix + lead + std::to_string(k) + separator +
                                   std::to_string(j) + separator + std::to_string(i);
          write_bytes(folder / name, pack(chunk_bytes<Number>({k, j, i})));
        }
      }
    }
  }
};

/// The samples of some slices of it.
inline std::vector<float> expected_slices(std::uint64_t first, std::uint64_t count,
                                          const std::array<std::uint64_t, 3>& shape = {7, 6, 5}) {
  std::vector<float> samples;
  for (std::uint64_t k = first; k < first + count; ++k) {
    for (std::uint64_t j = 0; j < shape[1]; ++j) {
      for (std::uint64_t i = 0; i < shape[2]; ++i) {
        samples.push_back(static_cast<float>(voxel_value(i, j, k)));
      }
    }
  }
  return samples;
}

/// The content of .zarray, with more fields or other values for them.
inline std::string zarray(const std::string& dtype = "<i2", const std::string& compressor = "null",
                          const std::string& more = "") {
  return R"({"zarr_format": 2, "shape": [7, 6, 5], "chunks": [2, 4, 3], "dtype": ")" + dtype +
         R"(", "compressor": )" + compressor + R"(, "fill_value": 0, "order": "C", )" +
         R"("filters": null)" + more + "}";
}

/// The content of zarr.json of an array.
inline std::string zarr_json(const std::string& type, const std::string& codecs,
                             const std::string& encoding = R"({"name": "default"})") {
  return R"({"zarr_format": 3, "node_type": "array", "shape": [7, 6, 5], "data_type": ")" + type +
         R"(", "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [2, 4, 3]}}, )" +
         R"("chunk_key_encoding": )" + encoding + R"(, "fill_value": 0, "codecs": )" + codecs + "}";
}

inline const char* const kLittle = R"({"name": "bytes", "configuration": {"endian": "little"}})";

/// A multiscales entry of three axes in a unit, one level "0".
inline std::string multiscales(const std::string& unit, const std::string& more = "") {
  const std::string u = unit.empty() ? "" : R"(, "unit": ")" + unit + "\"";
  return R"({"axes": [{"name": "z", "type": "space")" + u + R"(}, {"name": "y", "type": "space")" +
         u + R"(}, {"name": "x", "type": "space")" + u +
         R"(}], "datasets": [{"path": "0", "coordinateTransformations": )" +
         R"([{"type": "scale", "scale": [4, 2, 1]}, )" +
         R"({"type": "translation", "translation": [30, 20, 10]}]}])" + more + "}";
}

}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"

/// Reading the scans that scan_bytes.h makes, or seeing them refused.
namespace mesamis {

/// The samples of a scan of 4 x 3 x 5 voxels.
inline const std::vector<std::int16_t> kRamp = ramp<std::int16_t>(60);

/// So many slices of samples that count on from -40, before slope and intercept.
inline void expect_ramp(const Volume& volume, Index slices = 5, double slope = 1,
                        double intercept = 0) {
  ASSERT_EQ(volume.size, (std::array<Index, 3>{4, 3, slices}));
  ASSERT_EQ(volume.samples.size(), volume.voxel_count());
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    ASSERT_EQ(volume.samples[n],
              static_cast<float>(slope * (static_cast<double>(n) - 40) + intercept));
  }
}

/// Why a path is refused; empty if it is read. A refusal is one line that begins with the path,
/// and says something.
inline std::string complaint(const std::filesystem::path& path, const std::string& series = "") {
  try {
    const VolumeFile file = read_volume(path, {series});
    EXPECT_EQ(file.volume.samples.size(), file.volume.voxel_count()) << path;
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.rfind(path.string(), 0), 0u) << line;
    EXPECT_GT(line.size(), path.string().size() + 10) << line;
    EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << line;
    return line.substr(path.string().size());
  }
  return "";
}

inline std::string complaint(const TempFolder& folder, const std::string& name,
                             const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return complaint(folder / name);
}

inline VolumeFile read(const TempFolder& folder, const std::string& name,
                       const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return read_volume(folder / name);
}

/// Most memory the process has had, in MB.
inline double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace mesamis

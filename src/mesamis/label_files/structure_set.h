// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/dicom_data.h"
#include "mesamis/files/memory_budget.h"

/// The regions of a DICOM structure set of radiotherapy (RTSTRUCT).
namespace mesamis::detail::label_files {

/// A closed contour in a plane. The last point is joined to the first.
struct Contour {
  std::vector<Vec3> points;  ///< LPS, mm; three at least
  bool exclusive = false;    ///< CLOSEDPLANAR_XOR: it takes out what another contour has put in
};

struct Region {
  std::string name;                      ///< not empty, UTF-8
  Index number = 1;                      ///< 1 to kMaxLabel, no two alike
  std::array<std::uint8_t, 3> colour{};  ///< red, green, blue (sRGB)
  std::string frame;                     ///< UID of its frame of reference; empty: not stated
  std::vector<Contour> contours;         ///< one at least
};

struct StructureSet {
  std::vector<Region> regions;  ///< one at least
  std::vector<std::string> warnings;
};

/// Whether a file is of the SOP class RT Structure Set Storage.
bool is_structure_set(const DicomFile& file);

/// Reads the regions and their closed planar contours. Points, open contours and contours of fewer
/// than three points are left out with a warning, and so are regions without any other contour.
/// @throws InputError  for a broken file, a contour whose data are no points, regions that are not
///                     described, and if no region is left.
///
/// O(bytes), up to a logarithm. Memory: the points, claimed.
StructureSet read_structure_set(const DicomFile& file, MemoryBudget& budget);

}  // namespace mesamis::detail::label_files

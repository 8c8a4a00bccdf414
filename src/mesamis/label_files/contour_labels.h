// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "mesamis/files/dicom_data.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/label_files/contour_grid.h"
#include "mesamis/label_files/read_labels.h"

namespace mesamis::detail::label_files {

/// read_label_map() of a DICOM structure set.
///
/// The voxels of a region in a plane are those with the largest share of their area in it, so many
/// that their area is that of the contours to half a voxel. A contour is filled
/// where its winding number is not 0; a contour within another one is a hole in it, and one within
/// that an island again, whatever their directions; contours that overlap partly are united, or, of
/// the type CLOSEDPLANAR_XOR, take each other out. A plane without a contour of a region belongs to
/// the nearest one with such, if that is no farther away than half the region's own distance of
/// planes, or both neighbours are no farther apart than one and a half of it.
/// @param scan  see LabelOptions::scan.
/// @throws InputError  as read_structure_set() and place_contours(), if the frame of reference is
///                     not the scan's and the planes are not its slices either, and for contours of
///                     one plane that overlap too often.
///
/// O(voxels * layers + points), up to a logarithm.
LabelFile read_contour_labels(const DicomFile& file, const std::function<VoxelGrid()>& scan,
                              MemoryBudget& budget);

/// The contours of one region in one plane as shares of the pixels.
/// @param overlaps  set where two contours overlap partly and are united.
/// @return 0 to 1 for each pixel of the plane, row by row.
/// @throws InputError  if they overlap too often.
std::vector<float> filled_plane(const std::filesystem::path& file,
                                std::span<const PlaneContour> contours, const PixelWindow& plane,
                                bool& overlaps);

}  // namespace mesamis::detail::label_files

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mesamis/volume_files/dicom_slice.h"

/// The third axis of a DICOM stack: the order of its slices, their spacing, and the checks that
/// they form a regular grid.
namespace mesamis::detail::volume_files {

/// Largest deviation of a slice from its place, as a share of the slice spacing.
inline constexpr double kStepTolerance = 0.02;
/// Largest lateral shift over the whole stack, as a share of the smallest voxel edge.
inline constexpr double kDriftTolerance = 0.25;
/// Slices no farther apart than this lie at the same place, mm.
inline constexpr double kDuplicateDistance = 1e-4;

/// Slices in the order of their positions along their normal.
struct SortedSlices {
  std::vector<DicomSlice> slices;  ///< two at least
  Vec3 normal;                     ///< unit vector, row direction x column direction
  std::vector<double> height;      ///< position along the normal, mm, ascending
};

/// @param slices  two at least, of one orientation.
SortedSlices sort_along_normal(std::vector<DicomSlice> slices);

/// The mean distance of neighbours, mm: the slice spacing of a stack that passed the checks below.
double mean_spacing(const SortedSlices& sorted);

/// The distances of neighbours, mm, from the lowest up.
std::vector<double> gaps_of(const SortedSlices& sorted);

/// Checks that slice n and the one below it do not lie at the same place.
/// @param path  begins the message.
/// @param n     1 at least.
/// @throws InputError  naming the two slices and their distance, if they do.
void require_apart(const std::filesystem::path& path, const SortedSlices& sorted, std::size_t n);

/// Checks that all neighbours are equally far apart: each distance is within kStepTolerance of
/// the median.
/// @param path  begins the message.
/// @throws InputError  naming the two slices and both distances, for two slices at the same
///                     place, missing slices, and uneven spacing.
void require_even_spacing(const std::filesystem::path& path, const SortedSlices& sorted);

/// Checks that the slices lie straight above one another: no gantry tilt.
/// @param path  begins the message.
/// @throws InputError  with the angle in degrees, if a neighbour is shifted sideways by more than
///                     kStepTolerance of the spacing, or any slice by more than kDriftTolerance.
void require_no_tilt(const std::filesystem::path& path, const SortedSlices& sorted);

}  // namespace mesamis::detail::volume_files

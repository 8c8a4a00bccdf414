// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/object/object_request.h"
#include "mesamis/object/voxel_distance.h"

/// Voxels that the scanner never measured: the corners around a round field of view, and what a
/// resampled or registered scan was filled up with.
namespace mesamis::detail::object {

/// The padding of a scan.
struct Padding {
  VoxelMask mask;          ///< 1 for padding, 0 for what was measured
  double value = 0;        ///< that of most of it, native units
  std::size_t voxels = 0;  ///< how many are padding, at least 1
};

/// Finds the padding of a scan.
///
/// Where the rule is to search, two signs count. In CT nothing is darker than air: samples of -1500
/// HU or less are padding if they are at least a thousandth of the voxels, and so are samples below
/// -1100 HU next to them
/// (-3024, -2048, -2000, and what interpolation made of them). In any scan, a single value that
/// holds at least two corners and reaches in from the border is padding if what it leaves is convex
/// like a field of view (a cylinder, a turned box: one run of voxels on all but 0.5 % of the grid
/// lines and diagonals) and was cut, not faded out. At a cut the voxels next to the padding differ
/// from it (a twentieth by more than 0.02 of the range of the samples), the second ones are dark (a
/// quarter of them), and the third ones are brighter than these in less than three of four cases.
/// What was measured has noise: the dark ones differ from the third ones in a tenth of the cases at
/// least. The step from the padding to it is no edge of an object: the second voxels do not lie
/// close together (within half of the step) and far away (0.3 of the range of the samples). A
/// masked object, whose rim is its own surface, the even background of a synthetic scan, and images
/// of one or few values have not all of this.
///
/// Air that the scanner clipped (CT, -1100 to -900 HU) is no padding: it is air.
/// @param volume  finite samples.
/// @return nothing if there is none, or nothing else.
///
/// O(voxels); 1 byte per voxel.
std::optional<Padding> find_padding(const VolumeView& volume, const PaddingRule& rule = {});

/// Copies the samples that are not marked: what statistics of the scan are made of.
/// @param mask  one mark per voxel, such as Padding::mask.
/// @return native units, in the order of the voxels.
/// @throws InputError  if the mask does not fit the volume.
std::vector<float> samples_outside(const VolumeView& volume, std::span<const std::uint8_t> mask);

/// Sets all marked samples to a value: that of the background (air), so that padding looks like it.
/// @param volume  native units; taken over, pass it with std::move() to save the copy.
/// @param value   native units.
/// @throws InputError  if the mask does not fit the volume.
Volume filled(Volume volume, std::span<const std::uint8_t> mask, double value);

/// Finds how much of a level's surface is the border of the padding: of all crossings of the grid
/// lines with the level, those between a marked and an unmarked voxel. More than a few per cent,
/// and the surface shows the field of view.
/// @param mask   one mark per voxel, such as Padding::mask.
/// @param level  native units.
/// @return 0 to 1, no unit; 0 if nothing crosses the level.
/// @throws InputError  if the mask does not fit the volume.
double share_at_border(const VolumeView& volume, std::span<const std::uint8_t> mask, double level);

}  // namespace mesamis::detail::object

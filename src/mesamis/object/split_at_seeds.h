// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::object {

/// Splits objects that touch: each seed gets the part of the mask that belongs to it.
///
/// A watershed from the seeds through the mask. The strength of a voxel is its depth (mm to the
/// nearest voxel that is not marked) times its brightness (0 at the level, 1 at the value that a
/// tenth of the marked samples above it exceed, and 1 in a marked cavity). Strong voxels are given
/// away first: always the strongest voxel next to a part joins that part. Parts therefore meet
/// where the way from one to the other is weakest: in a dark cleft, where the gradient runs across
/// the way, or in a narrow neck, also where no edge is seen. Among voxels of equal strength the one
/// reached earlier goes first, then the one of the smaller index, so that equal parts meet half
/// way.
///
/// From its place a seed first climbs to where the object is deepest, by steps within the ball that
/// fits there, so that it matters little where in its part it lies; not if two seeds would come to
/// the same voxel.
///
/// @param volume  native units.
/// @param mask    one mark per voxel: the objects together, cavities marked, such as
///                without_cavities() of mask_above(). A cavity that is left open is outside, and
///                the wall around it thin.
/// @param level   native units: of the objects' surface.
/// @param seeds   at least 1, voxels within the grid; each stands for the marked voxels of
///                find_marked_at().
/// @return one layer on the volume's grid. Seed n has the label n + 1, and its part is called
///         "part N". Parts of the mask without a seed are 0.
/// @throws InputError  if the mask does not fit, a seed is outside of the grid or has no object
///                     near it, two are the same voxel, or there are more than kMaxLabel.
///
/// O(voxels), O(n log n) for the n marked voxels, and O(seeds^2); 16 bytes per voxel. Serial but
/// for the depth: the same labels for any number of threads.
LabelMap split_at_seeds(const VolumeView& volume, std::span<const std::uint8_t> mask, double level,
                        std::span<const std::array<Index, 3>> seeds);

}  // namespace mesamis::detail::object

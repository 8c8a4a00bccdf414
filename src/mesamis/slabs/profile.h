// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/adapt/size_control.h"
#include "mesamis/slabs/piece.h"
#include "mesamis/slabs/plan.h"

/// How many cells a metric asks for, slice by slice, for any factor that all its sizes are
/// multiplied by: what slabs tell each other of a mesh, to choose the sizes of the next one and its
/// slabs together.
namespace mesamis::detail::slabs {

/// One for each of the factors that are looked at; what lies between is interpolated.
using Complexities = std::array<double, 97>;

/// Complexities of slices that follow one another.
struct Profile {
  Index first_slice = 0;
  std::vector<Complexities> slices;
};

/// Of a part of a mesh, with the metrics that are asked for at its nodes; each node counts in the
/// slice that it lies in.
/// @param sizes  bounds; its complexity does not count.
///
/// O(nodes), about a hundred times.
Profile profile_of(const SlabPlan& plan, const Piece& own, const SizeControl& sizes);

void add_profile(ArchiveWriter& archive, const Profile& profile);
/// Adds what add_profile() has written to the sums of all slices.
/// @throws InputError  as ArchiveReader::next(), or if it has other slices.
void add_next_profile(ArchiveReader& archive, std::span<Complexities> sums);

Complexities sum_of(std::span<const Complexities> slices);

/// The complexity where all sizes are multiplied by a factor, >= 1.
double complexity_at(const Complexities& complexities, double factor);
/// The factor, >= 1, by which all sizes are multiplied to bring the complexity to a bound.
double factor_for(const Complexities& complexities, double bound);

}  // namespace mesamis::detail::slabs

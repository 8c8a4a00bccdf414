// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/phantom/implicit_surface.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::phantom {

/// The greatest error that the true surface of a phantom may have, of the shortest side of a voxel.
inline constexpr double kTruthErrorVoxel = 0.02;

/// The true surface of a phantom, and how accurate it is.
struct PhantomTruth {
  TriMesh surface;         ///< mm, in the world of the phantom
  SurfaceCheck check;      ///< of the surface
  ImplicitError error;     ///< its distance from the phantom's zero, mm
  double error_bound = 0;  ///< kTruthErrorVoxel in mm

  /// Whether the surface is closed and a 2-manifold.
  bool is_closed_manifold() const { return check.closed() && check.manifold(); }
  /// Whether the error, mm, is at most the bound.
  bool within_bound() const { return error.max <= error_bound; }
};

/// Triangulates the surface of a phantom, so finely that its error stays below kTruthErrorVoxel.
/// @return mm; whether the surface keeps the bound and is closed is for the caller to check.
/// @throws InputError  as extract_implicit(). Cost as there.
PhantomTruth make_truth(const Phantom& phantom);

}  // namespace mesamis::detail::phantom

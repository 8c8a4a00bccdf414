// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/report/body_output.h"
#include "mesamis/report/meshing_surface.h"
#include "mesamis/run/segment.h"

namespace mesamis::detail::run {

/// The objects whose elements are wanted, and where they lie.
struct ElementSource {
  std::span<const FoundObject> objects;
  const VoxelGrid& grid;              ///< that they were found on
  VolumeView scan;                    ///< on the same grid, native units; read for a body only
  const Parameters& used;             ///< by the run that found them
  std::optional<double> tolerance{};  ///< of decimation as it was asked for, mm
};

/// What the elements of objects are asked for.
struct ElementResults {
  std::optional<BodyOutput> body;
  std::string unmet;                    ///< what the body misses, see unmet(); empty: nothing
  std::string loose;                    ///< see loose_parts(); empty: nothing
  std::vector<TriMesh> skins;           ///< one per object, world frame (LPS), mm
  std::vector<MeshingQuality> quality;  ///< of these skins
};

/// Fills objects with elements once, for all that is asked for; nothing if nothing is.
/// @throws InputError  as complete_request(), fill_objects() and make_body_output().
/// @throws Cancelled   if progress says stop.
ElementResults make_elements(const ElementRequest& request, const ElementSource& source,
                             const Progress& progress);

}  // namespace mesamis::detail::run

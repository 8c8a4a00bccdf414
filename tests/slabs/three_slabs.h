// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/extract.h"
#include "slabs/small_run.h"

namespace mesamis::detail {

/// Three slabs with their last mesh.
struct ThreeSlabs {
  ThreeSlabs() {
    make_item_file<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
    each([&](Index s) { return prepare_and_minimise(small.run, s); });
    mesh.emplace(small.run);
    each([&](Index s) { return first_mesh(*mesh, s); });
    at_borders([&](Index s) { return seam(*mesh, 1, s); });
    each([&](Index s) { return finish(*mesh, 1, s); });
    run.emplace(*mesh, 1);
  }
  void each(const std::function<SlabWork(Index)>& task) {
    for (Index s = 0; s < 3; ++s) task(s);
  }
  void at_borders(const std::function<SlabWork(Index)>& task) {
    for (Index s = 0; s < 2; ++s) task(s);
  }
  void extract() {
    each([&](Index s) { return extract_slab(*run, s); });
    learn_follows(*run);
  }
  void follow() {
    each([&](Index s) { return follow_slab(*run, s); });
    at_borders([&](Index s) { return follow_border(*run, s); });
  }
  void choose() {
    each([&](Index s) { return list_parts(*run, s); });
    learn_parts(*run);
    each([&](Index s) { return cross_rays(*run, s); });
    learn_choice(*run, {});
  }
  void decimate(double tolerance) {
    run->parameters.tolerance = tolerance;
    each([&](Index s) { return decimate_slab(*run, s); });
    at_borders([&](Index s) { return decimate_border(*run, s); });
    each([&](Index s) { return measure_slab(*run, s); });
  }
  /// As it would be extracted from the whole mesh.
  TriMesh whole_surface() const {
    const Piece whole = collect(*mesh, 1);
    const Parameters& p = mesh->input.parameters;
    return extract_solid(whole.mesh, values_of(whole, &NodeValues::u), p.grey.to_grey(p.level));
  }
  SurfacePiece extracted() const {
    std::vector<SurfacePiece> pieces;
    for (Index s = 0; s < 3; ++s) {
      pieces.push_back(read_surface(small.scratch, surface_file("extracted", s)));
    }
    return join(pieces);
  }
  double voxel() const { return 1 / mesh->input.parameters.unit_mm; }

  SmallRun small{96, {0, 32, 64, 96}};
  std::optional<MeshRun> mesh;
  std::optional<SurfaceRun> run;
};

}  // namespace mesamis::detail

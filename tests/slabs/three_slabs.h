// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <vector>

#include "mesamis/method/deliver.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/surface_files.h"
#include "slabs/small_run.h"

namespace mesamis {

/// Meshes that are remeshed to the end: few cells, of which none may be out of place.
inline Settings finished_settings() {
  Settings settings = quick_settings();
  settings.drafts = false;
  settings.max_tets = 20'000;
  return settings;
}

/// Three slabs with their last mesh, made once for all tests of a process.
inline const SmallRun& meshed_slabs() {
  static const SmallRun small(96, {0, 32, 64, 96}, finished_settings());
  [[maybe_unused]] static const bool made = [] {
    make_item_file<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
    for (Index s = 0; s < 3; ++s) prepare_and_minimise(small.run, s);
    const MeshRun mesh(small.run);
    for (Index s = 0; s < 3; ++s) first_mesh(mesh, s);
    for (Index s = 0; s < 2; ++s) seam(mesh, 1, s);
    for (Index s = 0; s < 3; ++s) finish(mesh, 1, s);
    return true;
  }();
  return small;
}

/// Suites of tests that begin with these slabs.
class OnMeshedSlabs : public testing::Test {
 protected:
  static void SetUpTestSuite() { meshed_slabs(); }
};

/// These slabs, in a folder of their own.
struct ThreeSlabs {
  ThreeSlabs() : small(meshed_slabs()) {
    mesh.emplace(small.run);
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
    return extract_solid(whole.mesh, values_of(whole, &NodeValues::u), p.grey.to_grey(p.level),
                         solid_options(mesh->input));
  }
  SurfacePiece extracted() const {
    std::vector<SurfacePiece> pieces;
    for (Index s = 0; s < 3; ++s) {
      pieces.push_back(read_surface(small.scratch, surface_file("extracted", s)));
    }
    return join(pieces);
  }
  double voxel() const { return 1 / mesh->input.parameters.unit_mm; }

  SmallRun small;
  std::optional<MeshRun> mesh;
  std::optional<SurfaceRun> run;
};

}  // namespace mesamis

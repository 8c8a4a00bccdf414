// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/tasks.h"
#include "slabs/small_run.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::int64_t cells_of_first_meshes = 0;  // as their tasks tell it

/// Two slabs with mesh 1, its border adapted; made once.
const SmallRun& two_meshed_slabs() {
  static const SmallRun small(72, {0, 33, 72});
  [[maybe_unused]] static const bool made = [] {
    make_item_file<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
    for (Index s = 0; s < 2; ++s) prepare_and_minimise(small.run, s);
    const MeshRun run(small.run);
    for (Index s = 0; s < 2; ++s) cells_of_first_meshes += first_mesh(run, s).cells;
    seam(run, 1, 0);
    return true;
  }();
  return small;
}

/// The same after a pass: mesh 2, its border not yet adapted; made once.
const SmallRun& two_adapted_slabs() {
  static const SmallRun small(two_meshed_slabs());
  [[maybe_unused]] static const bool made = [] {
    MeshRun run(small.run);
    for (Index s = 0; s < 2; ++s) solve(run, 1, s);
    plan_next_mesh(run);
    for (Index s = 0; s < 2; ++s) adapt_slab(run, 2, s);
    return true;
  }();
  return small;
}

/// These slabs, in a folder of their own.
struct TwoSlabs {
  explicit TwoSlabs(int meshes = 1)
      : small(meshes == 1 ? two_meshed_slabs() : two_adapted_slabs()) {
    run.emplace(small.run);
    if (meshes == 2) plan_next_mesh(*run);
  }
  Piece read(const std::string& name) const {
    ArchiveReader archive = small.scratch.read(name);
    return next_piece(archive);
  }
  /// Both slabs and what lies between.
  Piece whole(const std::string& k) const {
    std::vector<Piece> pieces;
    for (const char* name : {"core.K.0", "rim.K.0.high", "seam.K.0", "rim.K.1.low", "core.K.1"}) {
      pieces.push_back(read(std::string(name).replace(std::string(name).find('K'), 1, k)));
    }
    std::vector<const Piece*> all(pieces.size());
    std::transform(pieces.begin(), pieces.end(), all.begin(), [](const Piece& p) { return &p; });
    return join(all);
  }
  SmallRun small;
  std::optional<MeshRun> run;
};

/// The largest difference of u at nodes of both pieces.
double largest_difference(const Piece& a, const Piece& b) {
  std::map<std::array<double, 3>, double> u;
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    const Vec3& p = a.mesh.points[n];
    u[{p.x, p.y, p.z}] = a.nodes[n].u;
  }
  double largest = 0;
  int common = 0;
  for (std::size_t n = 0; n < b.nodes.size(); ++n) {
    const Vec3& p = b.mesh.points[n];
    const auto place = u.find({p.x, p.y, p.z});
    if (place == u.end()) continue;
    ++common;
    largest = std::max(largest, std::abs(place->second - b.nodes[n].u));
  }
  EXPECT_GT(common, 20);
  return largest;
}

class OnTwoMeshedSlabs : public testing::Test {
 protected:
  static void SetUpTestSuite() { two_meshed_slabs(); }
};
using FirstMesh = OnTwoMeshedSlabs;
using Seam = OnTwoMeshedSlabs;
class OnTwoAdaptedSlabs : public testing::Test {
 protected:
  static void SetUpTestSuite() { two_adapted_slabs(); }
};
using Finish = OnTwoAdaptedSlabs;
using AdaptSlab = OnTwoAdaptedSlabs;
using Collect = OnTwoMeshedSlabs;
using MeshTasks = OnTwoMeshedSlabs;

TEST_F(FirstMesh, TheSlabsFitTogether) {
  const TwoSlabs slabs;
  std::vector<Piece> pieces;
  for (const char* name : {"core.1.0", "rim.1.0.high", "border.1.0.high", "border.1.1.low",
                           "rim.1.1.low", "core.1.1"}) {
    pieces.push_back(slabs.read(name));
    EXPECT_FALSE(pieces.back().mesh.cells.empty()) << name;
  }
  const std::array<const Piece*, 6> all{&pieces[0], &pieces[1], &pieces[2],
                                        &pieces[3], &pieces[4], &pieces[5]};
  const Piece whole = join(all);
  EXPECT_EQ(find_flaw(whole.mesh, slabs.run->input.box), "");
  EXPECT_EQ(std::ssize(whole.mesh.cells), cells_of_first_meshes);
  // A border piece reaches no farther than its slab.
  const double border = slabs.run->plan(1).height(1);
  for (const Vec3& p : pieces[2].mesh.points) EXPECT_LE(p.z, border);
  for (const Vec3& p : pieces[3].mesh.points) EXPECT_GE(p.z, border);
}

TEST_F(Seam, FitsBetweenTheSlabsAndCrossesTheirBorder) {
  const TwoSlabs slabs;
  EXPECT_EQ(find_flaw(slabs.whole("1").mesh, slabs.run->input.box), "");
  const Piece middle = slabs.read("seam.1.0");
  const double border = slabs.run->plan(1).height(1);
  const auto crosses = [&](const Cell& cell) {
    bool below = false, above = false;
    for (const Index corner : cell) {
      const double z = middle.mesh.points[static_cast<std::size_t>(corner)].z;
      below |= z < border;
      above |= z > border;
    }
    return below && above;
  };
  EXPECT_GT(std::count_if(middle.mesh.cells.begin(), middle.mesh.cells.end(), crosses), 20)
      << "the plane of the cut is gone";
}

TEST_F(Seam, ANodeOfTwoPiecesHasTheSameValuesInBoth) {
  // Else the result would depend on which of them is read first.
  const TwoSlabs slabs;
  const Piece low = slabs.read("rim.1.0.high"), middle = slabs.read("seam.1.0");
  const std::array<const Piece*, 2> one{&low, &middle}, other{&middle, &low};
  EXPECT_LT(largest_difference(join(one), join(other)), 1e-3) << "grey values";
}

TEST_F(Finish, BothSlabsHaveTheSameFieldsAtTheirBorder) {
  const TwoSlabs slabs(2);
  seam(*slabs.run, 2, 0);
  for (Index s = 0; s < 2; ++s) finish(*slabs.run, 2, s);
  const Piece low = slabs.read("final.2.0"), high = slabs.read("final.2.1");
  EXPECT_LT(largest_difference(low, high), 2.5) << "a hundredth of the contrast, grey values";
}

TEST_F(AdaptSlab, MeshesFitAndAreAsLargeAsAsked) {
  const TwoSlabs slabs(2);
  seam(*slabs.run, 2, 0);
  const Piece whole = slabs.whole("2");
  EXPECT_EQ(find_flaw(whole.mesh, slabs.run->input.box), "");
  const auto asked = static_cast<double>(slabs.run->input.cells_after(2));
  EXPECT_NEAR(static_cast<double>(whole.mesh.cells.size()) / asked, 1, 0.25);
  // Again, as after a run that was killed before the task was known to be done.
  const std::string core = read_bytes(slabs.small.scratch.path("core.2.1"));
  adapt_slab(*slabs.run, 2, 1);
  EXPECT_EQ(read_bytes(slabs.small.scratch.path("core.2.1")), core);
}

TEST_F(AdaptSlab, WhateverTouchesTheBorderIsAdaptedAgain) {
  // Else faces as they were cut from the mesh before would stay in the next one.
  const TwoSlabs slabs(2);
  const auto points = [&](const std::vector<std::string>& names) {
    std::set<std::array<double, 3>> places;
    for (const std::string& name : names) {
      for (const Vec3& p : slabs.read(name).mesh.points) places.insert({p.x, p.y, p.z});
    }
    return places;
  };
  const auto in_both = [](const auto& a, const auto& b) {
    return std::count_if(a.begin(), a.end(), [&](const auto& place) { return b.count(place) > 0; });
  };
  const auto low = points({"core.2.0", "rim.2.0.high"}), high = points({"core.2.1", "rim.2.1.low"});
  const auto at_low = points({"border.2.0.high"}), at_high = points({"border.2.1.low"});
  EXPECT_GT(in_both(at_low, at_high), 20);
  EXPECT_EQ(in_both(low, at_high), 0);
  EXPECT_EQ(in_both(high, at_low), 0);
  EXPECT_EQ(in_both(low, high), 0);
}

TEST_F(Collect, PutsTogetherWhatTheSlabsFinished) {
  const TwoSlabs slabs;
  const SlabWork work = finish(*slabs.run, 1, 0);
  finish(*slabs.run, 1, 1);
  EXPECT_GT(work.rows, 0);
  EXPECT_GT(work.bytes, 0) << "the rim of the slab above";
  require_full(*slabs.run, 1);
  const Piece whole = collect(*slabs.run, 1);
  EXPECT_EQ(find_flaw(whole.mesh, slabs.run->input.box), "");
  const std::vector<Iteration> passes = records_of(*slabs.run, 1);
  ASSERT_EQ(passes.size(), 2U) << "on the grid and on the mesh";
  EXPECT_EQ(passes[1].tets, std::ssize(whole.mesh.cells)) << "each cell once";
  EXPECT_EQ(passes[1].nodes, std::ssize(whole.mesh.points)) << "each node once";
  double sum = 0;
  for (const NodeValues& node : whole.nodes) sum += std::abs(node.u - node.f);
  EXPECT_LT(sum / static_cast<double>(whole.nodes.size()), 10) << "u is near the image";
  const MeshFit fit = fit_of(*slabs.run, 1);
  const MeshFit exact = measure_fit(whole.mesh, values_of(whole, &NodeValues::metric));
  EXPECT_EQ(fit.quality_min, exact.quality_min);
  EXPECT_NEAR(fit.quality_mean, exact.quality_mean, 1e-9);
  EXPECT_NEAR(fit.unit_edge_fraction, exact.unit_edge_fraction, 0.01) << "some edges count twice";
}

TEST_F(MeshTasks, RefuseFilesThatAreCutOff) {
  const TwoSlabs slabs;
  const auto file = slabs.small.scratch.path("seam.1.0");
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_REFUSED(solve(*slabs.run, 1, 0), HasSubstr("seam.1.0: "));
  std::filesystem::remove(file);
  EXPECT_REFUSED(finish(*slabs.run, 1, 1), HasSubstr("seam.1.0: "));
  std::filesystem::resize_file(slabs.small.scratch.path("image"), 1000);
  EXPECT_REFUSED(MeshRun(slabs.small.run), HasSubstr("image: "));
}

}  // namespace
}  // namespace mesamis

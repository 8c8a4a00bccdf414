// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/method/mes_amis.h"
#include "slabs/three_slabs.h"

namespace mesamis {
namespace {

using FindGrey = OnMeshedSlabs;

TEST_F(FindGrey, IsThatOfTheWholeMesh) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  slabs.decimate(0.1);
  slabs.each([&](Index s) { return find_grey(*slabs.run, s); });
  Result whole;
  whole.surface = decimated_surface(*slabs.run);
  const Piece mesh = collect(*slabs.mesh, 1);
  whole.mesh = mesh.mesh;
  bring_to_world(slabs.mesh->input, whole.mesh.points);
  whole.u = values_of(mesh, &NodeValues::u);
  const std::vector<double> expected = surface_grey(whole, 1);
  const std::vector<double> found = grey_of(*slabs.run, whole.surface);
  ASSERT_EQ(found.size(), expected.size());
  // The surface is rounded in one, and values at borders are those of two slabs in the other.
  for (std::size_t p = 0; p < found.size(); ++p) EXPECT_NEAR(found[p], expected[p], 1) << p;
}

}  // namespace
}  // namespace mesamis

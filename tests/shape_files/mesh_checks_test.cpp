// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/mesh_checks.h"

#include <gmock/gmock.h>

#include <cmath>

#include "shape_files/finite_element_example.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(MeshChecks, CellsAreCountedPerSet) {
  const CellSets sets{{{"A", ""}, {"B", ""}, {"C", ""}}, {2, 0, 2, 2}};
  EXPECT_EQ(cells_per_set(sets), (std::vector<std::int64_t>{1, 0, 3}));
}

/// Both finite element formats refuse the same, and leave no file.
TEST(MeshChecks, WhatDoesNotFitIsRefused) {
  const TempFolder folder;
  using Example = FiniteElementExample;
  const auto refused = [&folder](const Example& e, const std::string& words) {
    EXPECT_REFUSED(write_gmsh(folder / "m.msh", e.grid, e.sets), HasSubstr(words));
    EXPECT_REFUSED(write_abaqus(folder / "m.inp", e.grid.mesh, e.sets), HasSubstr(words));
  };
  Example e;
  e.sets.of_cell.pop_back();
  refused(e, "expected a set for each of 144 cells, found 143");
  e = {};
  e.sets.of_cell[5] = 3;
  refused(e, "a cell names set 3, there are 3");
  e = {};
  e.grid.mesh.cells[5][1] = 5000;
  refused(e, "a cell names a missing point");
  e = {};
  e.grid.mesh.points[5].y = std::nan("");
  refused(e, "not finite");
  e = {};
  e.grid.mesh = {};
  refused(e, "without cells");
  EXPECT_EQ(folder.file_count(), 0);
  const Example whole;
  EXPECT_THROW(write_abaqus(folder / "no/m.inp", whole.grid.mesh, whole.sets), InputError);
}

}  // namespace
}  // namespace mesamis

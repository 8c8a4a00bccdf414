// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/vtk_data.h"

#include <gmock/gmock.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMassProperties.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::HasSubstr;

Vec3 point_of(vtkDataSet& data, vtkIdType n) {
  std::array<double, 3> p{};
  data.GetPoint(n, p.data());
  return {p[0], p[1], p[2]};
}

TEST(VtkData, PointsKeepEveryBit) {
  const std::vector<Vec3> points{{1.0 / 3, -1e-300, 1e300}, {0.1, 123456789.123456789, -0.0}};
  const auto same = vtk_points(points);
  ASSERT_EQ(same->GetNumberOfPoints(), 2);
  for (vtkIdType n = 0; n < 2; ++n) {
    std::array<double, 3> p{};
    same->GetPoint(n, p.data());
    EXPECT_EQ((Vec3{p[0], p[1], p[2]}), points[static_cast<std::size_t>(n)]);
  }
  EXPECT_EQ(vtk_points({})->GetNumberOfPoints(), 0);
}

TEST(VtkData, SurfacesKeepPointsTrianglesAndVolume) {
  const TriMesh surface = cube();
  const auto same = vtk_surface(surface);
  ASSERT_EQ(same->GetNumberOfPoints(), std::ssize(surface.points));
  ASSERT_EQ(same->GetNumberOfCells(), std::ssize(surface.triangles));
  for (vtkIdType t = 0; t < same->GetNumberOfCells(); ++t) {
    vtkIdList* corners = same->GetCell(t)->GetPointIds();
    ASSERT_EQ(corners->GetNumberOfIds(), 3);
    for (vtkIdType i = 0; i < 3; ++i) {
      EXPECT_EQ(corners->GetId(i),
                surface.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(i)]);
    }
  }
  auto properties = vtkSmartPointer<vtkMassProperties>::New();
  properties->SetInputData(same);
  EXPECT_NEAR(properties->GetVolume(), check_surface(surface).volume, 1e-12);
}

TEST(VtkData, GridsKeepPointsAndThePositiveVolumeOfEachCell) {
  const TetMesh mesh = box_mesh({{-1, 0, 2}, {1, 3, 7}}, {2, 1, 3});
  const auto grid = vtk_grid(mesh);
  ASSERT_EQ(grid->GetNumberOfCells(), std::ssize(mesh.cells));
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    ASSERT_EQ(grid->GetCellType(c), VTK_TETRA);
    std::array<Vec3, 4> p;
    for (int i = 0; i < 4; ++i) {
      p[static_cast<std::size_t>(i)] = point_of(*grid, grid->GetCell(c)->GetPointId(i));
    }
    EXPECT_EQ(six_volume(p[0], p[1], p[2], p[3]) / 6, cell_volume(mesh, static_cast<Index>(c)));
  }
  EXPECT_EQ(vtk_grid({})->GetNumberOfCells(), 0);
}

TEST(VtkData, ArraysAreAddedWithTheirNameAndComponents) {
  const auto surface = vtk_surface(cube());
  const MeshArray array{"normal", 3, {1, 2, 3, 4, 5, 6}};
  add_array(*surface->GetPointData(), array, 2, "point");
  vtkDataArray* same = surface->GetPointData()->GetArray("normal");
  ASSERT_NE(same, nullptr);
  ASSERT_EQ(same->GetNumberOfTuples(), 2);
  ASSERT_EQ(same->GetNumberOfComponents(), 3);
  EXPECT_EQ(same->GetComponent(1, 0), 4);
  EXPECT_EQ(same->GetComponent(0, 2), 3);
}

TEST(VtkData, ArraysOfAnotherSizeAreRefused) {
  const auto surface = vtk_surface(cube());
  const MeshArray array{"u", 2, {1, 2, 3, 4}};
  for (const std::size_t count : {0u, 1u, 3u, 4u}) {
    EXPECT_REFUSED(add_array(*surface->GetPointData(), array, count, "point"),
                   HasSubstr("point array 'u' has 4 values, expected " + std::to_string(count)));
  }
  for (const int components : {0, -1}) {
    const MeshArray none{"u", components, {}};
    EXPECT_REFUSED(add_array(*surface->GetPointData(), none, 0, "point"), HasSubstr("'u'"));
  }
  EXPECT_EQ(surface->GetPointData()->GetNumberOfArrays(), 0);
}

}  // namespace
}  // namespace mesamis::detail

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/mesh_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "support/ball_volume.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

class MeshOutputTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    volume = new Volume(make_ball({.size = 20, .radius = 6}));
    Settings settings;
    settings.max_tets = 3000;
    settings.adaptations = 2;
    result = new Result(mes_amis(*volume, settings));
  }
  static void TearDownTestSuite() {
    delete result;
    delete volume;
  }
  static inline const Volume* volume = nullptr;
  static inline const Result* result = nullptr;
};

TEST_F(MeshOutputTest, TheBoxIsTheWholeMeshWithOneValuePerNodeAndCell) {
  const MeshOutput out = make_mesh_output(*result, *volume, {});
  EXPECT_EQ(out.grid.mesh.cells, result->mesh.cells);
  EXPECT_NEAR(out.volume, 19.0 * 19 * 19, 1e-6);
  EXPECT_EQ(out.components, 1);
  for (const MeshArray& array : out.grid.point_arrays) {
    EXPECT_EQ(array.values.size(),
              static_cast<std::size_t>(array.components) * out.grid.mesh.points.size())
        << array.name;
  }
  for (const MeshArray& array : out.grid.cell_arrays) {
    EXPECT_EQ(array.values.size(), out.grid.mesh.cells.size()) << array.name;
  }
}

TEST_F(MeshOutputTest, TheBinsShareTheCellsAndTheirVolume) {
  const MeshOutput out =
      make_mesh_output(*result, *volume, {.region = MeshRegion::kObject, .bins = 5});
  ASSERT_EQ(out.bins.size(), 5u);
  std::int64_t cells = 0;
  double sum = 0;
  for (const MeshBin& bin : out.bins) {
    cells += bin.cells;
    sum += bin.volume;
    if (bin.cells == 0) continue;
    EXPECT_GE(bin.native_mean, bin.low - 1e-9);
    EXPECT_LE(bin.native_mean, bin.high + 1e-9);
  }
  EXPECT_EQ(cells, std::ssize(out.grid.mesh.cells));
  EXPECT_NEAR(sum, out.volume, 1e-9 * out.volume);
  EXPECT_LT(out.volume, 0.5 * 19 * 19 * 19) << "the object alone";
}

TEST_F(MeshOutputTest, LabelsShareTheCellsAndGoWithThem) {
  const FoundObject ball{result->surface, {"ball", 5, 0, {}}};
  const MeshOutput box = make_mesh_output(*result, *volume, {}, {&ball, 1});
  const MeshOutput object =
      make_mesh_output(*result, *volume, {.region = MeshRegion::kObject}, {&ball, 1});
  ASSERT_EQ(box.bins.size(), 2u);
  EXPECT_EQ(box.sets.sets[1].name, "L5_ball");
  EXPECT_EQ(box.bins[0].cells + box.bins[1].cells, std::ssize(box.grid.mesh.cells));
  EXPECT_EQ(box.grid.cell_arrays.back().name, "label");
  EXPECT_EQ(std::ssize(object.grid.mesh.cells), box.bins[1].cells);
  EXPECT_EQ(object.grid.cell_arrays.back().values,
            std::vector<double>(object.grid.mesh.cells.size(), 5));
  const double truth = check_surface(result->surface).volume;
  EXPECT_NEAR(object.volume, truth, 0.05 * truth);
  EXPECT_GT(object.bins[1].native_mean, box.bins[0].native_mean);
}

TEST_F(MeshOutputTest, ObjectsWithoutACellAreRefused) {
  EXPECT_REFUSED(make_mesh_output(*result, *volume, {.region = MeshRegion::kObject},
                                  std::span<const FoundObject>{}),
                 testing::HasSubstr("expected cells within an object"));
}

TEST_F(MeshOutputTest, AnEmptyObjectIsRefused) {
  Result empty = *result;
  empty.parameters.level = 1e6;
  EXPECT_REFUSED(make_mesh_output(empty, *volume, {.region = MeshRegion::kObject}),
                 testing::HasSubstr("mesh region: expected cells with u above the level"));
}

TEST_F(MeshOutputTest, EveryFormatHoldsTheSameCells) {
  const TempFolder folder;
  const MeshOutput out = make_mesh_output(*result, *volume, {});
  for (const std::string& extension : written_mesh_formats()) {
    write_mesh(folder / ("a" + extension), out, Frame::kLps);
    EXPECT_GT(read_bytes(folder / ("a" + extension)).size(), 1000u) << extension;
  }
  EXPECT_EQ(read_vtu(folder / "a.vtu").mesh.cells, out.grid.mesh.cells);
  EXPECT_EQ(read_medit_mesh(folder / "a.mesh").cells, out.grid.mesh.cells);
}

TEST_F(MeshOutputTest, TheBandIsWhereVIsSmall) {
  const TempFolder folder;
  write_band_mesh(folder / "band.vtu", *result, Frame::kLps);
  const MeshWithArrays band = read_vtu(folder / "band.vtu");
  ASSERT_FALSE(band.mesh.cells.empty());
  const auto& v = band.point_arrays.at(0).values;
  for (const Cell& cell : band.mesh.cells) {
    const double mean = (v[cell[0]] + v[cell[1]] + v[cell[2]] + v[cell[3]]) / 4;
    EXPECT_LT(mean, result->parameters.band_threshold);
  }
}

}  // namespace
}  // namespace mesamis

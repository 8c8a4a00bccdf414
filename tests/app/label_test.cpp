// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/surface/tri_mesh.h"
#include "support/run_program.h"
#include "support/scan_bytes.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A grid that is turned, and left-handed where asked for, around a point.
LabelMap turned_map(bool left_handed) {
  LabelMap map;
  const double c = std::cos(0.6), s = std::sin(0.6);
  map.size = {40, 36, 30};
  map.spacing = {0.7, 0.8, 1.1};
  map.direction = Mat3{{Vec3{c, 0, -s}, Vec3{0, left_handed ? -1.0 : 1.0, 0}, Vec3{s, 0, c}}};
  map.origin = Vec3{} - map.direction * Vec3{0.7 * 19.5, 0.8 * 17.5, 1.1 * 14.5};
  map.layers = {std::vector<std::uint16_t>(map.voxel_count())};
  return map;
}

TEST(Label, MarksExactlyTheVoxelCentresInsideOnAnyGrid) {
  const TempFolder folder;
  for (const bool left_handed : {false, true}) {
    const LabelMap scan = turned_map(left_handed);
    write_label_map(folder / "scan.nrrd", scan);
    write_surface(folder / "box.ply", cube({-5, -4, -6}, 9), {});
    const ProgramRun run = run_program(folder, {"label", folder / "box.ply", "--like",
                                                folder / "scan.nrrd", "-o", folder / "m.nii.gz"});
    ASSERT_EQ(run.status, 0) << run.err;
    const LabelMap mask = read_label_map(folder / "m.nii.gz").map;
    std::size_t inside = 0;
    for (std::size_t n = 0; n < scan.voxel_count(); ++n) {
      const auto [i, j, k] = scan.voxel(n);
      const Vec3 p = scan.to_world({i * 0.7, j * 0.8, k * 1.1});
      const bool in = p.x > -5 && p.x < 4 && p.y > -4 && p.y < 5 && p.z > -6 && p.z < 3;
      inside += in ? 1 : 0;
      ASSERT_EQ(mask.layers[0][n], in ? 1 : 0) << i << " " << j << " " << k;
    }
    EXPECT_THAT(run.out, HasSubstr("  1  box  " + std::to_string(inside) + " voxels"));
  }
}

TEST(Label, ComesInAgainAsALabelOfTheSameVolume) {
  const TempFolder folder;
  write_label_map(folder / "scan.nrrd", turned_map(false));
  write_surface(folder / "a.stl", cube({-5, -4, -6}, 10), {});
  ASSERT_EQ(run_program(folder, {"label", folder / "a.stl", "--like", folder / "scan.nrrd", "-o",
                                 folder / "m.seg.nrrd"})
                .status,
            0);
  ASSERT_EQ(
      run_program(folder, {"segment", "--labels", folder / "m.seg.nrrd", "-o", folder / "b.ply"})
          .status,
      0);
  const SurfaceCheck check = check_surface(read_surface(folder / "b.ply"));
  EXPECT_TRUE(check.closed());
  EXPECT_NEAR(check.volume, 1000, 0.5 * 0.87 * 600);  // half a layer of voxels
}

TEST(Label, SeveralSurfacesAreSeveralLabels) {
  const TempFolder folder;
  LabelMap grid = turned_map(false);
  grid.direction = {};
  grid.origin = {-13, -14, -16};
  write_label_map(folder / "scan.nrrd", grid);
  const std::vector<NamedSurface> pair{{"hip", {255, 0, 0}, 4, cube({-9, -9, -9}, 6)},
                                       {"femur", {0, 255, 0}, 7, cube({2, 2, 2}, 6)}};
  write_objects(folder / "pair.3mf", pair);
  write_surface(folder / "third.stl", cube({-8, -8, -8}, 6), {.frame = Frame::kRas});
  const auto label = [&](const std::vector<std::string>& surfaces, const std::string& out) {
    std::vector<std::string> words{"label"};
    words.insert(words.end(), surfaces.begin(), surfaces.end());
    words.insert(words.end(), {"--like", folder / "scan.nrrd", "-o", folder / out});
    return run_program(folder, words);
  };
  ASSERT_EQ(label({folder / "pair.3mf"}, "m.nii").status, 0);
  const LabelMap map = read_label_map(folder / "m.nii").map;
  EXPECT_EQ(find_segment(map.segments, "hip"), (Segment{"hip", 4, 0, {255, 0, 0}}));
  EXPECT_EQ(label_at(map, 0, {5, 5, 5}), 7);
  // The third one states its frame and overlaps the first one, whose number it has.
  const ProgramRun run = label({folder / "pair.3mf", folder / "third.stl"}, "m.seg.nrrd");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("'third' overlaps another surface"));
  const LabelMap layers = read_label_map(folder / "m.seg.nrrd").map;
  ASSERT_EQ(layers.layers.size(), 2u);
  EXPECT_EQ(label_at(layers, 1, {-5, -5, -5}), find_segment(layers.segments, "third").label);
  EXPECT_EQ(label_at(layers, 0, {-5, -5, -5}), find_segment(layers.segments, "hip").label);
  EXPECT_EQ(label({folder / "pair.3mf", folder / "third.stl"}, "n.nii").status, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "n.nii"));
}

TEST(Label, FilesWithoutAFrameAreInTheOneThatIsGiven) {
  const TempFolder folder;
  LabelMap grid = turned_map(false);
  grid.direction = {};
  grid.origin = {-13, -14, -16};
  write_label_map(folder / "scan.nrrd", grid);
  write_bytes(folder / "a.obj",
              "v 1 1 1\nv 9 1 1\nv 1 9 1\nv 1 1 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  for (const std::string frame : {"lps", "ras"}) {
    const ProgramRun run =
        run_program(folder, {"label", folder / "a.obj", "--like", folder / "scan.nrrd", "-o",
                             folder / "m.nrrd", "--frame", frame});
    ASSERT_EQ(run.status, 0) << run.err;
    const double sign = frame == "ras" ? -1 : 1;
    EXPECT_EQ(label_at(read_label_map(folder / "m.nrrd").map, 0, {sign * 2.5, sign * 2.5, 2.5}), 1);
  }
}

TEST(Label, RefusesWhatHasNoInside) {
  const TempFolder folder;
  write_label_map(folder / "scan.nrrd", turned_map(false));
  write_bytes(folder / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_surface(folder / "far.ply", cube({500, 0, 0}, 5), {});
  const auto refused = [&](const std::string& surface, int status, const char* why) {
    const ProgramRun run = run_program(folder, {"label", folder / surface, "--like",
                                                folder / "scan.nrrd", "-o", folder / "m.nrrd"});
    EXPECT_EQ(run.status, status);
    EXPECT_THAT(run.err, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(folder / "m.nrrd"));
  };
  refused("open.obj", 3, "expected a closed surface, found");
  refused("far.ply", 3, "found none inside");
  EXPECT_EQ(run_program(folder, {"label", folder / "far.ply", "--like", folder / "scan.nrrd", "-o",
                                 folder / "m.stl"})
                .status,
            2);
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
// `mesamis segment` with the options that say which object is meant.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/write_labels.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/ball_volume.h"
#include "support/run_program.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const Vec3 kLeft{12, 12, 12}, kRight{26, 12, 12};

/// Two balls of 7 mm that touch, 200 in 100.
Volume two_balls() {
  return sampled_volume({40, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    return 100 + 100 * std::max(blurred_ball(norm(p - kLeft), 7, 0.7),
                                blurred_ball(norm(p - kRight), 7, 0.7));
  });
}

/// The left ball, marked.
LabelMap left_ball() {
  LabelMap map;
  map.size = {40, 25, 25};
  map.segments = {{"left", 1, 0, {}}};
  map.layers.resize(1);
  for (Index k = 0; k < 25; ++k) {
    for (Index j = 0; j < 25; ++j) {
      for (Index i = 0; i < 40; ++i) {
        map.layers[0].push_back(norm(Vec3{double(i), double(j), double(k)} - kLeft) < 6.5 ? 1 : 0);
      }
    }
  }
  return map;
}

class SegmentObject : public testing::Test {
 protected:
  SegmentObject() { write_nrrd(folder / "balls.nrrd", two_balls()); }

  ProgramRun segment(std::vector<std::string> more, const std::string& output = "a.stl") {
    std::vector<std::string> arguments{
        "segment",  folder / "balls.nrrd", "-o",       folder / output,
        "--report", folder / "a.json",     "--preview"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder, arguments);
  }
  nlohmann::json report() { return nlohmann::json::parse(read_bytes(folder / "a.json")); }

  /// All points of the surface lie at a ball.
  void expect_ball(const Vec3& middle) {
    const TriMesh surface = read_surface(folder / "a.stl");
    EXPECT_TRUE(check_surface(surface).closed());
    for (const Vec3& p : surface.points) ASSERT_LT(norm(p - middle), 8.5);
  }

  TempFolder folder;
};

TEST_F(SegmentObject, SeveralSeedsSplitWhatTouchesInTheFrameOfTheFiles) {
  const ProgramRun run = segment(
      {"--seed", "-12,-12,12", "--seed", "-26,-12,12", "--frame", "ras", "--quiet"}, "a.vtp");
  EXPECT_EQ(run.status, 0) << run.err;
  const auto parts = read_objects(folder / "a.vtp");
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) EXPECT_EQ(solid_flaws_of(check_surface(part.surface)), "");
  EXPECT_EQ(report()["object"]["surfaces"].size(), 2U);
  EXPECT_EQ(report()["object"]["seeds_mm"][0].dump(), "[12.0,12.0,12.0]") << "LPS";
}

TEST_F(SegmentObject, BoxAndSeedLeaveAnIsland) {
  EXPECT_EQ(segment({"--box", ":18,,", "--seed", "12,12,12", "--quiet"}).status, 0);
  expect_ball(kLeft);
  EXPECT_EQ(report()["surface"]["islands"], 1);
}

TEST_F(SegmentObject, MaskAndRemoveAreTheOtherWayRound) {
  write_label_map(folder / "left.nrrd", left_ball());
  EXPECT_EQ(
      segment({"--mask", folder / "left.nrrd", "--margin", "1", "--keep-largest", "1", "--quiet"})
          .status,
      0);
  expect_ball(kLeft);
  EXPECT_EQ(report()["object"]["mask"]["margin_mm"], 1);
  EXPECT_EQ(report()["object"]["mask"]["path"], std::string(folder / "left.nrrd"));
  EXPECT_EQ(segment({"--remove", folder / "left.nrrd", "--keep-largest", "1", "--quiet"}).status,
            0);
  expect_ball(kRight);
  EXPECT_EQ(report()["object"]["removed"][0]["what"], "marked by a label map");
}

TEST_F(SegmentObject, ADarkTissueTellsNativeUnits) {
  EXPECT_EQ(segment({"--tissue", ":150", "--quiet"}).status, 0);
  EXPECT_EQ(report()["surface"]["level_native"], 150);
  EXPECT_EQ(report()["object"]["image"], "mirrored");
  const double box = 39.0 * 24 * 24;
  EXPECT_NEAR(report()["surface"]["volume_mm3"], box - 2 * 4.0 / 3 * M_PI * 343, 0.02 * box);
}

TEST_F(SegmentObject, RefusesInOneLineBeforeItReads) {
  write_bytes(folder / "balls.nrrd", "no scan");
  EXPECT_FAILS(segment({"--tissue", "wood"}), 2, "--tissue: expected bone, teeth");
  EXPECT_FAILS(segment({"-o", folder / "{label}.stl"}), 2,
               "--output: expected --labels or several --seed for {label}");
  EXPECT_FAILS(segment({"--seed", "1,2"}), 2, "--seed: point: expected X,Y,Z in mm");
  EXPECT_FAILS(segment({"--box", "1:2,3"}), 2, "--box: expected X0:X1");
  EXPECT_FAILS(segment({"--box", "1:20,,", "--crop", "1:9,,"}), 2,
               "--box: expected it without --crop");
  EXPECT_FAILS(segment({"--remove", "body", "--keep-surroundings"}), 2, "--remove body: expected");
  EXPECT_FAILS(segment({"--margin", "1"}), 2, "--margin: expected --labels or --mask beside it");
  EXPECT_FAILS(segment({"--labels", folder / "x.nrrd", "--tissue", "bone"}), 2,
               "--labels: expected it without");
  const std::vector<std::string> mesh{"--mesh", folder / "a.vtu"};
  const auto with_mesh = [&](std::vector<std::string> more) {
    more.insert(more.end(), mesh.begin(), mesh.end());
    return segment(more);
  };
  EXPECT_FAILS(with_mesh({"--tissue", "dark"}), 2, "--mesh: expected a bright --tissue");
  EXPECT_FAILS(run_program(folder, {"segment", "--labels", folder / "x.nrrd", "-o",
                                    folder / "a.stl", "--remove", "body"}),
               2, "expected a scan");
}

TEST_F(SegmentObject, RefusesInOneLineWhatDoesNotFitTheScan) {
  EXPECT_FAILS(segment({"--seed", "500,2,3"}), 3, "expected one within the scan");
  EXPECT_FAILS(segment({"--box", "500:600,,"}), 3, "box: expected at least 2 voxels");
  EXPECT_FAILS(segment({"--remove", "body"}), 3, "remove: expected a patient's body");
  EXPECT_FAILS(segment({"--tissue", "bone"}), 3, "Hounsfield");
  EXPECT_FAILS(segment({"--tissue", "6000:7000"}), 3, "found 6000:7000");
  EXPECT_FAILS(segment({"--mask", folder / "none.nrrd"}), 3, "none.nrrd");
  EXPECT_EQ(folder.file_count(), 3) << "the scan, stdout and stderr";
}

/// A patient of soft tissue with a spine, above a table.
Volume patient() {
  Volume volume = sampled_volume({60, 55, 12}, {4, 4, 4}, [](const Vec3& p) {
    if (std::hypot(p.x - 120, p.y - 120) < 16) return 700.0;
    if (std::hypot((p.x - 120) / 90, (p.y - 90) / 60) < 1) return 40.0;
    return p.y > 180 && p.y < 190 ? 1000.0 : -1000.0;
  });
  return volume;
}

TEST(SegmentPatient, WithoutTheTableUnlessItIsKept) {
  const TempFolder folder;
  write_nrrd(folder / "ct.nrrd", patient());
  const auto segment = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"segment", folder / "ct.nrrd", "-o", folder / "a.stl", "--report",
                               folder / "a.json", "--preview"});
    const ProgramRun run = run_program(folder, more);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.err;
  };
  const auto lowest = [&] {
    const TriMesh surface = read_surface(folder / "a.stl");
    return bounding_box(surface.points).hi.y;
  };
  EXPECT_THAT(segment({}), HasSubstr("removed: table or head rest, "));
  EXPECT_LT(lowest(), 150);
  EXPECT_EQ(segment({"--keep-surroundings"}).find("removed"), std::string::npos);
  EXPECT_GT(lowest(), 180);
}

}  // namespace
}  // namespace mesamis

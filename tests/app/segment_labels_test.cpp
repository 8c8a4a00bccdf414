// SPDX-License-Identifier: Apache-2.0
// `mesamis segment` with a label map.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/triangle_tree.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/ball_volume.h"
#include "support/run_program.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const Vec3 kLeft{12, 12, 12}, kRight{26, 12, 12};
constexpr double kRadius = 7;

int label_at(const Vec3& p) {
  if (norm(p - kLeft) < kRadius) return 1;
  return norm(p - kRight) < kRadius ? 2 : 0;
}

/// Two balls that touch, 200 and 160 in 100.
Volume two_balls() {
  return sampled_volume({40, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    return 100 + std::max(100 * blurred_ball(norm(p - kLeft), kRadius, 0.7),
                          60 * blurred_ball(norm(p - kRight), kRadius, 0.7));
  });
}

/// Their labels on every second voxel.
LabelMap coarse_labels() {
  LabelMap map;
  map.size = {20, 13, 13};
  map.spacing = {2, 2, 2};
  map.segments = {{"left ball", 1, 0, {255, 0, 0}}, {"right ball", 2, 0, {0, 0, 255}}};
  map.layers.resize(1);
  for (Index k = 0; k < 13; ++k) {
    for (Index j = 0; j < 13; ++j) {
      for (Index i = 0; i < 20; ++i) {
        map.layers[0].push_back(static_cast<std::uint16_t>(label_at({2.0 * i, 2.0 * j, 2.0 * k})));
      }
    }
  }
  return map;
}

class SegmentLabels : public testing::Test {
 protected:
  SegmentLabels() {
    write_nrrd(folder / "balls.nrrd", two_balls());
    write_label_map(folder / "labels.nrrd", coarse_labels());
  }

  ProgramRun segment(std::vector<std::string> more) {
    std::vector<std::string> arguments{"segment", "--labels", folder / "labels.nrrd", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder, arguments);
  }

  TempFolder folder;
};

TEST_F(SegmentLabels, WritesAllObjectsNamedAndColoured) {
  const ProgramRun run = segment({folder / "balls.nrrd", "-o", folder / "all.vtp", "--report",
                                  folder / "a.json", "--labelmap", folder / "found.seg.nrrd"});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto objects = read_objects(folder / "all.vtp");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "left ball");
  EXPECT_EQ(objects[1].colour, (std::array<std::uint8_t, 3>{0, 0, 255}));
  for (const Vec3& p : objects[0].surface.points) EXPECT_NEAR(norm(p - kLeft), kRadius, 1.2);
  const auto report = nlohmann::json::parse(read_bytes(folder / "a.json"));
  EXPECT_EQ(report["object"]["surfaces"].size(), 2U);
  EXPECT_EQ(report["object"]["boundaries"][0]["placed_by"], "image");
  // What was found comes in again, with its names.
  const LabelMap found = read_label_map(folder / "found.seg.nrrd").map;
  EXPECT_EQ(found.size, (std::array<Index, 3>{40, 25, 25}));
  EXPECT_EQ(find_segment(found.segments, "right ball").label, 2);
  Index wrong = 0;
  for (Index k = 0; k < 25; ++k) {
    for (Index j = 0; j < 25; ++j) {
      for (Index i = 0; i < 40; ++i) {
        wrong += found.layers[0][found.offset(i, j, k)] != label_at({1.0 * i, 1.0 * j, 1.0 * k});
      }
    }
  }
  EXPECT_LT(wrong, 200) << "voxels: 0.16 of one over the balls' surfaces of 1230 mm^2";
}

TEST_F(SegmentLabels, NamesOneFilePerObject) {
  EXPECT_EQ(segment({folder / "balls.nrrd", "-o", folder / "b_{label}.stl"}).status, 0);
  EXPECT_TRUE(check_surface(read_surface(folder / "b_left_ball.stl")).closed());
  EXPECT_TRUE(check_surface(read_surface(folder / "b_right_ball.stl")).closed());
  EXPECT_EQ(segment({folder / "balls.nrrd", "--label", "2", "-o", folder / "one.stl"}).status, 0);
  const TriMesh one = read_surface(folder / "one.stl");
  double sum = 0, area = 0;
  for (const Triangle& t : one.triangles) {
    const Corners c = corners_of(one, t);
    const double third = norm(cross(c[1] - c[0], c[2] - c[0])) / 6;
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_LT(std::abs(norm(c[i] - kRight) - kRadius), 5)
          << "beyond the margin, two and a half labels";
      const Vec3 middle = 0.5 * (c[i] + c[(i + 1) % 3]);
      sum += third * std::abs(norm(middle - kRight) - kRadius);
      area += third;
    }
  }
  EXPECT_LT(sum / area, 0.25) << "voxels, over the area";
}

TEST_F(SegmentLabels, NeedsNoScan) {
  const ProgramRun run = segment({"-o", folder / "alone.3mf", "--report", folder / "a.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_objects(folder / "alone.3mf").size(), 2U);
  const auto report = nlohmann::json::parse(read_bytes(folder / "a.json"));
  EXPECT_FALSE(report.contains("input"));
}

TEST_F(SegmentLabels, ProbabilitiesPlaceTheSurfaceBetweenTheVoxels) {
  for (const Vec3& middle : {kLeft, kRight}) {
    const auto ramp = [&](const Vec3& p) {
      return std::clamp(0.5 + (kRadius - norm(p - middle)) / 3, 0.0, 1.0);
    };
    write_nrrd(folder / (middle.x == kLeft.x ? "left.nrrd" : "right.nrrd"),
               sampled_volume({40, 25, 25}, {1, 1, 1}, ramp));
  }
  const ProgramRun run = run_program(
      folder, {"segment", "--probabilities", folder / "left.nrrd", folder / "right.nrrd", "-o",
               folder / "p.vtp", "--tolerance", "0.01", "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto objects = read_objects(folder / "p.vtp");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "left");
  double sum = 0, count = 0;
  for (const Vec3& p : objects[0].surface.points) {
    if (p.x > 17) continue;  // away from where the balls touch
    sum += std::abs(norm(p - kLeft) - kRadius);
    ++count;
  }
  EXPECT_LT(sum / count, 0.05) << "voxels";
}

TEST_F(SegmentLabels, TheReportRepeatsTheRun) {
  const std::vector<std::string> common{folder / "balls.nrrd", "--crop", "2:,,"};
  auto first = common, second = common;
  first.insert(first.end(), {"-o", folder / "first.vtp", "--report", folder / "a.json"});
  second.erase(second.begin() + 1, second.end());
  second.insert(second.end(), {"--settings", folder / "a.json", "-o", folder / "second.vtp"});
  EXPECT_EQ(segment(first).status, 0);
  const ProgramRun again = segment(second);
  EXPECT_EQ(again.status, 0) << again.err;
  const auto a = read_objects(folder / "first.vtp"), b = read_objects(folder / "second.vtp");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_EQ(a[n].surface.points, b[n].surface.points);
}

TEST_F(SegmentLabels, TheReportHasTheWarningsOfLabelFiles) {
  std::string map =
      "ObjectType = Image\nNDims = 3\nDimSize = 40 25 25\nElementType = MET_UCHAR\n"
      "ElementDataFile = LOCAL\n";
  for (int n = 0; n < 40 * 25 * 25; ++n) {
    map += static_cast<char>(label_at({1.0 * (n % 40), 1.0 * (n / 40 % 25), 1.0 * (n / 1000)}));
  }
  write_bytes(folder / "map.mha", map);
  for (const char* option : {"--labels", "--mask"}) {
    const ProgramRun run = run_program(
        folder, {"segment", folder / "balls.nrrd", option, folder / "map.mha", "-o",
                 folder / "a.vtp", "--report", folder / "a.json", "--adaptations", "2"});
    ASSERT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
    const auto report = nlohmann::json::parse(read_bytes(folder / "a.json"));
    EXPECT_THAT(report["warnings"].dump(), HasSubstr("no ElementSpacing")) << option;
    EXPECT_THAT(report["input"]["warnings"].dump(), testing::Not(HasSubstr("ElementSpacing")));
  }
}

TEST_F(SegmentLabels, TheMeshHasALabelPerCell) {
  const ProgramRun run =
      segment({folder / "balls.nrrd", "--mesh", folder / "a.vtu", "--mesh", folder / "a.msh",
               "--mesh-region", "object", "--max-tets", "4000", "--report", folder / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const MeshWithArrays mesh = read_vtu(folder / "a.vtu");
  std::map<double, double> volume;
  const auto label = std::find_if(mesh.cell_arrays.begin(), mesh.cell_arrays.end(),
                                  [](const MeshArray& array) { return array.name == "label"; });
  ASSERT_NE(label, mesh.cell_arrays.end());
  for (std::size_t c = 0; c < mesh.mesh.cells.size(); ++c) {
    volume[label->values[c]] += cell_volume(mesh.mesh, static_cast<Index>(c));
  }
  ASSERT_EQ(volume.size(), 2u) << "1 and 2, no background";
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  EXPECT_EQ(report["mesh"]["region"]["bins"][2]["name"], "L2_right_ball");
  for (std::size_t n = 0; n < 2; ++n) {
    const double surface = report["object"]["surfaces"][n]["volume_mm3"];
    EXPECT_NEAR(volume[static_cast<double>(n) + 1], surface, 0.05 * surface);
  }
}

TEST_F(SegmentLabels, SaysThatALevelPlacesNoBoundary) {
  const auto run_with = [&](const std::string& level) {
    return run_program(folder,
                       {"segment", folder / "balls.nrrd", "--labels", folder / "labels.nrrd", "-o",
                        folder / "a.vtp", "--level", level, "--report", folder / "a.json"});
  };
  const ProgramRun run = run_with("150");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("--level: each boundary of labels has its own level"));
  const auto warnings = nlohmann::json::parse(read_bytes(folder / "a.json"))["warnings"];
  ASSERT_EQ(warnings.size(), 1U) << "all that were logged, each once";
  EXPECT_THAT(run.err, HasSubstr("warning: " + warnings[0].get<std::string>()));
  EXPECT_THAT(run_with("local").err, testing::Not(HasSubstr("--level")));
  EXPECT_TRUE(nlohmann::json::parse(read_bytes(folder / "a.json"))["warnings"].empty());
}

TEST_F(SegmentLabels, AnAccuracyThatAnObjectMissesIsTold) {
  const auto run_for = [&](const std::string& accuracy) {
    return run_program(folder,
                       {"segment", folder / "balls.nrrd", "--labels", folder / "labels.nrrd", "-o",
                        folder / "a.vtp", "--accuracy", accuracy, "--report", folder / "a.json"});
  };
  EXPECT_EQ(run_for("2").status, 0);
  const ProgramRun missed = run_for("0.001");
  EXPECT_EQ(missed.status, 4);
  EXPECT_THAT(missed.err, HasSubstr("accuracy: expected 0.001 mm in the mean at most, found 0."));
  const auto verdict = nlohmann::json::parse(read_bytes(folder / "a.json"))["verdict"];
  EXPECT_EQ(verdict["kept"], false);
  EXPECT_THAT(missed.err, HasSubstr(verdict["message"].get<std::string>()));
  EXPECT_TRUE(std::filesystem::exists(folder / "a.vtp"));
}

/// Labels alone take a spacing of their own; beside a scan it is the scan's.
TEST_F(SegmentLabels, TakeASpacingAlone) {
  EXPECT_EQ(segment({"--label", "1", "-o", folder / "a.ply"}).status, 0);
  EXPECT_EQ(segment({"--label", "1", "-o", folder / "b.ply", "--spacing", "2,2,6"}).status, 0);
  const double once = check_surface(read_surface(folder / "a.ply")).volume;
  EXPECT_NEAR(check_surface(read_surface(folder / "b.ply")).volume, 3 * once, 0.1 * once);
}

TEST_F(SegmentLabels, RefusesInOneLine) {
  EXPECT_FAILS(segment({"--mesh", folder / "a.vtu"}), 2, "--mesh: expected a scan");
  const auto expect_refused = [&](std::vector<std::string> more, int status, const char* what) {
    const ProgramRun run = segment(std::move(more));
    EXPECT_EQ(run.status, status) << what;
    EXPECT_THAT(run.err, HasSubstr(what));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  const std::string scan = folder / "balls.nrrd", out = folder / "x.stl";
  expect_refused({scan, "-o", out, "--label", "nose"}, 3, "nose");
  expect_refused({"-o", out, "--crop", "0:9,0:9,0:9"}, 2, "expected a scan for --crop");
  expect_refused({"-o", out, "--modality", "MR"}, 2, "--modality");
  expect_refused({"-o", out, "--label", "1", scan}, 2, "the scan goes before --label");
  expect_refused({scan, "-o", out, "--mesh", folder / "x.vtu", "--preview"}, 2, "--preview");
  expect_refused({scan, "-o", out, "--surface", "band"}, 2, "--surface: expected solid");
  expect_refused({scan, "-o", out, "--preset", "paper"}, 2, "--surface: expected solid");
  write_bytes(folder / "band.json", R"({"surface": "band"})");
  expect_refused({scan, "-o", out, "--settings", folder / "band.json"}, 2,
                 "--surface: expected solid for several objects, found band");
  expect_refused({"-o", out, "--level", "150"}, 2, "--level: expected a scan");
  expect_refused({"-o", out, "--accuracy", "0.5"}, 2, "--accuracy: expected a scan");
  expect_refused({scan, "-o", out, "--error"}, 2, "--error");
  expect_refused({scan, "--labelmap", folder / "x.gz"}, 2, "--labelmap");
  expect_refused({scan, "-o", out, "--margin", "nan"}, 2, "margin");
  expect_refused({scan, "-o", out, "--min-volume", "1e9"}, 3, "found none");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace mesamis

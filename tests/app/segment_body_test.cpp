// SPDX-License-Identifier: Apache-2.0
// `mesamis segment --body`: bodies for finite elements, and a solver that takes them.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mesamis/scan_files/write_volume.h"
#include "mesamis/shape_files/mesh_files.h"
#include "support/ball_volume.h"
#include "support/run_program.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const Vec3 kCenter{12, 12, 14};

/// A block of 12 x 12 x 16 mm with soft faces, 200 in 100.
Volume block() {
  return sampled_volume({25, 25, 29}, {1, 1, 1}, [](const Vec3& p) {
    const auto side = [](double x, double half) {
      return 0.5 * (std::erf(x + half) - std::erf(x - half));
    };
    return 100 +
           100 * side(p.x - kCenter.x, 6) * side(p.y - kCenter.y, 6) * side(p.z - kCenter.z, 8);
  });
}

class SegmentBody : public testing::Test {
 protected:
  SegmentBody() { write_nrrd(folder / "block.nrrd", block()); }

  ProgramRun segment(const std::string& body, std::vector<std::string> more,
                     const std::string& size = "3") {
    std::vector<std::string> arguments{"segment",        folder / "block.nrrd",
                                       "--body",         folder / body,
                                       "--report",       folder / "a.json",
                                       "--element-size", size,
                                       "--tolerance",    "0.2",
                                       "--max-tets",     "20000",
                                       "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder, arguments);
  }
  nlohmann::json report() { return nlohmann::json::parse(read_bytes(folder / "a.json")); }

  TempFolder folder;
};

TEST_F(SegmentBody, WritesAMeshThatTheReportDescribes) {
  const ProgramRun run = segment("a.vtu", {"--set", "up=top:z,1mm"});
  ASSERT_EQ(run.status, 0) << run.err;
  const MeshWithArrays body = read_vtu(folder / "a.vtu");
  const auto told = report()["body"];
  EXPECT_EQ(told["elements"], body.mesh.cells.size());
  EXPECT_EQ(told["nodes"], body.mesh.points.size());
  EXPECT_EQ(told["components"], 1);
  EXPECT_GT(told["least_angle_deg"], 10.7);
  EXPECT_LT(told["greatest_angle_deg"], 165);
  EXPECT_GT(told["scaled_jacobian_min"], 0.1);
  EXPECT_EQ(told["sets"][0]["name"], "up");
  double volume = 0;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) volume += cell_volume(body.mesh, c);
  const double surface = report()["surface"]["volume_mm3"];
  EXPECT_NEAR(volume, surface, 0.01 * surface);
}

/// A block of one material that is pressed, free at its sides: force = E * area * strain.
TEST_F(SegmentBody, RunsInCalculix) {
  if (run_command(folder, {"ccx", "-v"}).status < 0 ||
      run_command(folder, {"ccx", "-v"}).status == 126) {
    GTEST_SKIP() << "CalculiX (ccx) is not installed";
  }
  for (const std::string element : {"tet4", "tet10"}) {
    const ProgramRun run = segment("a.inp", {"--element", element, "--set", "UP=top:z,1mm", "--set",
                                             "DOWN=bottom:z,1mm", "--material", "E=1000*rho_qct^1",
                                             "--calibration", "1,0.0000001", "--poisson", "0.0"});
    ASSERT_EQ(run.status, 0) << run.err;
    write_bytes(folder / "job.inp", read_bytes(folder / "a.inp") +
                                        "*BOUNDARY\nDOWN,1,3\n*STEP\n*STATIC\n*BOUNDARY\n"
                                        "UP,1,2\nUP,3,3,-0.1\n"
                                        "*NODE PRINT, NSET=UP, TOTALS=ONLY\nRF\n*END STEP\n");
    ASSERT_EQ(run_command(folder, {"ccx", "-i", folder / "job"}).status, 0);
    std::istringstream result(read_bytes(folder / "job.dat"));
    std::string line;
    double x = 0, y = 0, force = 0;
    while (std::getline(result, line)) {
      std::istringstream numbers(line);
      if (double fx = 0, fy = 0, fz = 0; numbers >> fx >> fy >> fz) x = fx, y = fy, force = fz;
    }
    const double expected = 1000 * 12 * 12 * 0.1 / 16;  // N; the rounded edges carry a little less
    EXPECT_NEAR(-force, expected, 0.1 * expected) << element;
    EXPECT_LT(std::abs(x) + std::abs(y), 0.05 * expected);
  }
}

TEST_F(SegmentBody, RefusesInOneLineBeforeItReads) {
  write_bytes(folder / "block.nrrd", "no scan");
  EXPECT_FAILS(segment("a.stl", {}), 2, "--body");
  EXPECT_FAILS(segment("a.mesh", {"--element", "tet10"}), 2, "--body: expected .inp");
  EXPECT_FAILS(segment("a.inp", {"--material", "keyak-1994"}), 2,
               "--material: expected --calibration");
  EXPECT_FAILS(segment("a.inp", {"--calibration", "0,1"}), 2, "--calibration: expected --material");
  EXPECT_FAILS(segment("a.inp", {"--material", "wood", "--calibration", "0,1"}), 2,
               "--material: material law: expected one of");
  EXPECT_FAILS(segment("a.inp", {"--surface", "band"}), 2, "--body: expected --surface solid");
  EXPECT_FAILS(
      segment("a.inp", {"--tissue", "airway", "--material", "E=1*rho^1", "--calibration", "0,1"}),
      2, "--material: expected a bright --tissue");
  EXPECT_FAILS(segment("a.inp", {"--set", "a=left:z,1"}), 2, "--set: set: expected NAME=");
}

TEST_F(SegmentBody, AnElementLargerThanTheObjectIsRefused) {
  EXPECT_FAILS(segment("a.inp", {}, "50"), 3, "body: expected an element size of at most");
  EXPECT_FALSE(std::filesystem::exists(std::string(folder / "a.inp")));
}

}  // namespace
}  // namespace mesamis

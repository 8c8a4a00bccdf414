// SPDX-License-Identifier: Apache-2.0
// `mesamis segment --body`: bodies for finite elements, and a solver that takes them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/ball_volume.h"
#include "support/external_program.h"
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
                     const std::string& size = "3", const std::string& tolerance = "0.2") {
    std::vector<std::string> arguments{
        "segment",         folder / "block.nrrd", "--body", folder / body, "--report",
        folder / "a.json", "--element-size",      size,     "--tolerance", tolerance,
        "--quiet"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder, arguments);
  }
  nlohmann::json report() { return nlohmann::json::parse(read_bytes(folder / "a.json")); }

  TempFolder folder;
  std::vector<std::string> how{"--preview"};  // where the surface comes from makes no difference
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
  MESAMIS_REQUIRE_PROGRAM("ccx");
  for (const std::string element : {"tet4", "tet10"}) {
    const ProgramRun run =
        segment("a.inp", {"--element", element, "--set", "UP=top:z,1mm", "--set",
                          "DOWN=bottom:z,1mm", "--material", "E=1000*rho_qct^1", "--calibration",
                          "1,0.0000001", "--poisson", "0.0", "--skin-tolerance", "0.25"});
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

constexpr double kInner = 5, kOuter = 10;
const Vec3 kMiddle{12.1, 11.9, 12};

/// A hollow ball with soft walls, 100 in 0.
Volume hollow_ball() {
  return sampled_volume({31, 31, 31}, {0.8, 0.8, 0.8}, [](const Vec3& p) {
    const double r = norm(p - kMiddle);
    return 50 * (std::erf((r - kInner) / 0.4) - std::erf((r - kOuter) / 0.4));
  });
}

/// The number that solvers give the node nearest to a point.
std::string node_at(const TetMesh& mesh, const Vec3& place) {
  const auto nearest =
      std::ranges::min_element(mesh.points, {}, [&](const Vec3& p) { return norm(p - place); });
  return std::to_string(nearest - mesh.points.begin() + 1);
}

/// Lamé: a pressure p moves the inner wall by p a^4 / (E (b^3 - a^3)) (1 - 2 nu +
/// (1 + nu) b^3 / (2 a^3)); the energy is 2 pi a^2 p times that. Linear elements are too stiff.
TEST_F(SegmentBody, AHollowBallUnderPressureHasTheEnergyOfTheory) {
  MESAMIS_REQUIRE_PROGRAM("ccx");
  write_nrrd(folder / "block.nrrd", hollow_ball());
  how = {"--max-tets", "20000"};
  const ProgramRun run = segment("a.inp",
                                 {"--body", folder / "a.vtu", "--set", "IN=inner", "--set",
                                  "OUT=outer", "--skin-tolerance", "0.1"},
                                 "1.5", "0.05");
  ASSERT_EQ(run.status, 0) << run.err;
  const TetMesh mesh = read_vtu(folder / "a.vtu").mesh;
  const std::string left = node_at(mesh, kMiddle - Vec3{kOuter, 0, 0}),
                    right = node_at(mesh, kMiddle + Vec3{kOuter, 0, 0}),
                    front = node_at(mesh, kMiddle + Vec3{0, kOuter, 0});
  write_bytes(folder / "job.inp",
              read_bytes(folder / "a.inp") +
                  "*MATERIAL, NAME=M\n*ELASTIC\n1000, 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n"
                  "*BOUNDARY\n" +
                  left + ",1,3\n" + right + ",2,3\n" + front +
                  ",3,3\n*STEP\n*STATIC\n*DSLOAD\nIN, P, 10\n"
                  "*EL PRINT, ELSET=ALL, TOTALS=ONLY\nELSE\n*END STEP\n");
  ASSERT_EQ(run_command(folder, {"ccx", "-i", folder / "job"}).status, 0);
  std::istringstream result(read_bytes(folder / "job.dat"));
  double energy = 0;
  for (std::string line; std::getline(result, line);) {
    std::istringstream numbers(line);
    if (double value = 0; numbers >> value) energy = value;
  }
  constexpr double a = kInner, b = kOuter;
  const double moved = 10 * std::pow(a, 4) / (1000 * (b * b * b - a * a * a)) *
                       (1 - 2 * 0.3 + 1.3 * b * b * b / (2 * a * a * a));
  const double expected = 2 * std::numbers::pi * a * a * 10 * moved;
  EXPECT_NEAR(energy, expected, 0.06 * expected);
}

TEST_F(SegmentBody, RefusesInOneLineBeforeItReads) {
  how.clear();
  write_bytes(folder / "block.nrrd", "no scan");
  EXPECT_FAILS(segment("a.stl", {}), 2, "--body");
  EXPECT_FAILS(segment("a.mesh", {"--element", "tet10"}), 2, "--body: expected .inp");
  EXPECT_FAILS(segment("a.mesh", {"--set", "A=top:z,1"}), 2, "--set: expected --body .inp");
  EXPECT_FAILS(segment("a.inp", {"--least-size", "30"}), 2, "--least-size: expected at most");
  EXPECT_FAILS(segment("a.inp", {"--material", "keyak-1994"}), 2,
               "--material: expected --calibration");
  EXPECT_FAILS(segment("a.inp", {"--calibration", "0,1"}), 2,
               "--calibration: expected --material beside it");
  EXPECT_FAILS(segment("a.inp", {"--material", "wood", "--calibration", "0,1"}), 2,
               "--material: material law: expected one of");
  EXPECT_FAILS(segment("a.inp", {"--surface", "band"}), 2, "--body: surface: expected solid");
  EXPECT_FAILS(
      segment("a.inp", {"--tissue", "airway", "--material", "E=1*rho^1", "--calibration", "0,1"}),
      2, "--material: expected a bright --tissue");
  EXPECT_FAILS(segment("a.inp", {"--set", "a=left:z,1"}), 2, "--set: expected NAME=");
}

/// What was asked for and is not there ends a run as one that missed a promise; the rest is
/// written.
TEST_F(SegmentBody, SetsWithoutAFaceAreTold) {
  const ProgramRun run =
      segment("a.inp", {"--set", "HOLE=inner", "--set", "UP=top:z,1", "--html", folder / "a.html"});
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, testing::HasSubstr("--body: set 'HOLE' has no face"));
  const auto verdict = report()["verdict"];
  EXPECT_EQ(verdict["kept"], false);
  EXPECT_THAT(run.err, testing::HasSubstr("mesamis: " + verdict["message"].get<std::string>()));
  EXPECT_THAT(read_bytes(folder / "a.html"), testing::Not(testing::HasSubstr("checks passed")));
  EXPECT_THAT(read_bytes(folder / "a.inp"), testing::HasSubstr("NSET=UP"));
  EXPECT_FAILS(segment("b.inp", {"--set", "B=between:1,2"}), 3,
               "set B: expected two of the objects 1 'object', found 2");
}

/// A surface as it was extracted has no tolerance for the skin, unless one is given. A preview has its
/// own: nobody chose 0.
TEST_F(SegmentBody, NeedsATolerance) {
  EXPECT_EQ(segment("a.inp", {}, "3", "0").status, 0);
  how = {};
  EXPECT_FAILS(segment("a.inp", {}, "3", "0"), 2,
               "--body: tolerance: expected one above 0 for the skin, found 0");
  EXPECT_EQ(segment("a.inp", {"--skin-tolerance", "0.2"}, "3", "0").status, 0);
}

/// The report has the warnings of every step.
TEST_F(SegmentBody, WhatAFileCannotHoldIsToldInTheReport) {
  const ProgramRun run = segment("a.msh", {"--set", "UP=top:z,1", "--material", "E=1000*rho_qct^1",
                                           "--calibration", "1,0.0000001"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto warnings = report()["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("version 2.2 with --set holds no"));
}

TEST_F(SegmentBody, RefusesNamesOfSetsThatSolversCannotTellApart) {
  write_bytes(folder / "block.nrrd", "no scan");
  EXPECT_FAILS(segment("a.inp", {"--set", "up=top:z,1", "--set", "UP=bottom:z,1"}), 2,
               "--set: expected names that differ in more than case, found 'UP' beside 'up'");
  EXPECT_FAILS(segment("a.inp", {"--set", "up=top:z,1", "--set", "up=bottom:z,1"}), 2,
               "found 'up' twice");
  for (const std::string name : {"ALL", "all", "Part_1", "PART_2_object", "mat_001"}) {
    EXPECT_FAILS(segment("a.inp", {"--set", name + "=top:z,1"}), 2,
                 "--set: expected a name other than ALL and those of parts and materials");
  }
}

/// Each option that means nothing without another one.
TEST_F(SegmentBody, RefusesOptionsWithoutTheOneTheyBelongTo) {
  write_bytes(folder / "block.nrrd", "no scan");
  const auto without_body = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"segment", folder / "block.nrrd", "-o", folder / "a.stl"};
    all.insert(all.end(), more.begin(), more.end());
    return run_program(folder, all);
  };
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"--ash", "equal"}, Words{"--calibration", "0,1"}, Words{"--material-gap", "50"},
        Words{"--material-rim", "0"}, Words{"--poisson", "0.3"}}) {
    EXPECT_FAILS(segment("a.inp", words), 2, words[0] + ": expected --material beside it");
  }
  for (const Words& words : {Words{"--element", "tet4"}, Words{"--gmsh-version", "2.2"},
                             Words{"--set", "a=top:z,1"}, Words{"--material", "keyak-1994"}}) {
    EXPECT_FAILS(without_body(words), 2, words[0] + ": expected --body beside it, found none");
  }
  for (const Words& words : {Words{"--element-size", "3"}, Words{"--least-size", "1"},
                             Words{"--element-gradation", "0.5"}, Words{"--wall-elements", "1"}}) {
    EXPECT_FAILS(without_body(words), 2,
                 words[0] + ": expected --body or --surface-quality meshing beside it");
  }
}

TEST_F(SegmentBody, AnElementLargerThanTheObjectIsRefused) {
  EXPECT_FAILS(segment("a.inp", {}, "50"), 3, "body: expected an element size of at most");
  EXPECT_FALSE(std::filesystem::exists(std::string(folder / "a.inp")));
}

}  // namespace
}  // namespace mesamis

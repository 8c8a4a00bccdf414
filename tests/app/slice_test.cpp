// SPDX-License-Identifier: Apache-2.0
// mesamis slice, with the slicers where they are installed and with stand-ins for what goes wrong.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/printing/child_process.h"
#include "mesamis/printing/gcode.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/external_program.h"
#include "support/level_set.h"
#include "support/run_program.h"
#include "support/script.h"
#include "support/shapes.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kSide = 20, kLayer = 0.3;
constexpr int kLayers = 67;  // 20 / 0.3, rounded

/// Somewhere in a patient's frame, as a scan has it.
const Vec3 kCorner{-110.25, -210.5, -310.125};

void write_cube(const std::filesystem::path& file, double side = kSide) {
  write_surface(file, cube(kCorner, side));
}

/// The command without --slicer.
std::vector<std::string> slice_arguments(const TempFolder& folder,
                                         const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"slice", folder / "cube.stl"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Half a ball with bumps: in a slicer that does its work in another order each time, its lines
/// differ.
TriMesh bumpy_ball() {
  return level_set({{-10, -10, -10}, {10, 10, 10}}, {18, 18, 18}, [](const Vec3& p) {
    return std::min(7 + 2 * std::sin(p.x) * std::cos(p.y + 0.5 * p.z) - norm(p), p.z + 0.1);
  });
}

class EverySlicer : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const bool cura = GetParam() == "cura";
    if (find_program(cura ? "CuraEngine" : "prusa-slicer").empty()) {
      GTEST_SKIP() << "not installed: " << (cura ? "cura-engine" : "prusa-slicer");
    }
    if (cura && !std::filesystem::exists("/usr/share/cura/resources/definitions")) {
      GTEST_SKIP() << "not installed: cura";
    }
    write_cube(folder_ / "cube.stl");
  }

  /// The report of a run that must succeed; its G-code is NAME.gcode.
  json slice(const std::string& name, const std::vector<std::string>& more = {},
             const std::string& surface = "cube.stl") {
    std::vector<std::string> arguments{
        "slice", folder_ / surface,           "--slicer", GetParam(),
        "-o",    folder_ / (name + ".gcode"), "--report", folder_ / (name + ".json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(folder_, arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr(" layers, "));
    return json::parse(read_bytes(folder_ / (name + ".json")));
  }

  /// The cube with default settings, sliced once for all tests, as "a".
  json slice_plainly() {
    struct Plain {
      json report;
      std::string gcode;
    };
    static std::map<std::string, Plain> of_slicer;
    if (!of_slicer.contains(GetParam())) {
      const json report = slice("a");
      of_slicer[GetParam()] = {report, read_bytes(folder_ / "a.gcode")};
    }
    write_bytes(folder_ / "a.gcode", of_slicer[GetParam()].gcode);
    return of_slicer[GetParam()].report;
  }

  TempFolder folder_;
};

struct Move {
  int layer = 0;
  double x0 = 0, y0 = 0, x = 0, y = 0, z = 0;
  bool extrudes = false, is_wall = false;
};

bool names_wall(const std::string& type) {
  return type.find("erimeter") != std::string::npos || type.find("WALL") != std::string::npos;
}

/// The moves of a print; layers are counted from 0.
std::vector<Move> moves_of(const std::string& gcode) {
  std::vector<Move> moves;
  std::istringstream lines(gcode);
  Move at{-1};
  for (std::string line, word; std::getline(lines, line);) {
    if (line.rfind(";TYPE:", 0) == 0) at.is_wall = names_wall(line);
    at.layer += line == ";LAYER_CHANGE" || line.rfind(";LAYER:", 0) == 0;
    std::istringstream words(line.substr(0, line.find(';')));
    words >> word;
    if (line.empty() || (word != "G0" && word != "G1")) continue;
    at.x0 = at.x;
    at.y0 = at.y;
    at.extrudes = false;
    while (words >> word) {
      const double value = std::strtod(word.c_str() + 1, nullptr);
      if (word[0] == 'X') at.x = value;
      if (word[0] == 'Y') at.y = value;
      if (word[0] == 'Z') at.z = value;
      at.extrudes |= word[0] == 'E';
    }
    at.extrudes &= at.x != at.x0 || at.y != at.y0;
    if (at.layer >= 0) moves.push_back(at);
  }
  return moves;
}

/// Where walls run along y in a layer of the cube: two per perimeter.
std::size_t walls_along_y(const std::vector<Move>& moves, int layer) {
  std::set<long> places;
  for (const Move& m : moves) {
    const bool along = std::abs(m.x - m.x0) < 1e-3 && std::abs(m.y - m.y0) > 0.7 * kSide;
    if (m.extrudes && m.is_wall && m.layer == layer && along) places.insert(std::lround(20 * m.x));
  }
  return places.size();
}

TEST_P(EverySlicer, PrintsACubeInTheMiddleOfTheBedLayerByLayer) {
  const json report = slice_plainly();
  EXPECT_EQ(report["layers"], kLayers);
  const std::vector<Move> moves = moves_of(read_bytes(folder_ / "a.gcode"));
  std::set<long> heights;  // in layers
  Vec3 lo{1e9, 1e9, 0}, hi{-1e9, -1e9, 0};
  for (const Move& m : moves) {
    if (!m.extrudes) continue;
    EXPECT_NEAR(m.z, kLayer * (m.layer + 1), 1e-3);
    heights.insert(std::lround(m.z / kLayer));
    lo = {std::min(lo.x, m.x), std::min(lo.y, m.y), 0};
    hi = {std::max(hi.x, m.x), std::max(hi.y, m.y), 0};
  }
  EXPECT_EQ(heights.size(), kLayers);
  // The bed is 250 x 210 mm; the outermost line runs half its width inside.
  EXPECT_NEAR(lo.x, 125 - kSide / 2 + 0.2, 0.1);
  EXPECT_NEAR(hi.x, 125 + kSide / 2 - 0.2, 0.1);
  EXPECT_NEAR(lo.y, 105 - kSide / 2 + 0.2, 0.1);
  EXPECT_NEAR(hi.y, 105 + kSide / 2 - 0.2, 0.1);
}

TEST_P(EverySlicer, DoesAsTheSettingsSay) {
  const json plain = slice_plainly();
  EXPECT_EQ(walls_along_y(moves_of(read_bytes(folder_ / "a.gcode")), kLayers / 2), 4u);
  const json dense = slice("dense", {"--infill", "40%"});
  const json walls = slice("walls", {"--perimeters", "4", "--layer", "0.15"});
  EXPECT_EQ(walls_along_y(moves_of(read_bytes(folder_ / "walls.gcode")), kLayers), 8u);
  EXPECT_EQ(walls["layers"], 133);
  // Eight times the infill of 5 %: 35 % of the cube within walls and shell, roughly.
  const double more = dense["filament_cm3"].get<double>() - plain["filament_cm3"].get<double>();
  EXPECT_NEAR(more, 0.35 * std::pow(1.84, 2) * 1.82, 0.4);
  // Two more walls of 0.4 mm in the layers that are not solid.
  EXPECT_GT(walls["filament_cm3"], plain["filament_cm3"].get<double>() + 0.4);
  EXPECT_EQ(dense["settings"]["infill_percent"], 40);
  EXPECT_EQ(walls["settings"]["perimeters"], 4);
}

TEST_P(EverySlicer, ReportsWhatThePrintTakes) {
  const json report = slice_plainly();
  EXPECT_EQ(report["program"]["name"], "mesamis");
  EXPECT_EQ(report["input"]["triangles"], 12);
  EXPECT_EQ(report["input"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(report["gate"]["passed"], true);
  EXPECT_EQ(report["gate"]["open_edges"], 0);
  EXPECT_EQ(report["gate"]["parts"], 1);
  EXPECT_EQ(report["gate"]["self_intersections"], 0);
  EXPECT_NEAR(report["gate"]["volume_mm3"], 8000, 1e-6);
  EXPECT_THAT(report["slicer"]["version"].get<std::string>(), testing::ContainsRegex("^[0-9]+\\."));
  EXPECT_GT(report["slicer"]["arguments"].size(), 10u);
  const std::string gcode = read_bytes(folder_ / "a.gcode");
  EXPECT_EQ(report["gcode_bytes"], gcode.size());
  EXPECT_EQ(report["gcode_lines"], std::count(gcode.begin(), gcode.end(), '\n'));
  EXPECT_GT(report["seconds"], 0);
  EXPECT_GT(report["peak_memory_mb"], 1);
  // A cube of this size takes some minutes and grams, whoever slices it.
  EXPECT_GT(report["estimated_print_seconds"], 120);
  EXPECT_LT(report["estimated_print_seconds"], 3600);
  const double length = report["filament_mm"], volume = report["filament_cm3"];
  EXPECT_NEAR(volume, length * M_PI / 4 * 1.75 * 1.75 / 1000, 0.01);
  EXPECT_NEAR(report["filament_g"], volume * 1.24, 0.01);
  EXPECT_GT(volume, 1);
  EXPECT_LT(volume, 8);
}

TEST_P(EverySlicer, GivesTheSameBytesAgain) {
  write_surface(folder_ / "ball.ply", bumpy_ball());
  slice("a", {}, "ball.ply");
  slice("b", {}, "ball.ply");
  EXPECT_GT(read_bytes(folder_ / "a.gcode").size(), 10000u);
  EXPECT_TRUE(read_bytes(folder_ / "a.gcode") == read_bytes(folder_ / "b.gcode"));
}

TEST_P(EverySlicer, GivesTheSameBytesFromAnyFormat) {
  slice_plainly();
  write_cube(folder_ / "cube.ply");
  slice("b", {}, "cube.ply");
  EXPECT_TRUE(read_bytes(folder_ / "a.gcode") == read_bytes(folder_ / "b.gcode"));
}

TEST_P(EverySlicer, LeavesNothingButItsOutputs) {
  std::filesystem::create_directories(folder_ / "temporary");
  {
    const Variable temporary("TMPDIR", folder_ / "temporary");
    slice("a", {"--quiet"});
    write_cube(folder_ / "cube.stl", 0.01);  // no layer fits in: the slicer fails
    EXPECT_FAILS(run_program(folder_, slice_arguments(folder_, {"--slicer", GetParam(), "--quiet",
                                                                "-o", folder_ / "b.gcode"})),
                 4, "expected");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "temporary"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.gcode"));
  EXPECT_EQ(folder_.file_count(), 6) << "the cube, G-code, report, temporary, stdout and stderr";
}

TEST_P(EverySlicer, TheReportSaysWhoJudged) {
  const json all = slice_plainly();
  const bool has_prusa = !find_program("prusa-slicer").empty();
  EXPECT_EQ(all["gate"]["by"].size(), has_prusa ? 2u : 1u);
  EXPECT_EQ(all["gate"]["prusa_slicer"].is_null(), !has_prusa);
  if (GetParam() != "cura") return;
  std::filesystem::create_directories(folder_ / "bin");
  std::filesystem::create_symlink(find_program("CuraEngine"), folder_ / "bin/CuraEngine");
  const Variable path("PATH", folder_ / "bin");
  const json alone = slice("alone");
  EXPECT_EQ(alone["gate"]["by"], json({"mesamis"}));
  EXPECT_TRUE(alone["gate"]["prusa_slicer"].is_null());
}

TEST_P(EverySlicer, SupportsWhatHangsOver) {
  // A cube above a smaller one: it hangs over by 3 mm on all sides.
  write_surface(folder_ / "cube.stl", joined(cube({0, 0, 0}, 6), cube({-3, -3, 5.9}, 12)));
  EXPECT_GT(slice("with", {"--infill", "0", "--support"})["filament_cm3"],
            slice("without", {"--infill", "0"})["filament_cm3"]);
}

INSTANTIATE_TEST_SUITE_P(Slice, EverySlicer, testing::Values("prusa", "cura"),
                         [](const auto& slicer) { return slicer.param; });

/// A stand-in for PrusaSlicer: sound by --info, else it does as told.
class StandIn : public testing::Test {
 protected:
  void SetUp() override {
    write_cube(folder_ / "cube.stl");
    std::filesystem::create_directories(folder_ / "temporary");
    stand_in("echo '10 => slicing'; echo G1 > print.gcode");
  }

  void stand_in(const std::string& lines, const std::string& info = "manifold = yes") {
    write_script(folder_ / "bin/prusa-slicer",
                 "case \"$*\" in *--info*) echo '" + info + "'; exit 0;; esac\n" + lines);
  }

  ProgramRun slice(const std::vector<std::string>& more = {}) {
    return await_program(folder_, start(more));
  }

  pid_t start(const std::vector<std::string>& more = {}) {
    const Variable path("PATH", (folder_ / "bin").string() + ":/usr/bin:/bin");
    const Variable temporary("TMPDIR", folder_ / "temporary");
    auto arguments =
        slice_arguments(folder_, {"--slicer", "prusa", "--quiet", "-o", folder_ / "a.gcode"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start_program(folder_, arguments);
  }

  void expect_nothing_left() {
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "temporary"));
    EXPECT_EQ(folder_.file_count(), 5) << "cube, bin, temporary, stdout and stderr";
  }

  TempFolder folder_;
};

TEST_F(StandIn, AFailureIsOneLineWithItsReason) {
  stand_in("echo '10 => slicing'; echo 'error: no luck'; exit 3");
  EXPECT_FAILS(slice(), 4, "PrusaSlicer: expected G-code, found exit status 3: error: no luck");
  stand_in("kill -11 $$");
  EXPECT_FAILS(slice(), 4, "PrusaSlicer: expected G-code, found signal 11");
  stand_in("true");
  EXPECT_FAILS(slice(), 4, "PrusaSlicer: expected G-code, found none");
  stand_in("echo G1 > print.gcode");
  EXPECT_FAILS(slice(), 4, "PrusaSlicer: expected layers in its G-code, found none");
  expect_nothing_left();
}

TEST_F(StandIn, WhatPrusaSlicerFindsUnsoundIsNotSliced) {
  stand_in("touch " + (folder_ / "sliced").string(), "manifold = no");
  EXPECT_FAILS(slice(), 5, "prusa-slicer --info: manifold = no");
  stand_in("touch " + (folder_ / "sliced").string(), "facets_reversed = 2");
  EXPECT_FAILS(slice({"--report", folder_ / "r.json"}), 5,
               "prusa-slicer --info: facets_reversed = 2");
  const json gate = json::parse(read_bytes(folder_ / "r.json"))["gate"];
  EXPECT_EQ(gate["passed"], false);
  EXPECT_EQ(gate["by"].size(), 2u);
  EXPECT_EQ(gate["prusa_slicer"]["repairs"]["facets_reversed"], 2);
  std::filesystem::remove(folder_ / "r.json");
  expect_nothing_left();
}

TEST_F(StandIn, TheSlicerDiesWithMesamis) {
  stand_in("echo $$ > " + (folder_ / "number").string() + "; exec sleep 60");
  for (const int number : {SIGINT, SIGTERM}) {
    std::filesystem::remove(folder_ / "number");
    const pid_t child = start();
    for (int i = 0; i < 1000 && read_bytes(folder_ / "number").empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_NE(read_bytes(folder_ / "number"), "") << "it has begun";
    const pid_t slicer = std::stoi(read_bytes(folder_ / "number"));
    EXPECT_EQ(kill(slicer, 0), 0);
    kill(child, number);
    EXPECT_EQ(await_program(folder_, child).status, -number);
    EXPECT_NE(kill(slicer, 0), 0) << "it is gone";
  }
  std::filesystem::remove(folder_ / "number");
  expect_nothing_left();
}

TEST_F(StandIn, WarnsWhenLayersAreMissing) {
  stand_in("printf ';LAYER_CHANGE\\n;LAYER_CHANGE\\n' > print.gcode");
  const Variable temporary("TMPDIR", folder_ / "temporary");
  const Variable path("PATH", (folder_ / "bin").string() + ":/usr/bin:/bin");
  const ProgramRun run = run_program(folder_, slice_arguments(folder_, {"--slicer", "prusa"}));
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("warning: the G-code has 2 layers, expected about 67"));
}

TEST_F(StandIn, OpenSurfacesAreRefusedAndReported) {
  TriMesh open = cube(kCorner, kSide);
  open.triangles.pop_back();
  write_surface(folder_ / "cube.stl", open);
  EXPECT_FAILS(slice({"--report", folder_ / "r.json"}), 5, "found 3 open edges");
  const json report = json::parse(read_bytes(folder_ / "r.json"));
  EXPECT_EQ(report["gate"]["passed"], false);
  EXPECT_EQ(report["gate"]["open_edges"], 3);
  EXPECT_FALSE(report.contains("layers"));
  std::filesystem::remove(folder_ / "r.json");
  expect_nothing_left();
}

TEST_F(StandIn, ABedThatIsTooSmallIsNamedWithBothSizes) {
  EXPECT_FAILS(slice({"--bed", "19.5,300"}), 3,
               "expected a surface that fits on a bed of 19.5 x 300 x 210 mm (width x depth x "
               "height), found 20 x 20 x 20 mm; --bed");
  EXPECT_FAILS(slice({"--bed", "30,30,19"}), 3, "30 x 30 x 19 mm");
  stand_in("echo ';LAYER_CHANGE' > print.gcode");
  EXPECT_EQ(slice({"--bed", "20.01,20.01,20.01"}).status, 0);
}

TEST(SliceCommand, AMissingProgramIsNamedWithItsPackage) {
  const TempFolder folder;
  write_cube(folder / "cube.stl");
  const Variable path("PATH", folder.path());
  EXPECT_FAILS(run_program(folder, slice_arguments(folder, {"--slicer", "prusa"})), 3,
               "prusa-slicer: expected this program in PATH, found none; on Debian: apt install "
               "prusa-slicer");
  EXPECT_FAILS(run_program(folder, slice_arguments(folder, {"--slicer", "cura"})), 3,
               "apt install cura-engine");
}

TEST(SliceCommand, RefusesPlainly) {
  const TempFolder folder;
  write_cube(folder / "cube.stl");
  auto fails = [&folder](std::vector<std::string> more, int status, const std::string& words) {
    if (more[0] != "--slicer") more.insert(more.begin(), {"--slicer", "prusa"});
    EXPECT_FAILS(run_program(folder, slice_arguments(folder, more)), status, words);
  };
  EXPECT_FAILS(run_program(folder, {"slice", folder / "cube.stl"}), 2, "--slicer is required");
  fails({"--slicer", "other"}, 2, "other not in {prusa,cura}");
  for (const auto* layer : {"0", "-0.1", "0.41", "nan", "thin"}) {
    fails({"--layer", layer}, 2, "--layer: expected 0.02 to 0.4 mm (the nozzle), found");
  }
  for (const auto* infill : {"-1", "101", "full", "%"}) {
    fails({"--infill", infill}, 2, "--infill: expected 0 to 100%, found");
  }
  for (const auto* perimeters : {"-1", "1.5", "1000"}) {
    fails({"--perimeters", perimeters}, 2, "--perimeters: expected a whole number from 0 to 100");
  }
  for (const auto* bed : {"250", "1,2,3,4", "0,200", "200,-1", "a,b"}) {
    fails({"--bed", bed}, 2, "--bed: expected");
  }
  fails({"-o", folder / "a.stl"}, 2, "ends with one of .gcode");
  fails({"-o", folder / "none/a.gcode"}, 3, "there is no folder");
  EXPECT_EQ(folder.file_count(), 3) << "the cube, stdout and stderr";
}

/// What we write beside STL, given to PrusaSlicer by its user.
TEST(PrusaSlicer, SlicesThreeMfAndAmfAsTheyAre) {
  MESAMIS_REQUIRE_PROGRAM("prusa-slicer");
  const TempFolder folder;
  const TriMesh ball = bumpy_ball();
  const std::vector<double> grey(ball.points.size(), 128);
  for (const char* file : {"a.3mf", "a.amf"}) {
    write_surface(folder / file, ball, {.name = "a & b", .grey = grey});
    const ProgramRun run =
        run_command(folder, {"prusa-slicer", "--datadir", folder / "prusa", "--layer-height", "0.3",
                             "--export-gcode", folder / file, "--output", folder / "a.gcode"});
    EXPECT_EQ(run.status, 0) << run.err;
    std::istringstream gcode(read_bytes(folder / "a.gcode"));
    EXPECT_GT(read_gcode(gcode).layers, 20) << file;
    std::filesystem::remove(folder / "a.gcode");
  }
}

}  // namespace
}  // namespace mesamis

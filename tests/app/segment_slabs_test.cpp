// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "mesamis/label_files/write_labels.h"
#include "mesamis/shape_files/mesh_files.h"
#include "support/external_program.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A sphere in 20 x 20 x 128 voxels, which are two slabs.
void write_scan(const TempFolder& folder, int slices = 128) {
  const ProgramRun made =
      run_program(folder, {"phantom", "sphere", "--size", "20,20," + std::to_string(slices), "-o",
                           folder / "scan.nrrd"});
  ASSERT_EQ(made.status, 0) << made.err;
}

std::vector<std::string> segment(const TempFolder& folder, const std::string& name,
                                 std::vector<std::string> more, const std::string& threads = "1") {
  std::vector<std::string> arguments{
      "segment", folder / "scan.nrrd", "-o",  folder / (name + ".stl"), "--threads",
      threads,   "--max-tets",         "2500"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

ProgramRun run_together(const TempFolder& folder, int processes,
                        const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"mpirun", "--allow-run-as-root",     "--oversubscribe",  "-q",
                                   "-np",    std::to_string(processes), MESAMIS_MPI_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_command(folder, command);
}

bool can_run_together() { return std::string(MESAMIS_MPI_PROGRAM) != "" && is_installed("mpirun"); }

nlohmann::json report_of(const TempFolder& folder, const std::string& name) {
  return nlohmann::json::parse(read_bytes(folder / (name + ".json")));
}

bool has_scratch(const TempFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(folder / ""))) {
    if (entry.path().extension() == ".slabs") return true;
  }
  return false;
}

/// A run by one process with one thread, slab by slab, and all that it can write.
struct WholeRun {
  WholeRun() {
    write_scan(folder);
    run = run_program(folder, segment(folder, "two",
                                      {"--slabs", "2", "--mesh", folder / "two.pvtu", "--mesh",
                                       folder / "two.vtu", "--mesh", folder / "two.mesh", "--bins",
                                       "4", "--report", folder / "two.json"}));
  }
  nlohmann::json report() const { return report_of(folder, "two"); }

  TempFolder folder;
  ProgramRun run;
};

const WholeRun& whole_run() {
  static const WholeRun run;
  return run;
}

TEST(SlabsOfSegment, MakeAClosedSurfaceAndTellTheirWork) {
  EXPECT_EQ(whole_run().run.status, 0) << whole_run().run.err;
  EXPECT_FALSE(has_scratch(whole_run().folder));
  const nlohmann::json report = whole_run().report();
  EXPECT_TRUE(report["surface"]["closed"]);
  const nlohmann::json& slabs = report["slabs"];
  EXPECT_EQ(slabs["count"], 2);
  EXPECT_EQ(slabs["processes"], 1);
  ASSERT_EQ(slabs["slabs"].size(), 2u);
  EXPECT_EQ(slabs["slabs"][0]["slices"].get<int>() + slabs["slabs"][1]["slices"].get<int>(), 128);
  std::int64_t rows = 0;
  for (const auto& slab : slabs["slabs"]) rows += slab["rows"].get<std::int64_t>();
  EXPECT_GT(rows, slabs["own_rows"].get<std::int64_t>());
}

TEST(SlabsOfSegment, AThinScanHasTheBytesOfARunWithoutSlabs) {
  const TempFolder folder;
  write_scan(folder, 72);
  EXPECT_EQ(
      run_program(folder, segment(folder, "one", {"--slabs", "9", "--mesh", folder / "one.vtu"}))
          .status,
      0);
  EXPECT_EQ(run_program(folder, segment(folder, "whole", {"--mesh", folder / "whole.vtu"})).status,
            0);
  for (const char* extension : {".stl", ".vtu"}) {
    EXPECT_EQ(read_bytes(folder / ("one" + std::string(extension))),
              read_bytes(folder / ("whole" + std::string(extension))));
  }
}

TEST(SlabsOfSegment, AnyPartOfTheScanAtATimeGivesTheSameBytes) {
  for (const std::string turns : {"1", "auto"}) {
    const TempFolder folder;
    write_scan(folder);
    const auto arguments =
        segment(folder, "a", {"--slabs", turns, "--bins", "4", "--mesh", folder / "a.vtu"}, "2");
    EXPECT_EQ(run_program(folder, arguments).status, 0);
    for (const char* extension : {".stl", ".vtu"}) {
      EXPECT_EQ(read_bytes(folder / ("a" + std::string(extension))),
                read_bytes(whole_run().folder / ("two" + std::string(extension))))
          << turns;
    }
  }
}

constexpr double kVolume = 19. * 19 * 127;  // of the scan's box, mm^3

TEST(SlabsOfSegment, TheMeshIsThatOfTheWholeScan) {
  const nlohmann::json mesh = whole_run().report()["mesh"];
  EXPECT_EQ(mesh["region"]["cells"], mesh["tets"]);
  EXPECT_NEAR(mesh["region"]["volume_mm3"].get<double>(), kVolume, 1e-6 * kVolume);
  EXPECT_EQ(mesh["region"]["bins"].size(), 4u);
  for (const char* file : {"two.mesh", "two.sol"}) {
    EXPECT_TRUE(std::filesystem::exists(whole_run().folder / file)) << file;
  }
}

TEST(SlabsOfSegment, TheMeshMayStayInPieces) {
  const TempFolder& folder = whole_run().folder;
  const std::string index = read_bytes(folder / "two.pvtu");
  EXPECT_THAT(index, HasSubstr("<Piece Source=\"two_0.vtu\"/>"));
  EXPECT_THAT(index, HasSubstr("Name=\"u_native\""));
  const MeshWithArrays whole = read_vtu(folder / "two.vtu");
  double volume = 0;
  std::size_t cells = 0;
  for (const char* name : {"two_0.vtu", "two_1.vtu"}) {
    const MeshWithArrays piece = read_vtu(folder / name);
    cells += piece.mesh.cells.size();
    for (Index c = 0; c < std::ssize(piece.mesh.cells); ++c) volume += cell_volume(piece.mesh, c);
    EXPECT_EQ(piece.point_arrays.size(), whole.point_arrays.size());
    EXPECT_EQ(piece.cell_arrays.size() + 1, whole.cell_arrays.size()) << "no bins";
  }
  EXPECT_EQ(cells, whole.mesh.cells.size());
  EXPECT_NEAR(volume, kVolume, 1e-6 * kVolume);
  EXPECT_TRUE(whole_run().report()["files"].dump().find("two_1.vtu") != std::string::npos);
}

// One process of the three has no slab.
TEST(SlabsOfSegment, AnyNumberOfProcessesWritesTheSameBytes) {
  if (!can_run_together()) GTEST_SKIP() << "mesamis-mpi or mpirun is not there";
  const TempFolder folder;
  write_scan(folder);
  const ProgramRun run = run_together(
      folder, 3,
      segment(folder, "together", {"--slabs", "2", "--report", folder / "together.json"}));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_bytes(folder / "together.stl"), read_bytes(whole_run().folder / "two.stl"));
  EXPECT_EQ(report_of(folder, "together")["slabs"]["processes"], 3);
}

TEST(SlabsOfSegment, AFailureOfOneEndsAllWithOneLineAndNoOutput) {
  if (!can_run_together()) GTEST_SKIP() << "mesamis-mpi or mpirun is not there";
  const TempFolder folder;
  write_scan(folder);
  std::filesystem::resize_file(std::string(folder / "scan.nrrd"), 90'000);
  const ProgramRun run =
      run_together(folder, 3, segment(folder, "none", {"--slabs", "2", "--quiet"}));
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("scan.nrrd"));
  const std::string marker = "mesamis: ";
  EXPECT_EQ(run.err.find(marker), run.err.rfind(marker)) << run.err;
  EXPECT_FALSE(std::filesystem::exists(std::string(folder / "none.stl")));
}

TEST(SlabsOfSegment, ARunThatFailsLeavesNothing) {
  const TempFolder folder;
  write_scan(folder);
  const ProgramRun run =
      run_program(folder, segment(folder, "none", {"--slabs", "2", "--level", "1e6"}));
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("level"));
  EXPECT_FALSE(has_scratch(folder));
}

/// Kills a run when a scratch file is there, or at its end.
void kill_when_there(const TempFolder& folder, pid_t child, const std::string& file) {
  const std::string path = std::string(folder / "keep") + "/mesamis-slabs/" + file;
  int status = 0;
  while (!std::filesystem::exists(path)) {
    ASSERT_EQ(waitpid(child, &status, WNOHANG), 0) << "the run has ended before " << file;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
}

TEST(SlabsOfSegment, AKilledRunGoesOnWhereItWas) {
  const TempFolder folder;
  write_scan(folder);
  const auto arguments =
      segment(folder, "again", {"--slabs", "1", "--checkpoint", folder / "keep", "--quiet"}, "2");
  for (const char* file : {"done.prepare.0", "done.mesh 1.1", "done.minimise 2.0"}) {
    kill_when_there(folder, start_program(folder, arguments), file);
    EXPECT_FALSE(std::filesystem::exists(std::string(folder / "again.stl")));
  }
  const ProgramRun other = run_program(
      folder, segment(folder, "other",
                      {"--adaptations", "3", "--slabs", "2", "--checkpoint", folder / "keep"}));
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.err, HasSubstr("another"));
  const auto with_less_memory =
      segment(folder, "again", {"--slabs", "2", "--checkpoint", folder / "keep"});
  const ProgramRun run = run_program(folder, with_less_memory);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_bytes(folder / "again.stl"), read_bytes(whole_run().folder / "two.stl"));
  EXPECT_FALSE(std::filesystem::exists(std::string(folder / "keep")));
}

/// Labels of two rods that touch, in 12 x 10 x 132 voxels, which are two slabs.
void write_labels(const TempFolder& folder) {
  LabelMap map;
  map.size = {12, 10, 132};
  map.segments = {{"lower rod", 1, 0, {255, 0, 0}}, {"upper rod", 2, 0, {0, 0, 255}}};
  map.layers.emplace_back();
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const bool inside = std::hypot(i - 3 - 0.04 * k, j - 4.5) < 2.5 && k > 2 && k < 127;
    map.layers[0].push_back(static_cast<std::uint16_t>(!inside ? 0 : k < 60 ? 1 : 2));
  }
  write_label_map(folder / "labels.nii.gz", map);
}

std::vector<std::string> segment_labels(const TempFolder& folder, const std::string& name,
                                        const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"segment",
                                     "--labels",
                                     folder / "labels.nii.gz",
                                     "-o",
                                     folder / (name + ".vtp"),
                                     "--quiet",
                                     "--tolerance",
                                     "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(SlabsOfSegment, LabelsHaveTheBytesOfARunWithoutSlabs) {
  const TempFolder folder;
  write_labels(folder);
  const auto run = [&](const std::string& name, const std::vector<std::string>& more) {
    const ProgramRun done = run_program(folder, segment_labels(folder, name, more));
    EXPECT_EQ(done.status, 0) << done.err;
    return read_bytes(folder / (name + ".vtp"));
  };
  const std::string whole = run("whole", {});
  EXPECT_EQ(run("one", {"--slabs", "1", "--threads", "2"}), whole);
  EXPECT_EQ(run("two", {"--slabs", "2", "--report", folder / "two.json"}), whole);
  EXPECT_FALSE(has_scratch(folder));
  const nlohmann::json report = report_of(folder, "two");
  EXPECT_EQ(report["slabs"]["count"], 2);
  EXPECT_EQ(report["slabs"]["slabs"].size(), 2u);
  EXPECT_EQ(report["object"]["surfaces"].size(), 2u);
  EXPECT_EQ(run("lower", {"--slabs", "auto", "--label", "lower rod"}),
            run("lower_whole", {"--label", "lower rod"}));
  if (!can_run_together()) GTEST_SKIP() << "mesamis-mpi or mpirun is not there";
  const ProgramRun together =
      run_together(folder, 2, segment_labels(folder, "together", {"--slabs", "auto"}));
  EXPECT_EQ(together.status, 0) << together.err;
  EXPECT_EQ(read_bytes(folder / "together.vtp"), whole);
}

/// The same with a scan, whose rods are brighter than labels say they are wide.
TEST(SlabsOfSegment, LabelsInAScanHaveTheBytesOfARunWithoutSlabs) {
  const TempFolder folder;
  write_labels(folder);
  ASSERT_EQ(
      run_program(folder, {"phantom", "sphere", "--size", "12,10,132", "-o", folder / "scan.nrrd"})
          .status,
      0);
  const auto run = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), folder / "scan.nrrd");
    std::vector<std::string> arguments = segment_labels(folder, name, {});
    arguments.insert(arguments.begin() + 1, more.begin(), more.end());
    const ProgramRun done = run_program(folder, arguments);
    EXPECT_EQ(done.status, 0) << done.err;
    return read_bytes(folder / (name + ".vtp"));
  };
  const std::string whole = run("whole", {});
  EXPECT_EQ(run("two", {"--slabs", "2", "--report", folder / "two.json"}), whole);
  EXPECT_FALSE(has_scratch(folder));
  const nlohmann::json report = report_of(folder, "two");
  EXPECT_EQ(report["slabs"]["count"], 2);
  EXPECT_EQ(report["input"]["size"], (std::vector<int>{12, 10, 132}));
  const ProgramRun meshed =
      run_program(folder, {"segment", folder / "scan.nrrd", "--labels", folder / "labels.nii.gz",
                           "--slabs", "2", "-o", folder / "none.vtp", "--mesh", folder / "m.vtu"});
  EXPECT_EQ(meshed.status, 2);
  EXPECT_THAT(meshed.err, HasSubstr("--mesh with --labels"));
}

TEST(SlabsOfSegment, LabelsRefuseWhatNeedsMoreThanTheirSlices) {
  const TempFolder folder;
  write_labels(folder);
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--labelmap", folder / "l.nrrd"}, {"--preview"}, {"--html", folder / "p.html"}}) {
    auto arguments = segment_labels(folder, "none", {"--slabs", "2"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(folder, arguments);
    EXPECT_EQ(run.status, 2) << more[0];
    EXPECT_EQ(run.error_lines(), 1u) << run.err;
  }
  const ProgramRun exact =
      run_program(folder, {"segment", "--probabilities", folder / "labels.nii.gz", "-o",
                           folder / "none.vtp", "--slabs", "2"});
  EXPECT_EQ(exact.status, 2);
  EXPECT_THAT(exact.err, HasSubstr("--probabilities"));
  auto unknown = segment_labels(folder, "none", {"--slabs", "2", "--label", "liver"});
  const ProgramRun none = run_program(folder, unknown);
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("liver"));
  EXPECT_FALSE(has_scratch(folder));
}

TEST(SlabsOfSegment, WhatSinglePrecisionTakesIsTold) {
  const TempFolder folder;
  std::string bytes;
  for (int k = 0; k < 40; ++k) {
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) {
        const double r = std::hypot(i - 7.5, j - 7.5, k - 19.5);
        const double sample = 1e9 + (r < 6 ? 4000 : 0) + (i * 7 + j * 3 + k) % 50;
        bytes.append(reinterpret_cast<const char*>(&sample), sizeof(sample));
      }
    }
  }
  write_bytes(folder / "scan.nrrd",
              "NRRD0004\ntype: double\ndimension: 3\nsizes: 16 16 40\nencoding: raw\n"
              "endian: little\nspace: left-posterior-superior\n"
              "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n" +
                  bytes);
  const std::vector<std::string> words{"segment",        folder / "scan.nrrd", "-o",
                                       folder / "a.stl", "--max-tets",         "1000"};
  std::vector<std::string> in_slabs = words;
  in_slabs.insert(in_slabs.end(), {"--slabs", "2"});
  EXPECT_THAT(run_program(folder, words).err, HasSubstr("rounds to steps of 64"));
  EXPECT_THAT(run_program(folder, in_slabs).err, HasSubstr("rounds to steps of 64"));
}

TEST(SlabsOfSegment, WhatNeedsAllOfAScanIsRefused) {
  const TempFolder folder;
  write_scan(folder);
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--band-mesh", folder / "m.vtu"},
           {"--labelmap", folder / "l.nrrd"},
           {"--crop", "0:20,,"},
           {"--preview"},
           {"--mesh", folder / "m.pvtu", "--mesh-region", "object"},
           {"--slabs", "0"},
           {"--html", folder / "p.html"}}) {
    auto arguments = segment(folder, "none", {"--slabs", "2"});
    if (more[0] == "--slabs") arguments = segment(folder, "none", {});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(folder, arguments);
    EXPECT_EQ(run.status, 2) << more[0];
    EXPECT_EQ(run.error_lines(), 1u) << run.err;
  }
  const auto taken = segment(
      folder, "none", {"--slabs", "2", "--mesh", folder / "m.pvtu", "--mesh", folder / "m_1.vtu"});
  EXPECT_EQ(run_program(folder, taken).status, 2) << "the name of a piece";
  const auto whole = segment(folder, "none", {"--mesh", folder / "m.pvtu"});
  EXPECT_EQ(run_program(folder, whole).status, 2) << "a run without slabs has no pieces";
}

}  // namespace
}  // namespace mesamis

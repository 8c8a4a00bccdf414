// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "mesamis/phantom/degrade.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(PhantomCommand, WritesVolumeTruthAndReport) {
  const TempFolder folder;
  const ProgramRun run =
      run_program(folder, {"phantom", "fracture", "-o", folder / "a.nrrd", "--truth",
                           folder / "t.ply", "--size", "32,32,16", "--spacing", "1,1,2", "--noise",
                           "4", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const VolumeFile file = read_volume(folder / "a.nrrd");
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{32, 32, 16}));
  EXPECT_EQ(file.volume.spacing, (Vec3{1, 1, 2}));
  EXPECT_EQ(file.volume.origin, (Vec3{0.5, 0.5, 1}));
  const TriMesh truth = read_surface(folder / "t.ply");
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  EXPECT_EQ(report["truth"]["triangles"], truth.triangles.size());
  EXPECT_EQ(report["truth"]["closed"], true);
  EXPECT_EQ(report["truth"]["manifold"], true);
  EXPECT_LT(report["truth"]["error_max_mm"], 0.02);
  EXPECT_LE(report["truth"]["error_mean_mm"], report["truth"]["error_max_mm"]);
  EXPECT_NEAR(report["truth"]["volume_mm3"], check_surface(truth).volume, 1e-6);
  EXPECT_EQ(report["settings"]["noise"], 4);
  EXPECT_EQ(report["settings"]["blur_voxel"], 1);
  EXPECT_EQ(report["settings"]["seed"], 1);
  EXPECT_EQ(report["settings"]["scale"], 0.5);
}

TEST(PhantomCommand, SameSeedSameBytes) {
  const TempFolder folder;
  const auto bytes = [&folder](const std::vector<std::string>& more) {
    std::vector<std::string> words{"phantom",       "plate",    "-o",        folder / "a.nrrd",
                                   "--size",        "20,20,20", "--noise",   "10",
                                   "--salt-pepper", "0.01",     "--speckle", "0.1"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(folder, words).status, 0);
    return read_bytes(folder / "a.nrrd");
  };
  const std::string first = bytes({"--seed", "5"});
  EXPECT_EQ(bytes({"--seed", "5", "--threads", "1"}), first);
  EXPECT_NE(bytes({"--seed", "6"}), first);
  EXPECT_LT(bytes({"--type", "short", "--gzip"}).size(), first.size() / 2);
}

/// The program makes a volume slab by slab; the library makes the same one in memory.
TEST(PhantomCommand, WritesTheVolumeOfTheLibrary) {
  const TempFolder folder;
  EXPECT_EQ(run_program(folder, {"phantom", "femur", "-o", folder / "a.nrrd", "--size", "30,30,45",
                                 "--spacing", "2,2,2", "--noise", "7", "--seed", "3"})
                .status,
            0);
  const Phantom femur = make_phantom("femur", {30, 30, 45}, {2, 2, 2});
  write_nrrd(folder / "b.nrrd", degrade(sample_phantom(femur), {.blur = 1, .noise = 7, .seed = 3}));
  EXPECT_TRUE(read_bytes(folder / "a.nrrd") == read_bytes(folder / "b.nrrd"));
}

TEST(PhantomCommand, ListsWhatThereIs) {
  const TempFolder folder;
  const ProgramRun run = run_program(folder, {"phantom", "--list"});
  EXPECT_EQ(run.status, 0);
  for (const char* name : {"sphere", "plate", "femur", "fracture", "hemipelvis"}) {
    EXPECT_THAT(run.out, HasSubstr(std::string(name) + ": "));
    EXPECT_THAT(run_program(folder, {"phantom", "--help"}).out, HasSubstr(name));
  }
}

TEST(PhantomCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  auto phantom = [&folder](std::vector<std::string> options) {
    options.insert(options.begin(), "phantom");
    return run_program(folder, options);
  };
  const std::string out = folder / "a.nrrd";
  EXPECT_FAILS(phantom({"ball", "-o", out}), 2, "sphere, plate, wall, femur, fracture, hemipelvis");
  EXPECT_FAILS(phantom({"-o", out}), 2, "--list");
  EXPECT_FAILS(phantom({"sphere"}), 2, "--output");
  EXPECT_FAILS(phantom({"sphere", "-o", folder / "a.nii"}), 2, ".nrrd");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--truth", folder / "t.txt"}), 2, "--truth");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--size", "64,64"}), 2, "--size");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--size", "64,64,7"}), 2, "at least 8");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--size", "0,0,0"}), 2, "at least 8");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--spacing", "1,1,0"}), 2, "spacing");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--noise", "-1"}), 2, "noise: expected 0 or more");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--noise", "nan"}), 2, "noise");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--blur", "-1"}), 2, "blur");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--salt-pepper", "2"}), 2, "salt-pepper");
  EXPECT_FAILS(phantom({"sphere", "-o", out, "--seed", "-1"}), 2, "seed");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace mesamis

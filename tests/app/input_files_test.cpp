// SPDX-License-Identifier: Apache-2.0
// What a file may cost, and paths that cannot be read: one line and status 3, whatever the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "mesamis/shape_files/surface_files.h"
#include "support/run_program.h"
#include "support/scan_bytes.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

/// A NIfTI of 4 MB of equal voxels in 4 kB.
std::string large_scan() {
  NiftiBytes nifti;
  nifti.dim = {3, 200, 200, 100, 1, 1, 1, 1};
  nifti.datatype = 2, nifti.bitpix = 8;
  return packed(nifti.header() + std::string(4'000'000, '\1'));
}

TEST(InputFiles, MemoryIsAskedForBeforeSamplesAreRead) {
  const TempFolder folder;
  const std::string scan = folder / "a.nii.gz", surface = folder / "a.stl";
  std::string cut = large_scan();
  cut.resize(cut.size() - 9);  // whoever reads the samples finds the end
  write_bytes(scan, cut);
  EXPECT_FAILS(run_program(folder, {"segment", scan, "-o", surface, "--memory", "0.05"}), 3,
               "memory: expected about 1.0 GB for this run, found 0.1 GB");
  EXPECT_FAILS(run_program(folder, {"segment", scan, "-o", surface, "--memory", "4"}), 3,
               "the compressed data are cut off");
  EXPECT_FALSE(std::filesystem::exists(surface));
}

/// 40 MB of points in 40 kB; every command that reads a surface.
TEST(InputFiles, ASurfaceThatClaimsMoreThanIsAllowedIsRefused) {
  const TempFolder folder;
  const std::string bomb = folder / "a.obj.gz", out = folder / "b.stl";
  std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (int n = 0; n < 5'000'000; ++n) points += "v 0 0 0\n";
  write_bytes(bomb, packed(points));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"info", bomb},
                                                  {"compare", bomb, bomb},
                                                  {"decimate", bomb, "-o", out, "--tolerance", "1"},
                                                  {"picture", bomb, "-o", folder / "b.png"}}) {
    std::vector<std::string> limited = command;
    limited.insert(limited.end(), {"--memory", "0.02"});
    EXPECT_FAILS(run_program(folder, limited), 3, "a.obj.gz: memory: expected a file that needs");
  }
}

TEST(InputFiles, APictureThatDoesNotFitIsRefusedBeforeItIsDrawn) {
  const TempFolder folder;
  const std::string surface = folder / "a.stl", picture = folder / "a.png";
  write_surface(surface, cube());
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", picture, "--size", "8000,8000",
                                    "--memory", "0.5"}),
               3, "a.stl: memory: expected about 0.8 GB to draw it, found 0.5 GB");
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(InputFiles, DataOutsideOfTheHeadersFolderNeedLeave) {
  const TempFolder folder;
  write_bytes(folder / "data", std::string(64, '\1'));
  const std::string header = folder / "in/a.nhdr";
  write_bytes(header,
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n"
              "data file: ../data\n");
  const ProgramRun refused = run_program(folder, {"info", header});
  EXPECT_THAT(refused.out, testing::HasSubstr("expected a data file in the header's folder"));
  const ProgramRun allowed = run_program(folder, {"info", header, "--allow-outside"});
  EXPECT_EQ(allowed.status, 0);
  EXPECT_THAT(allowed.out, testing::HasSubstr("values 1 to 1"));
}

TEST(InputFiles, PathsThatCannotBeReadAreRefusedByEachCommand) {
  const TempFolder folder;
  const std::string surface = folder / "ball.stl", out = folder / "b.stl", scan = folder / "x.nii";
  write_surface(surface, cube());
  std::filesystem::create_symlink("loop.stl", folder / "loop.stl");
  ASSERT_EQ(mkfifo((folder / "pipe.stl").c_str(), 0600), 0);
  const std::pair<std::string, const char*> paths[] = {
      {folder / "loop.stl", "levels of symbolic links"},
      {folder / "pipe.stl", "expected a file or a directory, found neither"},
      {folder / (std::string(300, 'a') + ".stl"), "file name too long"},
      {folder / "none.stl", "no such file or directory"}};
  for (const auto& [path, why] : paths) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", path},
          {"compare", surface, path},
          {"decimate", path, "-o", out, "--tolerance", "1"},
          {"picture", path, "-o", folder / "b.png"},
          {"segment", path, "-o", out},
          {"baseline", path, "-o", out},
          {"remesh", path, "--metric", path, "-o", folder / "b.mesh"},
          {"segment", scan, "--labels", path, "-o", out},
          {"segment", scan, "--mask", path, "-o", out},
          {"segment", scan, "--probabilities", path, "-o", out}}) {
      SCOPED_TRACE(command[0] + ": " + why);
      EXPECT_FAILS(run_program(folder, command), 3, why);
    }
  }
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
// The files of a run: refused before the work, together at its end, told in the report.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "mesamis/files/sha256.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run({"phantom", "sphere", "--size", "12,12,12", "-o", scan()}).status, 0);
    files_ = folder_.file_count();
  }
  ProgramRun run(const std::vector<std::string>& arguments) {
    return run_program(folder_, arguments);
  }
  /// A run that takes seconds, unless it is refused at once.
  ProgramRun segment(std::vector<std::string> options) {
    options.insert(options.begin(), {"segment", scan(), "--preview", "--quiet"});
    return run(options);
  }
  std::string scan() const { return folder_ / "scan.nrrd"; }
  void expect_nothing_new() { EXPECT_EQ(folder_.file_count(), files_); }

  TempFolder folder_;
  std::ptrdiff_t files_ = 0;  ///< before the run that is tested, with stdout and stderr
};

TEST_F(Outputs, ABadReportLeavesNoSurface) {
  const std::string surface = folder_ / "a.stl";
  EXPECT_FAILS(segment({"-o", surface, "--report", folder_ / "missing/a.json"}), 3, "no folder");
  EXPECT_FAILS(segment({"-o", surface, "--report", folder_ / (std::string(300, 'x') + ".json")}), 3,
               "name too long");
  expect_nothing_new();
}

TEST_F(Outputs, WhatIsNoFileIsRefusedAtOnce) {
  fs::create_directory(folder_ / "d.json");
  ASSERT_EQ(mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
  fs::create_symlink("circle.json", folder_ / "circle.json");
  fs::create_symlink("/dev/full", folder_ / "device.json");
  files_ = folder_.file_count();
  for (const char* name : {"d.json", "pipe.json", "circle.json", "device.json"}) {
    EXPECT_FAILS(segment({"-o", folder_ / "a.stl", "--report", folder_ / name}), 3, name);
  }
  expect_nothing_new();
}

TEST_F(Outputs, EachHasAFileOfItsOwn) {
  const std::string surface = folder_ / "a.stl";
  EXPECT_FAILS(
      segment({"-o", surface, "-o", folder_ / "../" / folder_.path().filename() / "a.stl"}), 2,
      "found it twice");
  EXPECT_FAILS(run({"segment", scan(), "--labelmap", scan()}), 2, "another file than the input");
  EXPECT_FAILS(run({"segment", scan(), "--mesh", folder_ / "a.mesh", "--mesh", folder_ / "a.mesh"}),
               2, "found it twice");
  expect_nothing_new();
}

TEST_F(Outputs, AMeditMeshNeedsAPlaceForItsFields) {
  fs::create_directory(folder_ / "a.sol");
  EXPECT_FAILS(run({"segment", scan(), "--mesh", folder_ / "a.mesh"}), 3, "a.sol");
}

TEST_F(Outputs, EveryCommandKnowsItsOwn) {
  ASSERT_EQ(segment({"-o", folder_ / "a.stl"}).status, 0);
  const std::string a = folder_ / "a.stl";
  EXPECT_FAILS(run({"decimate", a, "-o", a, "--tolerance", "1"}), 2, "another file than the input");
  EXPECT_FAILS(run({"baseline", scan(), "-o", folder_ / "b.stl", "--report", folder_ / "x/b.json"}),
               3, "no folder");
  EXPECT_FAILS(run({"compare", a, a, "--report", folder_ / "r", "--histogram", folder_ / "r"}), 2,
               "found it twice");
  EXPECT_FAILS(run({"phantom", "sphere", "-o", folder_ / "p.nrrd", "--truth", folder_ / "x/t.stl"}),
               3, "no folder");
  EXPECT_FAILS(run({"picture", a, "-o", folder_ / "x/a.png"}), 3, "x/a.png: cannot be written");
}

TEST_F(Outputs, AStudyKnowsThatItsReportCannotBeWritten) {
  fs::create_directories(folder_ / "study/study.json");
  EXPECT_FAILS(run({"study", scan(), "--reference", "none.stl", "-o", folder_ / "study",
                    "--subsample", "1"}),
               3, "study.json: cannot be written");
}

TEST_F(Outputs, TheReportNamesTheSetThatItBelongsTo) {
  const std::string report = folder_ / "a.json";
  ASSERT_EQ(segment({"-o", folder_ / "a.stl", folder_ / "a.ply", "--labelmap", folder_ / "a.nii.gz",
                     "--report", report})
                .status,
            0);
  const auto files = nlohmann::json::parse(read_bytes(report))["files"];
  ASSERT_EQ(files.size(), 3u);
  for (const auto& file : files) {
    const fs::path path = file["path"].get<std::string>();
    EXPECT_EQ(file["sha256"], sha256(path));
    EXPECT_EQ(file["bytes"], fs::file_size(path));
  }
}

TEST_F(Outputs, TheNamesThatLabelsGiveAreCheckedBeforeTheWork) {
  ASSERT_EQ(segment({"--labelmap", folder_ / "a.nii"}).status, 0);
  fs::create_directory(folder_ / "x-object.stl");
  fs::create_directory(folder_ / "x-1.stl");
  const ProgramRun ended = run({"segment", "--labels", folder_ / "a.nii", "-o",
                                folder_ / "x-{label}.stl", "--report", folder_ / "r.json"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.err, HasSubstr("expected the name of a file"));
  EXPECT_FALSE(fs::exists(folder_ / "r.json"));
}

TEST_F(Outputs, ANameIsUtf8) {
  EXPECT_FAILS(segment({"-o", folder_ / "a.3mf", "--name", "a\xff"}), 2, "--name: expected UTF-8");
  EXPECT_FAILS(segment({"-o", folder_ / "a.3mf", "--name", "\xed\xa0\x80"}), 2, "--name");
  EXPECT_EQ(
      segment({"-o", folder_ / "a.3mf", "--name", "h\xc3\xbc\xe2\x82\xac\xf0\x9f\x98\x80"}).status,
      0);
}

}  // namespace
}  // namespace mesamis

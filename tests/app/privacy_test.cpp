// SPDX-License-Identifier: Apache-2.0
// What is known of a patient stays in the scan.
#include <gmock/gmock.h>

#include <cmath>

#include "support/dicom_bytes.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPatient = "UNMISTAKABLE^NAME";
constexpr const char* kDescription = "series of UNMISTAKABLE";

/// A ball, slice by slice, as an archive of a hospital has it.
void write_scan(const fs::path& folder) {
  constexpr int kSize = 24;
  SliceBytes slice;
  slice.columns = slice.rows = kSize;
  slice.spacing = {1, 1};
  slice.patient = kPatient;
  slice.description = kDescription;
  for (int k = 0; k < kSize; ++k) {
    slice.pixels.clear();
    for (int n = 0; n < kSize * kSize; ++n) {
      const double r = std::hypot(n % kSize - 11.5, n / kSize - 11.5, k - 11.5);
      slice.pixels.push_back(static_cast<std::int16_t>(r < 7 ? 1000 : -1000));
    }
    slice.position = {0, 0, 1.0 * k};
    write_bytes(folder / std::to_string(k), slice.bytes());
  }
}

TEST(Privacy, NoOutputOfARunNamesThePatient) {
  const TempFolder folder;
  write_scan(folder / "in");
  std::vector<std::string> arguments{"segment",       folder / "in",
                                     "--adaptations", "2",
                                     "--max-tets",    "5000",
                                     "--labelmap",    folder / "out/l.nrrd",
                                     "--report",      folder / "out/r.json",
                                     "--html",        folder / "out/r.html",
                                     "--pictures",    folder / "out/pictures",
                                     "--log-json"};
  for (const char* name : {"a.stl", "a.ply", "a.obj", "a.vtp", "a.3mf", "a.amf"}) {
    arguments.insert(arguments.end(), {"-o", folder / "out" / name});
  }
  for (const char* name : {"a.vtu", "a.msh", "a.inp", "a.mesh"}) {
    arguments.insert(arguments.end(), {"--mesh", folder / "out" / name});
  }
  fs::create_directory(folder / "out");
  const ProgramRun run = run_program(folder, arguments);
  ASSERT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
  EXPECT_THAT(run.out + run.err, testing::Not(testing::HasSubstr("UNMISTAKABLE")));
  int files = 0;
  for (const auto& file : fs::recursive_directory_iterator(folder / "out")) {
    if (file.is_directory()) continue;
    EXPECT_EQ(read_bytes(file.path()).find("UNMISTAKABLE"), std::string::npos) << file.path();
    ++files;
  }
  EXPECT_GE(files, 12);
}

TEST(Privacy, APageHasNoWordsOfAScanFromWarnings) {
  const TempFolder folder;
  write_scan(folder / "in");
  SliceBytes scout;  // one more series: a warning names both
  scout.series = "1.2.4";
  scout.columns = scout.rows = 24;
  scout.pixels.resize(24 * 24);
  scout.description = "knee of 3 May";
  write_bytes(folder / "in/scout", scout.bytes());
  const auto page_of = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"segment", folder / "in", "--max-tets", "4000", "--adaptations", "2",
                               "--html", folder / "r.html"});
    const ProgramRun run = run_program(folder, more);
    EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr("knee of 3 May"));
    return read_bytes(folder / "r.html");
  };
  const std::string page = page_of({});
  for (const char* word : {"UNMISTAKABLE", "knee of", "3 May"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("1 warning hidden, which may name files or people: see the report"),
            std::string::npos);
  EXPECT_NE(page_of({"--html-names"}).find("knee of 3 May"), std::string::npos);
}

TEST(Privacy, InfoTellsTheSeriesButNotThePatient) {
  const TempFolder folder;
  write_scan(folder / "in");
  const ProgramRun run = run_program(folder, {"info", folder / "in"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr(kDescription));
  EXPECT_THAT(run.out + run.err, testing::Not(testing::HasSubstr(kPatient)));
}

}  // namespace
}  // namespace mesamis

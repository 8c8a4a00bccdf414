// SPDX-License-Identifier: Apache-2.0
// Every source of the library has a test of its own name: src/mesamis/ROOM/FILE.cpp is tested by
// tests/ROOM/FILE_test.cpp, or the table below says which file tests it and why.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string>

#include "style/rooms.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct TestedBy {
  const char *source, *test, *reason;
};

constexpr std::array kTestedElsewhere{
    TestedBy{"baseline/itk_absent", "baseline/geodesic_contour_test.cpp",
             "the stand-in of itk_level_set where ITK is missing"},
    TestedBy{"baseline/vtk_absent", "baseline/isosurface_test.cpp",
             "the stand-in of vtk_isosurface where VTK is missing"},
    TestedBy{"baseline/vtk_isosurface", "baseline/isosurface_test.cpp",
             "isosurface() is this function with its options checked"},
    TestedBy{"method/setting_rows", "method/setting_table_test.cpp",
             "the rows of the table: each is set, read and written there"},
    TestedBy{"picture/draw_slice", "picture/picture_test.cpp",
             "draw_slice() of the same door, with the same eyes for pixels"},
    TestedBy{"volume_files/dicom_jpeg12", "volume_files/dicom_jpeg_test.cpp",
             "decode_jpeg() for 9 to 12 bits"},
    TestedBy{"volume_files/dicom_jpeg16", "volume_files/dicom_jpeg_test.cpp",
             "decode_jpeg() for 13 to 16 bits"},
    TestedBy{"volume_files/dicom_jpeg8", "volume_files/dicom_jpeg_test.cpp",
             "decode_jpeg() for 2 to 8 bits"},
    TestedBy{"slabs/mesh_plan", "slabs/mesh_tasks_test.cpp",
             "plans are of meshes, and lead to the next: those tests make them"},
};

bool is_tested(const std::string& source) {
  const fs::path tests = fs::path(MESAMIS_SOURCE_DIR) / "tests";
  if (fs::exists(tests / (source + "_test.cpp"))) return true;
  return std::any_of(kTestedElsewhere.begin(), kTestedElsewhere.end(), [&](const TestedBy& row) {
    return row.source == source && fs::exists(tests / row.test);
  });
}

TEST(Sources, HaveATestOfTheirName) {
  for (const auto& [room, files] : read_rooms()) {
    for (const auto& file : project_files(files.folder, {".cpp"})) {
      const std::string source = room + "/" + file.stem().string();
      EXPECT_TRUE(is_tested(source)) << "src/mesamis/" << source << ".cpp has no tests/" << source
                                     << "_test.cpp, and the table names no other test";
    }
  }
}

TEST(Sources, OfTheTableExistAndHaveNoTestOfTheirName) {
  const fs::path root(MESAMIS_SOURCE_DIR);
  for (const auto& [source, test, reason] : kTestedElsewhere) {
    const std::string name = std::string("mesamis/") + source + ".cpp";
    EXPECT_TRUE(fs::exists(root / "src" / name) || fs::exists(root / "tools" / name)) << source;
    EXPECT_TRUE(fs::exists(root / "tests" / test)) << test;
    EXPECT_FALSE(fs::exists(root / "tests" / (std::string(source) + "_test.cpp"))) << source;
  }
}

/// Which headers of GDCM a file includes.
std::string gdcm_headers(const fs::path& file) {
  static const std::regex include("#include <(gdcm\\w+\\.h)>");
  const std::string text = file_text(file);
  std::string found;
  for (std::sregex_iterator m(text.begin(), text.end(), include), end; m != end; ++m) {
    found += (found.empty() ? "" : " ") + (*m)[1].str();
  }
  return found;
}

/// GDCM's readers of files believe lengths that a file states. It is given single compressed
/// pictures, whose headers were checked, and never a file or a data set.
TEST(Sources, GdcmIsGivenSinglePicturesAlone) {
  std::size_t seen = 0;
  for (const char* folder : {"src", "tools", "app"}) {
    for (const fs::path& file : project_files(folder, {".h", ".cpp"})) {
      const std::string headers = gdcm_headers(file);
      if (headers.empty()) continue;
      ++seen;
      EXPECT_EQ(file.filename(), "gdcm_picture.cpp") << file;
      EXPECT_EQ(headers, "gdcmImage.h gdcmSequenceOfFragments.h gdcmTrace.h gdcmTransferSyntax.h");
    }
  }
  EXPECT_EQ(seen, 1u);
}

}  // namespace
}  // namespace mesamis

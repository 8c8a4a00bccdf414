// SPDX-License-Identifier: Apache-2.0
// Broken files: each is a valid map or refused in one line that begins with its path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "mesamis/label_files/label_table.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "support/read_scan.h"
#include "support/seg_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// Whether the work is done; a refusal must be one line that begins with the path.
template <class Work>
bool is_done(const std::filesystem::path& path, Work work) {
  try {
    work();
    return true;
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.rfind(path.string(), 0), 0u) << line;
    EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << line;
    return false;
  }
}

bool is_read(const std::filesystem::path& path) {
  is_done(path, [&] { read_probabilities({path}); });
  return is_done(path, [&] {
    const LabelFile file = read_label_map(path);
    EXPECT_NO_THROW(require_valid(file.map)) << path;
  });
}

/// The file cut off at each of many places, and with flipped bytes.
void fuzz(const std::string& name, const std::string& well, int rounds = 400) {
  const TempFolder folder;
  write_bytes(folder / name, well);
  ASSERT_TRUE(is_read(folder / name)) << name;
  const double before = peak_mb();
  const std::size_t step = std::max<std::size_t>(1, well.size() / 300);
  for (std::size_t end = 0; end < well.size(); end += step) {
    write_bytes(folder / name, well.substr(0, end));
    is_read(folder / name);
  }
  std::mt19937 random(11);
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = well;
    for (int flip = 0; flip < 4; ++flip) {
      const std::size_t reach =
          random() % 2 ? well.size() : std::min<std::size_t>(600, well.size());
      bytes[random() % reach] = static_cast<char>(random());
    }
    write_bytes(folder / name, bytes);
    is_read(folder / name);
  }
  EXPECT_LT(peak_mb() - before, 400);
}

TEST(HostileLabels, Segmentations) {
  SegBytes seg = small_seg();
  seg.segments = {{1, "a", {1, 2, 3}}, {2, "b", {}}};
  seg.frames.push_back({2, {10, 20, 34}, {1, 1, 1}});
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kDeflated}) {
    seg.coding = coding;
    for (const bool open : {false, true}) {
      seg.in_open_sequences = open;
      fuzz("a.dcm", seg.bytes());
    }
  }
}

TEST(HostileLabels, LabelMapsAndSharesOfDicom) {
  SegBytes seg = small_seg();
  seg.bits = 8;
  seg.type = "FRACTIONAL";
  fuzz("a.dcm", seg.bytes());
  seg.type = "LABELMAP";
  fuzz("a.dcm", seg.bytes());
}

LabelMap small_map(std::size_t layers) {
  LabelMap map;
  map.size = {4, 3, 2};
  map.segments = {{"hip", 3, 0, {1, 2, 3}}, {"skin", 300, 0, {}}};
  map.layers.assign(layers, std::vector<std::uint16_t>(24));
  for (std::size_t n = 0; n < 24; ++n) map.layers[n % layers][n] = n % 3 ? 3 : 300;
  return with_all_segments(map);
}

TEST(HostileLabels, FilesThatWeWrite) {
  for (const char* name : {"a.nii", "a.nii.gz", "a.seg.nrrd", "b.seg.nrrd"}) {
    std::string bytes;
    {
      const TempFolder folder;
      write_label_map(folder / name, small_map(name[0] == 'b' ? 2 : 1));
      bytes = read_bytes(folder / name);
    }
    fuzz(name, bytes);
  }
}

TEST(HostileLabels, Tables) {
  const TempFolder folder;
  const std::string well = "# table\n1 255 0 0 1 1 1 \"left femur\"\n2 hip 1 2 3 255\n3 bone\n";
  std::mt19937 random(3);
  for (std::size_t round = 0; round < 500; ++round) {
    std::string text = well.substr(0, round < well.size() ? round : well.size());
    if (round >= well.size()) text[random() % text.size()] = static_cast<char>(random());
    write_bytes(folder / "a.label", text);
    is_done(folder / "a.label", [&] { read_label_table(folder / "a.label"); });
  }
}

/// Headers that promise more than there is are refused before memory is asked for.
TEST(HostileLabels, SmallFilesDoNotAskForMemory) {
  const TempFolder folder;
  const double before = peak_mb();
  const auto refused = [&](const std::string& name, const std::string& bytes, const char* why) {
    write_bytes(folder / name, bytes);
    EXPECT_REFUSED(read_label_map(folder / name), HasSubstr(why));
  };
  const std::string nrrd =
      "NRRD0004\ntype: uint8\ndimension: 4\nspace: RAS\nencoding: gzip\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nsizes: ";
  refused("a.nrrd", nrrd + "4000 1000 1000 1000\n\n" + packed("x"), "expected 1 to 1099 values");
  refused("b.nrrd", nrrd + "1000 1000 1000 1000\n\n" + packed("x"), "1000 x 1000 x 1000 x 1000");
  refused("c.nrrd", nrrd + "0 1000 1000 1000\n\n" + packed("x"), "found 0");
  NiftiBytes nifti;
  nifti.dim = {3, 30000, 30000, 1000, 1, 1, 1, 1};
  refused("a.nii.gz", packed(nifti.header()), "30000 x 30000 x 1000");
  nifti = {};
  nifti.vox_offset = 1e14f;
  std::string header = nifti.header();
  header[348] = 1;
  write_bytes(folder / "b.nii",
              header + bytes_of(0x7fffffff) + bytes_of(0) + std::string(200, 'x'));
  EXPECT_REFUSED(read_label_map(folder / "b.nii"), HasSubstr("bytes"));
  SegBytes seg = small_seg();
  seg.rows = seg.columns = 65535;
  seg.pixel_data = "abcd";
  for (SegFrame& frame : seg.frames) frame.pixels.clear();
  refused("a.dcm", seg.bytes(), "bytes of pixels (65535 x 65535 x 3)");
  EXPECT_LT(peak_mb() - before, 100);
}

/// Samples and labels of a file that holds what it claims, and extensions of the header that
/// repeat.
TEST(HostileLabels, WhatIsReadIsClaimedBeforeItIsTaken) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {3, 200, 200, 100, 1, 1, 1, 1};
  nifti.datatype = 2, nifti.bitpix = 8;
  const std::string labels(4'000'000, '\1');
  write_bytes(folder / "a.nii.gz", packed(nifti.header() + labels));
  EXPECT_REFUSED(read_label_map(folder / "a.nii.gz", {0.007}), HasSubstr("memory: expected"));
  EXPECT_NO_THROW(read_label_map(folder / "a.nii.gz", {0.009}));
  EXPECT_REFUSED(read_probabilities({folder / "a.nii.gz"}, {0.03}), HasSubstr("memory"));
  EXPECT_NO_THROW(read_probabilities({folder / "a.nii.gz"}, {0.033}));
  const std::vector<std::filesystem::path> twice{folder / "a.nii.gz", folder / "a.nii.gz"};
  EXPECT_REFUSED(read_probabilities(twice, {0.033}), HasSubstr("memory"));
  EXPECT_NO_THROW(read_probabilities(twice, {0.05}));
  nifti = {};
  nifti.vox_offset = 352 + 40 * 1'000'008;
  std::string header = nifti.header();
  header[348] = 1;
  for (int n = 0; n < 40; ++n) {
    header += bytes_of(1'000'008) + bytes_of(0) + std::string(1'000'000, ' ');
  }
  write_bytes(folder / "b.nii.gz", packed(header + bytes_of_all(std::vector<std::int16_t>(60, 1))));
  const LabelFile file = read_label_map(folder / "b.nii.gz", {0.02});  // its labels are well
  EXPECT_THAT(file.warnings, testing::Contains(HasSubstr("for header extensions")));
}

TEST(HostileLabels, DataOutsideOfTheHeadersFolderAreNotRead) {
  const TempFolder folder;
  write_bytes(folder / "data", std::string(8, '\1'));
  write_bytes(folder / "in/a.nhdr",
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
              "data file: ../data\n");
  EXPECT_REFUSED(read_label_map(folder / "in/a.nhdr"), HasSubstr("the header's folder"));
  EXPECT_EQ(read_label_map(folder / "in/a.nhdr", {0, true}).map.layers[0][7], 1);
}

}  // namespace
}  // namespace mesamis

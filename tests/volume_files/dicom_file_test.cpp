// SPDX-License-Identifier: Apache-2.0
// DICOM series made by hand: geometry, series, codings, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/volume_files/read_volume.h"
#include "support/dicom_bytes.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// Slice k of a stack whose samples count on from -40, 2 mm apart.
SliceBytes slice_at(int k) {
  SliceBytes slice;
  slice.position = {10, 20, 30 + 2.0 * k};
  slice.pixels = ramp<std::int16_t>(12, -40 + 12 * k);
  return slice;
}

void write_stack(const fs::path& folder, const std::vector<SliceBytes>& slices,
                 const std::string& prefix = "s") {
  for (std::size_t k = 0; k < slices.size(); ++k) {
    write_bytes(folder / (prefix + std::to_string(k) + ".dcm"), slices[k].bytes());
  }
}

std::vector<SliceBytes> stack_of(int count) {
  std::vector<SliceBytes> slices;
  for (int k = 0; k < count; ++k) slices.push_back(slice_at(k));
  return slices;
}

template <class Change>
std::vector<SliceBytes> stack_of(int count, Change&& change) {
  auto slices = stack_of(count);
  for (SliceBytes& slice : slices) change(slice);
  return slices;
}

TEST(Dicom, ReadsASeriesInEveryPlainCoding) {
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kBigEndian,
        DicomCoding::kDeflated, DicomCoding::kWithoutMeta}) {
    const TempFolder folder;
    write_stack(folder.path(), stack_of(5, [&](SliceBytes& s) { s.coding = coding; }));
    const VolumeFile file = read_volume(folder.path());
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "DICOM");
    EXPECT_EQ(file.volume.modality, "CT");
    EXPECT_THAT(file.warnings, IsEmpty());
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.origin, {10, 20, 30});
    EXPECT_EQ(file.volume.direction, Mat3{});
  }
}

TEST(Dicom, SortsByPositionWhateverTheFilesAreCalledAndWhichOneIsNamed) {
  const TempFolder folder;
  const std::vector<int> order{3, 0, 4, 1, 2};
  for (std::size_t n = 0; n < 5; ++n) {
    write_bytes(folder / ("f" + std::to_string(n)), slice_at(order[n]).bytes());
  }
  write_bytes(folder / "readme.txt", "not DICOM");
  expect_ramp(read_volume(folder.path()).volume);
  for (int n = 0; n < 5; ++n) expect_ramp(read_volume(folder / ("f" + std::to_string(n))).volume);
}

TEST(Dicom, HonoursObliqueOrientations) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const TempFolder folder;
  auto slices = stack_of(5);
  const Vec3 normal = cross(Vec3{c, s, 0}, Vec3{0, 0, -1});
  for (int k = 0; k < 5; ++k) {
    slices[static_cast<std::size_t>(k)].orientation = {c, s, 0, 0, 0, -1};
    const Vec3 p = Vec3{1, 2, 3} + (2.0 * k) * normal;
    slices[static_cast<std::size_t>(k)].position = {p.x, p.y, p.z};
  }
  write_stack(folder.path(), slices);
  const Volume volume = read_volume(folder.path()).volume;
  expect_ramp(volume);
  expect_near(volume.to_world({1, 0, 0}), {1 + c, 2 + s, 3}, 1e-6);
  expect_near(volume.to_world({0, 1, 0}), {1, 2, 2}, 1e-6);
  expect_near(volume.to_world({0, 0, 1}), Vec3{1, 2, 3} + normal, 1e-6);
  EXPECT_NO_THROW(require_usable(volume));
}

TEST(Dicom, RescalesEachSliceByItsOwn) {
  const TempFolder folder;
  auto slices = stack_of(3);
  for (std::size_t k = 0; k < 3; ++k) {
    slices[k].slope = 1 + static_cast<double>(k);
    slices[k].intercept = -1024 * static_cast<double>(k);
  }
  write_stack(folder.path(), slices);
  const Volume volume = read_volume(folder.path()).volume;
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    const double k = static_cast<double>(n / 12);
    EXPECT_FLOAT_EQ(volume.samples[n],
                    static_cast<float>((1 + k) * (static_cast<double>(n) - 40) - 1024 * k));
  }
}

TEST(Dicom, TakesTheStoredBitsAlone) {
  const auto first_samples = [](auto&& change) {
    const TempFolder folder;
    write_stack(folder.path(), stack_of(2, change));
    const auto samples = read_volume(folder.path()).volume.samples;
    return std::vector<float>(samples.begin(), samples.begin() + 3);
  };
  const auto pixels = [](SliceBytes& s, std::vector<int> values) {
    values.resize(12);
    s.pixels.clear();
    for (const int value : values) s.pixels.push_back(static_cast<std::int16_t>(value));
  };
  // 12 bits in 16, with rubbish above them: unsigned, then signed.
  const std::vector<int> words{0xA005, 0xF800, 0x0FFF};
  EXPECT_EQ(first_samples([&](SliceBytes& s) {
              s.stored = 12, s.high_bit = 11, s.is_signed = 0, pixels(s, words);
            }),
            (std::vector<float>{5, 2048, 4095}));
  EXPECT_EQ(first_samples([&](SliceBytes& s) {
              s.stored = 12, s.high_bit = 11, s.is_signed = 1, pixels(s, words);
            }),
            (std::vector<float>{5, -2048, -1}));
  // The same bits at the upper end of the word.
  EXPECT_EQ(first_samples([&](SliceBytes& s) {
              s.stored = 12, s.high_bit = 15, s.is_signed = 1;
              pixels(s, {0x005A, 0x800B, 0xFFFC});
            }),
            (std::vector<float>{5, -2048, -1}));
  EXPECT_EQ(first_samples([&](SliceBytes& s) {
              s.is_signed = 0, pixels(s, {0, 0x7FFF, 0xFFFF});
            }),
            (std::vector<float>{0, 32767, 65535}));
}

TEST(Dicom, KeepsTheValuesOfMonochrome1AndSaysSo) {
  const TempFolder folder;
  write_stack(folder.path(), stack_of(5, [](SliceBytes& s) { s.photometric = "MONOCHROME1"; }));
  const VolumeFile file = read_volume(folder.path());
  expect_ramp(file.volume);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("MONOCHROME1")));
}

TEST(Dicom, RefusesMissingSlicesUnevenGapsAndDuplicates) {
  const TempFolder folder;
  auto slices = stack_of(6);
  slices.erase(slices.begin() + 3);
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("missing"), HasSubstr("s2.dcm"), HasSubstr("s3.dcm"),
                    HasSubstr("expected 2 mm, found 4 mm")));
  slices = stack_of(5);
  slices[3].position[2] += 0.5;
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()), AllOf(HasSubstr("uneven"), HasSubstr("s2.dcm and s3.dcm"),
                                              HasSubstr("found 2.5 mm")));
  slices = stack_of(5);
  slices[3].position[2] = slices[2].position[2];
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("two at the same"), HasSubstr("s2.dcm"), HasSubstr("s3.dcm")));
}

TEST(Dicom, AcceptsPositionsRoundedToHundredths) {
  const TempFolder folder;
  auto slices = stack_of(9);
  for (std::size_t k = 0; k < slices.size(); ++k) {
    slices[k].position[2] = std::round(62.5 * static_cast<double>(k)) / 100;
  }
  write_stack(folder.path(), slices);
  EXPECT_NEAR(read_volume(folder.path()).volume.spacing.z, 0.625, 1e-9);
}

TEST(Dicom, RefusesTiltedStacks) {
  const TempFolder folder;
  auto slices = stack_of(5);
  for (std::size_t k = 0; k < 5; ++k) slices[k].position[1] += static_cast<double>(k);
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("tilt of 26.565"), HasSubstr("s1.dcm"), HasSubstr("s0.dcm"),
                    HasSubstr("1 mm"), HasSubstr("2 mm")));
  // A lean too small to be seen between neighbours adds up.
  slices = stack_of(40);
  for (std::size_t k = 0; k < 40; ++k) slices[k].position[1] += 0.03 * static_cast<double>(k);
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()), HasSubstr("tilt"));
}

TEST(Dicom, ListsSeveralSeriesAndTakesTheOneAskedFor) {
  const TempFolder folder;
  write_stack(folder.path(), stack_of(5));
  write_stack(folder.path(), stack_of(4, [](SliceBytes& s) { s.series = "4.5.6"; }), "t");
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("found 2"), HasSubstr("1.2.3"), HasSubstr("4.5.6")));
  expect_ramp(read_volume(folder.path(), {"1.2.3"}).volume, 5);
  expect_ramp(read_volume(folder.path(), {"4.5.6"}).volume, 4);
  expect_ramp(read_volume(folder / "t1.dcm").volume, 4);
  EXPECT_THAT(complaint(folder.path(), "7.8.9"), AllOf(HasSubstr("7.8.9"), HasSubstr("4.5.6")));
  const auto all = list_volumes(folder.path());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].series, "1.2.3");
  EXPECT_EQ(all[1].size, (std::array<Index, 3>{4, 3, 4}));
  EXPECT_EQ(all[1].problem, "");
}

TEST(Dicom, LeavesOutLocalizersByTheirWordAndByGeometry) {
  const std::vector<double> sagittal{0, 1, 0, 0, 0, -1};
  {
    const TempFolder folder;
    auto slices = stack_of(5);
    slices.push_back(slice_at(1));
    slices.back().orientation = sagittal;
    write_stack(folder.path(), slices);
    const VolumeFile file = read_volume(folder.path());
    expect_ramp(file.volume);
    EXPECT_THAT(file.warnings, Contains(HasSubstr("1 slices left out")));
  }
  const TempFolder folder;
  write_stack(folder.path(), stack_of(5));
  write_stack(folder.path(),
              stack_of(5,
                       [&](SliceBytes& s) {
                         s.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER", s.orientation = sagittal;
                       }),
              "t");
  expect_ramp(read_volume(folder.path()).volume);
}

TEST(Dicom, TakesTheOnlyVolumeBesideSinglePictures) {
  const TempFolder folder;
  write_stack(folder.path(), stack_of(5));
  write_stack(folder.path(), stack_of(1, [](SliceBytes& s) { s.series = "9.9"; }), "scout");
  const VolumeFile file = read_volume(folder.path());
  expect_ramp(file.volume);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("9.9")));
}

TEST(Dicom, RefusesTwoOrientationsOrTwoSizesInOneSeries) {
  const TempFolder folder;
  auto slices = stack_of(4);
  slices[2].orientation = slices[3].orientation = {0, 1, 0, 0, 0, -1};
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()), HasSubstr("another orientation"));
  slices = stack_of(4);
  slices[2].spacing = slices[3].spacing = {2, 2};
  write_stack(folder.path(), slices);
  EXPECT_THAT(complaint(folder.path()), HasSubstr("another size or pixel spacing"));
}

TEST(Dicom, RefusesOneSlice) {
  const TempFolder folder;
  write_stack(folder.path(), stack_of(1));
  EXPECT_THAT(complaint(folder.path()), HasSubstr("one slice is not a volume"));
  EXPECT_THAT(complaint(folder / "s0.dcm"), HasSubstr("one slice is not a volume"));
}

TEST(Dicom, RefusesWhatItWouldGetWrong) {
  const auto spoilt = [](auto&& change) {
    const TempFolder folder;
    write_stack(folder.path(), stack_of(3, change));
    return complaint(folder.path());
  };
  EXPECT_THAT(spoilt([](auto& s) { s.position = {}; }), HasSubstr("(0020,0032)"));
  EXPECT_THAT(spoilt([](auto& s) { s.orientation = {1, 0, 0}; }), HasSubstr("(0020,0037)"));
  EXPECT_THAT(spoilt([](auto& s) { s.orientation = {0, 0, 0, 0, 0, 0}; }), HasSubstr("length 0"));
  EXPECT_THAT(spoilt([](auto& s) { s.orientation = {1, 0, 0, 0.1, 0.995, 0}; }),
              HasSubstr("orthogonal"));
  EXPECT_THAT(spoilt([](auto& s) { s.spacing = {0, 1}; }), HasSubstr("Pixel Spacing"));
  EXPECT_THAT(spoilt([](auto& s) { s.spacing = {1}; }), HasSubstr("(0028,0030)"));
  EXPECT_THAT(spoilt([](auto& s) { s.photometric = "RGB"; }), HasSubstr("RGB"));
  EXPECT_THAT(spoilt([](auto& s) { s.image_type = "ORIGINAL\\PRIMARY\\MOSAIC"; }),
              HasSubstr("mosaic"));
  EXPECT_THAT(spoilt([](auto& s) { s.slope = 0; }), HasSubstr("slope 0"));
  EXPECT_THAT(spoilt([](auto& s) { s.rows = 0; }), HasSubstr("4 x 0"));
  EXPECT_THAT(spoilt([](auto& s) { s.columns = s.rows = 60000; }),
              HasSubstr("expected 7200000000 bytes"));
  EXPECT_THAT(spoilt([](auto& s) { s.allocated = 12; }), HasSubstr("12 bits"));
  EXPECT_THAT(spoilt([](auto& s) { s.stored = 17; }), HasSubstr("17 stored"));
  EXPECT_THAT(spoilt([](auto& s) { s.pixels.pop_back(); }), HasSubstr("found 22"));
}

// A slice that is cut off must not be taken for one that is not there.
TEST(Dicom, RefusesASeriesWithABrokenFile) {
  const TempFolder folder;
  write_stack(folder.path(), stack_of(5));
  const std::string last = slice_at(4).bytes();
  write_bytes(folder / "s4.dcm", last.substr(0, last.size() - 4));
  EXPECT_THAT(complaint(folder.path()), AllOf(HasSubstr("s4.dcm"), HasSubstr("broken")));
  EXPECT_THAT(complaint(folder / "s0.dcm"), AllOf(HasSubstr("s4.dcm"), HasSubstr("broken")));
}

TEST(Dicom, ReadsEnhancedFilesFrameByFrame) {
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kBigEndian}) {
    for (const bool open : {false, true}) {
      const TempFolder folder;
      write_bytes(folder / "e.dcm", enhanced_bytes({2, 0, 3, 1, 4}, open, coding));
      const VolumeFile file = read_volume(folder / "e.dcm");
      expect_ramp(file.volume);
      EXPECT_EQ(file.volume.modality, "MR");
      expect_near(file.volume.spacing, {0.5, 1.25, 2});
      expect_near(file.volume.origin, {10, 20, 30});
    }
  }
  const TempFolder folder;
  write_bytes(folder / "e.dcm", enhanced_bytes({0, 1, 3, 4}, true, DicomCoding::kExplicit));
  EXPECT_THAT(complaint(folder / "e.dcm"), AllOf(HasSubstr("missing"), HasSubstr("frame 2")));
}

TEST(Dicom, SurvivesDeepNesting) {
  std::string nested;
  for (int depth = 0; depth < 100'000; ++depth) {
    nested += bytes_of(std::uint32_t{0x11110008}) + std::string("SQ\0\0", 4) +
              bytes_of(0xffffffffu) + bytes_of(std::uint32_t{0xe000fffe}) + bytes_of(0xffffffffu);
  }
  const TempFolder folder;
  write_bytes(folder / "a.dcm", SliceBytes::file(nested, DicomCoding::kExplicit));
  EXPECT_THAT(complaint(folder / "a.dcm"), HasSubstr("nested"));
}

/// Slices at 0, 2, 4 and so on, each with some change.
template <class Change>
std::filesystem::path changed_series(const TempFolder& folder, const Change& change,
                                     const std::string& prefix = "") {
  for (int k = 0; k < 4; ++k) {
    SliceBytes slice;
    slice.position = {0, 0, 2.0 * k};
    slice.pixels = ramp<std::int16_t>(12, 12 * k);
    change(slice, k);
    write_bytes(folder / (prefix + std::to_string(k) + ".dcm"), slice.bytes());
  }
  return folder / "";
}

TEST(Dicom, AGivenSpacingTakesThePlaceOfAPixelSpacing) {
  const std::vector<std::pair<std::string, std::string>> spoilt{
      {"", "found none"}, {"1,2\\1", "\"1,2"}, {"0\\0", "found 0 x 0"}, {"-1\\1", "found -1 x 1"}};
  for (const auto& [text, found] : spoilt) {
    const TempFolder folder;
    const auto path = changed_series(folder, [&text = text](SliceBytes& slice, int) {
      slice.spacing.clear();
      if (!text.empty()) slice.more[0x00280030] = {"DS", text};
    });
    EXPECT_THAT(complaint(path), testing::AllOf(HasSubstr(found), HasSubstr("--spacing"))) << text;
    const Volume volume = read_volume(path, {.spacing = Vec3{1, 1.2, 3}}).volume;
    EXPECT_EQ(volume.spacing, (Vec3{1, 1.2, 3})) << text;
    EXPECT_EQ(volume.size[2], 4);
  }
}

TEST(Dicom, SliceLocationAlonePlacesSlices) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int k) {
    slice.position.clear();
    slice.orientation.clear();
    slice.more[0x00201041] = {"DS", std::to_string(30 - 2.5 * k)};
  });
  const VolumeFile file = read_volume(path);
  EXPECT_NEAR(file.volume.spacing.z, 2.5, 1e-9);
  EXPECT_EQ(file.volume.samples[0], 36) << "the lowest comes first";
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("placed by Slice Location")));
}

TEST(Dicom, SliceLocationsLieAlongTheNormalOfAnOrientation) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int k) {
    slice.position.clear();
    slice.orientation = {0, 1, 0, 0, 0, 1};
    slice.more[0x00201041] = {"DS", std::to_string(30 - 2.5 * k)};
  });
  const VolumeFile file = read_volume(path);
  EXPECT_NEAR(file.volume.spacing.z, 2.5, 1e-9);
  expect_near(transpose(file.volume.direction).rows[2], {1, 0, 0});
  EXPECT_EQ(file.volume.samples[0], 36) << "the lowest comes first";
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("whether they are mirrored")));
}

TEST(Dicom, DosesAreScaled) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int) {
    slice.more[0x3004000e] = {"DS", "0.25"};
  });
  EXPECT_EQ(read_volume(path).volume.samples[13], 13 * 0.25);
}

TEST(Dicom, InstanceNumbersPlaceSlicesByAGivenSpacing) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int k) {
    slice.position.clear();
    slice.orientation.clear();
    slice.more[0x00200013] = {"IS", std::to_string(9 - k)};
  });
  EXPECT_THAT(complaint(path), HasSubstr("Image Position"));
  const VolumeFile file = read_volume(path, {.spacing = Vec3{1, 1, 3}});
  EXPECT_EQ(file.volume.spacing, (Vec3{1, 1, 3}));
  EXPECT_EQ(file.volume.samples[0], 36);
}

TEST(Dicom, PlacesOfTwoKindsAreNotMixed) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int k) {
    slice.more[0x00201041] = {"DS", std::to_string(2 * k)};
    if (k != 2) return;
    slice.position.clear();
    slice.orientation.clear();
  });
  EXPECT_THAT(complaint(path), HasSubstr("2.dcm: expected Image Position"));
}

TEST(Dicom, CopiesOfAFileCountOnce) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int k) {
    slice.more[0x00080018] = {"UI", "1.2." + std::to_string(k)};
  });
  std::filesystem::copy_file(folder / "1.dcm", folder / "1 (copy).dcm");
  std::filesystem::copy_file(folder / "3.dcm", folder / "z.dcm");
  const VolumeFile file = read_volume(path);
  EXPECT_EQ(file.volume.size[2], 4);
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("2 files left out: copies")));
}

TEST(Dicom, SlicesInTwoEncodingsCountOnce) {
  const TempFolder folder;
  const auto number = [](SliceBytes& slice, int k) {
    slice.more[0x00200013] = {"IS", std::to_string(k)};
  };
  const auto path = changed_series(folder, number);
  const Volume plain = read_volume(path).volume;
  changed_series(
      folder,
      [&](SliceBytes& slice, int k) {
        number(slice, k);
        slice.coding = DicomCoding::kDeflated;
      },
      "packed");
  VolumeFile file = read_volume(path);
  EXPECT_EQ(file.volume.samples, plain.samples);
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("4 files left out: the same slices")));
  changed_series(
      folder,
      [&](SliceBytes& slice, int k) {
        number(slice, k + 10);
        slice.coding = DicomCoding::kDeflated;
      },
      "packed");
  EXPECT_THAT(complaint(path), HasSubstr("Instance Number")) << "others, at the same places";
}

/// Another picture at the same place, or the same UID elsewhere, is no copy.
TEST(Dicom, OtherFilesOfAUidAreNoCopies) {
  const TempFolder folder;
  const auto path = changed_series(folder, [](SliceBytes& slice, int) {
    slice.more[0x00080018] = {"UI", "1.2"};
  });
  EXPECT_EQ(read_volume(path).volume.size[2], 4) << "one UID for all slices";
  SliceBytes other;
  other.position = {0, 0, 2};
  other.pixels = ramp<std::int16_t>(12, 500);
  other.more[0x00080018] = {"UI", "1.2"};
  write_bytes(folder / "other.dcm", other.bytes());
  EXPECT_THAT(complaint(path), HasSubstr("found two at the same"));
}

/// Cone-beam CT in one file: frames without groups of their own.
std::string frames_without_groups(const std::map<std::uint32_t, std::string>& more) {
  SliceBytes frames;
  frames.position = {1, 2, 3};
  frames.orientation = {1, 0, 0, 0, 0, -1};  // the normal runs along y
  frames.pixels = ramp<std::int16_t>(48);
  frames.more[0x00280008] = {"IS", "4"};
  for (const auto& [tag, text] : more) frames.more[tag] = {"DS", text};
  return frames.bytes();
}

TEST(Dicom, FramesWithoutGroupsAreStackedAlongTheirNormal) {
  const TempFolder folder;
  const std::vector<std::pair<std::uint32_t, std::string>> steps{
      {0x00180088, "0.25"}, {0x00180050, "0.25"}, {0x3004000c, "0\\0.25\\0.5\\0.75"}};
  for (const auto& step : steps) {
    const VolumeFile file = read(folder, "a.dcm", frames_without_groups({step}));
    EXPECT_EQ(file.volume.size[2], 4);
    EXPECT_NEAR(file.volume.spacing.z, 0.25, 1e-12);
    expect_near(file.volume.origin, {1, 2, 3});
    expect_near(file.volume.direction * Vec3{0, 0, 1}, {0, 1, 0});
    EXPECT_EQ(file.volume.samples[12], -40 + 12);
    EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("stacked in their order")));
  }
  EXPECT_THAT(complaint(folder, "a.dcm", frames_without_groups({})),
              testing::AllOf(HasSubstr("4 frames"), HasSubstr("--spacing")));
  EXPECT_EQ(read_volume(folder / "a.dcm", {.spacing = Vec3{1, 1, 3}}).volume.spacing.z, 3);
}

/// Nuclear medicine places the first frame with its detector.
TEST(Dicom, FramesOfADetectorLieWhereItSays) {
  const TempFolder folder;
  for (const DicomCoding coding : {DicomCoding::kExplicit, DicomCoding::kImplicit}) {
    SliceBytes frames;
    frames.coding = coding;
    frames.position = frames.orientation = {};
    frames.pixels = ramp<std::int16_t>(48);
    frames.more[0x00180088] = {"DS", "0.25"};
    frames.more[0x00280008] = {"IS", "4"};
    DicomWriter detector(coding), set(coding);
    detector.decimals(0x00200032, {1, 2, 3});
    detector.decimals(0x00200037, {1, 0, 0, 0, 0, -1});
    set.sequence(0x00540022, {detector.bytes()});
    std::string bytes = frames.bytes();
    bytes.insert(bytes.find(std::string("\xe0\x7f\x10\x00", 4)), set.bytes());
    const VolumeFile file = read(folder, "a.dcm", bytes);
    expect_near(file.volume.origin, {1, 2, 3});
    expect_near(file.volume.direction * Vec3{0, 0, 1}, {0, 1, 0});
    EXPECT_THAT(file.warnings, testing::ElementsAre(testing::Not(HasSubstr("no orientation"))));
  }
}

TEST(Dicom, FramesAtDifferentTimesAreNoStack) {
  const TempFolder folder;
  SliceBytes frames;
  frames.pixels = ramp<std::int16_t>(48);
  frames.more[0x00280008] = {"IS", "4"};
  frames.more[0x00180088] = {"DS", "1"};
  frames.more[0x00280009] = {"AT", std::string("\x18\0\x63\x10", 4)};
  EXPECT_THAT(complaint(folder, "a.dcm", frames.bytes()), HasSubstr("different times"));
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/scan_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/bytes_span.h"
#include "support/expect_near.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ScanFile scan_named(const std::string& name) {
  ScanFile scan;
  scan.file = scan.source.file = name;
  return scan;
}

/// Two samples along x, coded as the source says.
ScanFile two_samples(const TempFolder& folder, const std::string& bytes, NumberType type) {
  write_bytes(folder / "a.raw", bytes);
  ScanFile scan = scan_named(folder / "a.raw");
  set_size(scan, {2, 1, 1});
  scan.source.type = type;
  return scan;
}

std::vector<float> samples_of(const ScanFile& scan) {
  WideBudget budget;
  return read_samples(scan, budget);
}

TEST(ScanFile, SizesAreCheckedBeforeAnythingIsAllocated) {
  ScanFile scan = scan_named("a");
  set_size(scan, {4, 3, 5});
  EXPECT_EQ(scan.grid.voxel_count(), 60u);
  EXPECT_REFUSED(set_size(scan, {4, 0, 5}), HasSubstr("a: expected 1 to 2147483647 voxels"));
  EXPECT_REFUSED(set_size(scan, {std::int64_t{1} << 31, 1, 1}), HasSubstr("axis 0"));
  EXPECT_REFUSED(set_size(scan, {1 << 20, 1 << 20, 2}), HasSubstr("more voxels"));
}

TEST(ScanFile, AxesGiveSpacingAndDirection) {
  ScanFile scan = scan_named("a");
  set_axes(scan, {Vec3{0, 2, 0}, Vec3{0, 0, 3}, Vec3{-0.5, 0, 0}});
  expect_near(scan.grid.spacing, {2, 3, 0.5});
  expect_near(scan.grid.direction.rows[0], {0, 0, -1});
  expect_near(scan.grid.direction.rows[1], {1, 0, 0});
  expect_near(scan.grid.direction.rows[2], {0, 1, 0});
  EXPECT_THAT(scan.warnings, IsEmpty());
}

/// Below 1e-5 silently, up to 1e-3 with a warning, beyond it not at all.
TEST(ScanFile, SkewedAxesAreMadeOrthonormalWithinATolerance) {
  for (const double skew : {5e-6, 5e-4}) {
    ScanFile scan = scan_named("a");
    set_axes(scan, {Vec3{1, 0, 0}, Vec3{skew, 1, 0}, Vec3{0, 0, 1}});
    EXPECT_EQ(scan.warnings.size(), skew > 1e-5 ? 1u : 0u);
    const auto& rows = scan.grid.direction.rows;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(dot(rows[a], rows[b]), a == b, 1e-14);
    }
  }
  ScanFile scan = scan_named("a");
  EXPECT_REFUSED(set_axes(scan, {Vec3{1, 0, 0}, Vec3{0.002, 1, 0}, Vec3{0, 0, 1}}),
                 HasSubstr("expected orthogonal voxel axes"));
}

TEST(ScanFile, AxesWithoutLengthAndOriginsThatAreNotFiniteAreRefused) {
  ScanFile scan = scan_named("a");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(set_axes(scan, {Vec3{1, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 1}}),
                 HasSubstr("spacing along axis 1, found 0 mm"));
  EXPECT_REFUSED(set_axes(scan, {Vec3{nan, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}),
                 HasSubstr("axis 0"));
  EXPECT_REFUSED(set_origin(scan, {0, 0, nan}), HasSubstr("expected a finite origin"));
  set_origin(scan, {-0.0, 1, 2});
  EXPECT_FALSE(std::signbit(scan.grid.origin.x));
}

TEST(ScanFile, SamplesAreReadInEitherByteOrderAndRescaled) {
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    ScanFile scan = two_samples(
        folder, bytes_of_all(std::vector<std::int16_t>{-300, 1}, big_endian), NumberType::kInt16);
    scan.source.big_endian = big_endian;
    EXPECT_THAT(samples_of(scan), ElementsAre(-300, 1));
    scan.source.slope = 0.5;
    scan.source.intercept = 10;
    EXPECT_THAT(samples_of(scan), ElementsAre(-140, 10.5F));
  }
}

TEST(ScanFile, TextAndPackedSamplesAndThoseAtTheEnd) {
  const TempFolder folder;
  ScanFile text = two_samples(folder, " 1.5e1\n-2", NumberType::kInt16);
  text.source.text = true;
  EXPECT_THAT(samples_of(text), ElementsAre(15, -2));
  ScanFile zipped = two_samples(folder, packed("skip" + std::string("\1\2", 2)), NumberType::kInt8);
  zipped.source.packing = Packing::kDeflated;
  zipped.source.skip = 4;
  EXPECT_THAT(samples_of(zipped), ElementsAre(1, 2));
  ScanFile end = two_samples(folder, "any header\x07\x08", NumberType::kInt8);
  end.source.at_end = true;
  EXPECT_THAT(samples_of(end), ElementsAre(7, 8));
}

TEST(ScanFile, TooFewAndWhereItMattersTooManyBytesAreRefused) {
  const TempFolder folder;
  EXPECT_REFUSED(samples_of(two_samples(folder, "abc", NumberType::kInt16)),
                 HasSubstr("expected 4 bytes for 2 x 1 x 1 samples, found 3"));
  ScanFile longer = two_samples(folder, "abcde", NumberType::kInt16);
  EXPECT_NO_THROW(samples_of(longer));
  longer.source.exact = true;
  EXPECT_REFUSED(samples_of(longer), HasSubstr("go on"));
}

/// A file that can hold what its header claims, but not within the limit.
TEST(ScanFile, SamplesAreClaimedBeforeTheyAreRead) {
  const TempFolder folder;
  ScanFile scan = two_samples(folder, packed(std::string(4'000'000, '\1')), NumberType::kUint8);
  scan.source.packing = Packing::kDeflated;
  set_size(scan, {200, 200, 100});
  MemoryBudget small("a", {0.015}), enough("a", {0.0161});
  EXPECT_REFUSED(read_samples(scan, small), HasSubstr("claims 16 MB for samples"));
  EXPECT_EQ(read_samples(scan, enough).size(), 4'000'000u);
  EXPECT_EQ(enough.held(), 16'000'000u);
}

TEST(ScanFile, SamplesAreAppended) {
  std::vector<float> samples{9};
  SampleSource source;
  source.type = NumberType::kUint8;
  append_samples(bytes_in("\x01\xff"), source, samples);
  EXPECT_THAT(samples, ElementsAre(9, 1, 255));
}

TEST(ScanFile, ManyValuesPerVoxelAreReadInTheOrderOfTheFile) {
  const TempFolder folder;
  WideBudget budget;
  const Opening many{budget, false, Values::kMany};
  constexpr ValueOrder kMixed = ValueOrder::kChannelsFirst, kApart = ValueOrder::kVolumesFirst;
  ScanFile scan = two_samples(folder, "abcdef", NumberType::kUint8);
  set_values(scan, {1, 3}, kMixed, many);
  EXPECT_THAT(samples_of(scan), ElementsAre('a', 'b', 'c', 'd', 'e', 'f'));
  set_values(scan, {4, 1}, kApart, many);
  EXPECT_REFUSED(samples_of(scan), HasSubstr("expected 8 bytes for 2 x 1 x 1 x 4 samples"));
  EXPECT_REFUSED(set_values(scan, {0, 1}, kApart, many), HasSubstr("values per voxel, found 0"));
  EXPECT_REFUSED(set_values(scan, {65536, 1}, kApart, many), HasSubstr("expected 1 to 65535"));
  EXPECT_REFUSED(set_values(scan, {2, 2}, kApart, many), HasSubstr("one axis of values"));
  set_size(scan, {1 << 20, 1 << 19, 1});
  EXPECT_REFUSED(set_values(scan, {1, 3}, kMixed, many),
                 HasSubstr("expected 1 to 2 values per voxel, found 3"));
}

/// Each value of 2 voxels, 2 volumes and 3 channels, in both orders, stored plain, packed, in text.
TEST(ScanFile, OneOfManyValuesIsRead) {
  const TempFolder folder;
  WideBudget budget;
  const std::string stored = "abcdefghijkl";
  std::string text;
  for (const char c : stored) text += std::to_string(static_cast<int>(c)) + " ";
  for (const ValueOrder order : {ValueOrder::kChannelsFirst, ValueOrder::kVolumesFirst}) {
    for (Index v = 0; v < 2; ++v) {
      for (Index c = 0; c < 3; ++c) {
        const bool mixed = order == ValueOrder::kChannelsFirst;
        const auto at = [&](Index voxel) {
          const Index n = mixed ? (v * 2 + voxel) * 3 + c : (c * 2 + v) * 2 + voxel;
          return static_cast<float>(stored[static_cast<std::size_t>(n)]);
        };
        for (const int way : {0, 1, 2}) {
          ScanFile scan = two_samples(folder,
                                      way == 0   ? stored
                                      : way == 1 ? packed(stored)
                                                 : text,
                                      NumberType::kUint8);
          scan.source.packing = way == 1 ? Packing::kDeflated : Packing::kPlain;
          scan.source.text = way == 2;
          scan.source.exact = true;
          Opening one{budget};
          one.choice = {v, c};
          set_values(scan, {2, 3}, order, one);
          EXPECT_THAT(samples_of(scan), ElementsAre(at(0), at(1))) << v << c << way << mixed;
          if (way > 0) continue;
          std::vector<float> slice;
          append_slices(scan, find_plain_samples(scan), {0, 1}, slice);
          EXPECT_THAT(slice, ElementsAre(at(0), at(1))) << v << c << mixed;
        }
      }
    }
  }
}

/// What lies around the value that is read is held against the file all the same.
TEST(ScanFile, OneOfManyValuesNeedsAllOfThem) {
  const TempFolder folder;
  WideBudget budget;
  Opening one{budget};
  one.choice.volume = 0;
  for (const std::string& stored : {std::string("abc"), std::string("abcde")}) {
    ScanFile scan = two_samples(folder, stored, NumberType::kUint8);
    scan.source.exact = true;
    set_values(scan, {2, 1}, ValueOrder::kVolumesFirst, one);
    EXPECT_REFUSED(samples_of(scan), HasSubstr("expected"));
  }
}

/// What is missing or cannot be used comes from the spacing that is given, and is told.
TEST(ScanFile, AGivenSpacingTakesThePlaceOfWhatIsMissing) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    ScanFile scan;
    EXPECT_REFUSED(set_stated_axes(scan, {{x, y, z}, {1, 2, bad}}), HasSubstr("--spacing"));
    scan.given_spacing = Vec3{4, 5, 6};
    set_stated_axes(scan, {{x, y, z}, {1, 2, bad}});
    EXPECT_EQ(scan.grid.spacing, (Vec3{1, 2, 6}));
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("axis 2")));
  }
  ScanFile scan;
  scan.given_spacing = Vec3{4, 5, 6};
  set_axes(scan, {y, x, Vec3{}});
  EXPECT_EQ(scan.grid.spacing, (Vec3{1, 1, 6}));
  EXPECT_EQ(scan.grid.direction * z, (Vec3{0, 0, -1})) << "across the others";
  ScanFile none;
  none.given_spacing = Vec3{4, 5, 6};
  set_axes(none, {Vec3{}, Vec3{}, Vec3{}});
  EXPECT_EQ(none.grid.direction * y, y);
}

}  // namespace
}  // namespace mesamis

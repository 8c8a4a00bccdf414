// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/write_volume.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// Turned, shifted, left-handed, with numbers that have no short decimals.
Volume odd_volume() {
  Volume volume;
  volume.size = {4, 3, 2};
  volume.spacing = {0.1, 1.0 / 3, 2.5};
  volume.origin = {-10.7, 1e-3, 1234.5678901234567};
  volume.direction = {{Vec3{0.6, 0.8, 0}, Vec3{0.8, -0.6, 0}, Vec3{0, 0, 1}}};
  for (int n = 0; n < 24; ++n) volume.samples.push_back(static_cast<float>(1000.0 / 7 * n - 900));
  return volume;
}

TEST(WriteVolume, ComesBackAsItWasWritten) {
  const TempFolder folder;
  const Volume volume = odd_volume();
  for (const bool gzip : {false, true}) {
    write_nrrd(folder / "a.nrrd", volume, {.gzip = gzip});
    const VolumeFile file = read_volume(folder / "a.nrrd");
    EXPECT_EQ(file.format, "NRRD");
    EXPECT_THAT(file.warnings, testing::IsEmpty());
    EXPECT_EQ(file.volume.size, volume.size);
    EXPECT_EQ(file.volume.samples, volume.samples);
    EXPECT_EQ(file.volume.origin, volume.origin);
    expect_near(file.volume.spacing, volume.spacing, 1e-15);
    for (std::size_t a = 0; a < 3; ++a) {
      expect_near(file.volume.direction.rows[a], volume.direction.rows[a], 1e-15);
    }
  }
}

TEST(WriteVolume, ShortsAreRounded) {
  const TempFolder folder;
  Volume volume = odd_volume();
  const NrrdOptions options{.type = SampleType::kShort, .gzip = true};
  write_nrrd(folder / "a.nrrd", volume, options);
  const Volume found = read_volume(folder / "a.nrrd").volume;
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    EXPECT_EQ(found.samples[n], std::round(volume.samples[n]));
  }
  for (const float bad : {32768.F, -32769.F, std::numeric_limits<float>::quiet_NaN()}) {
    volume.samples[5] = bad;
    EXPECT_REFUSED(write_nrrd(folder / "b.nrrd", volume, options), HasSubstr("16 bits"));
  }
  EXPECT_EQ(folder.file_count(), 1);
}

/// Counts what is read at once; fails at a slice.
class WatchedSlices : public SliceSource {
 public:
  explicit WatchedSlices(const Volume& volume, Index bad = -1) : slices_(volume), bad_(bad) {}
  const VoxelGrid& grid() const override { return slices_.grid(); }
  std::vector<float> read(Index first, Index count) const override {
    most_ = std::max(most_, count);
    if (first <= bad_ && bad_ < first + count) throw InputError("a slice that cannot be read");
    return slices_.read(first, count);
  }
  Index most() const { return most_; }

 private:
  VolumeSlices slices_;
  Index bad_;
  mutable Index most_ = 0;
};

Volume many_slices() {
  Volume volume = odd_volume();
  volume.size = {90, 80, 17};
  volume.samples.resize(volume.voxel_count());
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    volume.samples[n] = static_cast<float>(n * n % 1009) - 300.25F;
  }
  return volume;
}

TEST(WriteVolume, BytesDoNotDependOnTheSlabs) {
  const TempFolder folder;
  const Volume volume = many_slices();
  for (const SampleType type : {SampleType::kFloat, SampleType::kShort}) {
    for (const bool gzip : {false, true}) {
      write_nrrd(folder / "whole.nrrd", volume, {.type = type, .gzip = gzip});
      const std::string whole = read_bytes(folder / "whole.nrrd");
      for (const Index slab : {1, 5, 17, 1000}) {
        const WatchedSlices source(volume);
        write_nrrd(folder / "slabs.nrrd", source, {.type = type, .gzip = gzip, .slab = slab});
        EXPECT_TRUE(read_bytes(folder / "slabs.nrrd") == whole) << slab;
        EXPECT_EQ(source.most(), std::min(slab, 17));
      }
    }
  }
}

TEST(WriteVolume, WhatFailsHalfwayLeavesTheFileThatWasThere) {
  const TempFolder folder;
  write_bytes(folder / "a.nrrd", "before");
  const Volume volume = many_slices();
  EXPECT_REFUSED(write_nrrd(folder / "a.nrrd", WatchedSlices(volume, 9), {.slab = 4}),
                 HasSubstr("cannot be read"));
  EXPECT_EQ(read_bytes(folder / "a.nrrd"), "before");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WriteVolume, RefusesWhatNobodyCouldRead) {
  const TempFolder folder;
  Volume volume = odd_volume();
  EXPECT_REFUSED(write_nrrd(folder / "a.nii", volume), HasSubstr(".nrrd"));
  EXPECT_REFUSED(write_nrrd(folder / "no" / "a.nrrd", volume), HasSubstr("cannot be written"));
  volume.samples.pop_back();
  EXPECT_REFUSED(write_nrrd(folder / "a.nrrd", volume), HasSubstr("expected 24 samples, found 23"));
  EXPECT_EQ(folder.file_count(), 0);
}

/// Numbers as some languages write them: 1.234,5.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// The program's locale is neither used nor changed.
TEST(WriteVolume, NumbersDoNotDependOnTheLocale) {
  const TempFolder folder;
  Volume volume = odd_volume();
  write_nrrd(folder / "a.nrrd", volume);
  const std::locale comma(std::locale::classic(), new CommaNumbers);
  const std::locale before = std::locale::global(comma);
  write_nrrd(folder / "b.nrrd", volume);
  const bool kept = std::locale() == comma;
  std::locale::global(before);
  EXPECT_TRUE(kept);
  EXPECT_EQ(read_bytes(folder / "b.nrrd"), read_bytes(folder / "a.nrrd"));
}

TEST(WriteVolume, GzipIsSmallerAndHoldsTheSameSamples) {
  const TempFolder folder;
  Volume volume;
  volume.size = {50, 40, 30};
  volume.samples.assign(volume.voxel_count(), 7);
  write_nrrd(folder / "plain.nrrd", volume);
  write_nrrd(folder / "packed.nrrd", volume, {.gzip = true});
  EXPECT_LT(std::filesystem::file_size(folder / "packed.nrrd"),
            std::filesystem::file_size(folder / "plain.nrrd") / 10);
  EXPECT_EQ(read_volume(folder / "packed.nrrd").volume.samples, volume.samples);
}

}  // namespace
}  // namespace mesamis

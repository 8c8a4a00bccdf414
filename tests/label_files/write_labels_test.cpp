// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/write_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Random labels on an oblique grid, with names that files have to escape.
LabelMap random_map(std::size_t layers, Index most) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  LabelMap map;
  map.size = {5, 4, 3};
  map.spacing = {0.75, 1.25, 1.0 / 3};
  map.origin = {-3.1, 14, 105.5};
  map.direction = Mat3{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  std::mt19937 random(5);
  map.layers.resize(layers, std::vector<std::uint16_t>(map.voxel_count()));
  for (auto& layer : map.layers) {
    for (auto& label : layer) label = random() % 2 ? 0 : static_cast<std::uint16_t>(random() % 4);
    layer[7] = static_cast<std::uint16_t>(most);
  }
  map.segments = {{"bone <1> & \"more\"", 1, 0, {7, 8, 9}}, {"no voxel: at all \\n", 9, 0, {}}};
  return with_all_segments(map);
}

void expect_same(const LabelMap& a, const LabelMap& b, double tolerance) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_EQ(a.segments, b.segments);
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 4, 0}, Vec3{0, 0, 2}}) {
    expect_near(a.to_world(p), b.to_world(p), tolerance);
  }
}

TEST(WriteLabels, NrrdRoundTripsExactly) {
  const TempFolder folder;
  for (const char* name : {"a.nrrd", "b.seg.nrrd"}) {
    for (const std::size_t layers : {1, 3}) {
      for (const Index most : {255, 256, 65535}) {
        const LabelMap map = random_map(layers, most);
        write_label_map(folder / name, map);
        const LabelFile back = read_label_map(folder / name);
        EXPECT_THAT(back.warnings, IsEmpty());
        EXPECT_EQ(back.format, "NRRD");
        expect_same(back.map, map, 1e-12);
        EXPECT_EQ(back.map.origin, map.origin);
      }
    }
  }
}

TEST(WriteLabels, NiftiRoundTrips) {
  const TempFolder folder;
  for (const char* name : {"a.nii", "b.nii.gz"}) {
    for (const Index most : {255, 65535}) {
      const LabelMap map = random_map(1, most);
      write_label_map(folder / name, map);
      const LabelFile back = read_label_map(folder / name);
      EXPECT_THAT(back.warnings, IsEmpty());
      EXPECT_EQ(back.format, "NIfTI");
      expect_same(back.map, map, 1e-4);  // its header is in single precision
    }
  }
}

TEST(WriteLabels, SamplesAreAsSmallAsTheLabelsPermit) {
  const TempFolder folder;
  const auto size = [&folder](Index most) {
    write_label_map(folder / "a.nii", random_map(1, most));
    return read_bytes(folder / "a.nii").size();
  };
  const auto type = [&folder](Index most) {
    write_label_map(folder / "a.nrrd", random_map(1, most));
    return read_bytes(folder / "a.nrrd").substr(15, 6);
  };
  EXPECT_LE(size(255) + 60, size(65535));
  EXPECT_EQ(type(255), "uint8\n");
  EXPECT_EQ(type(256), "uint16");
}

/// NIfTI (RAS) and NRRD (LPS) of one map put each label at the same point of the world.
TEST(WriteLabels, RasAndLpsAgreeInTheWorld) {
  const TempFolder folder;
  const LabelMap map = random_map(1, 200);
  write_label_map(folder / "a.nii", map);
  write_label_map(folder / "a.nrrd", map);
  const LabelMap ras = read_label_map(folder / "a.nii").map;
  const LabelMap lps = read_label_map(folder / "a.nrrd").map;
  EXPECT_EQ(labels_on(ras, map).layers, map.layers);
  EXPECT_EQ(labels_on(lps, ras).layers, map.layers);
  // The scan reader sees the same samples at the same place.
  const Volume scan = read_volume(folder / "a.nii").volume;
  EXPECT_EQ(labels_on(lps, scan).layers, map.layers);
}

TEST(WriteLabels, TheSameMapGivesTheSameBytes) {
  const TempFolder folder;
  for (const char* name : {"a.nii.gz", "a.seg.nrrd"}) {
    write_label_map(folder / name, random_map(1, 200));
    const std::string first = read_bytes(folder / name);
    write_label_map(folder / name, random_map(1, 200));
    EXPECT_EQ(read_bytes(folder / name), first);
  }
}

TEST(WriteLabels, RefusesWhatAFileCannotHoldAndLeavesNothing) {
  const TempFolder folder;
  const LabelMap map = random_map(2, 200);
  EXPECT_REFUSED(write_label_map(folder / "a.nii", map), HasSubstr("one layer in a NIfTI file"));
  EXPECT_REFUSED(write_label_map(folder / "a.mha", map), HasSubstr(".seg.nrrd"));
  LabelMap broken = map;
  broken.segments.clear();
  EXPECT_REFUSED(write_label_map(folder / "a.nrrd", broken), HasSubstr("a segment for the label"));
  LabelMap long_one;
  long_one.size = {40000, 1, 1};
  long_one.layers = {std::vector<std::uint16_t>(40000)};
  EXPECT_REFUSED(write_label_map(folder / "a.nii", long_one), HasSubstr("40000 x 1 x 1"));
  EXPECT_REFUSED(write_label_map(folder / "no" / "a.nrrd", map), HasSubstr("no"));
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis

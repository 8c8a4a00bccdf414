// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/dicom_seg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/seg_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

LabelFile read(const SegBytes& seg) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", seg.bytes());
  WideBudget budget;
  return read_dicom_labels(folder / "a.dcm", budget);
}

ProbabilityFile read_shares(const SegBytes& seg) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", seg.bytes());
  WideBudget budget;
  return read_dicom_probabilities(folder / "a.dcm", budget);
}

/// The frame's pixels times a label, as the file holds them.
void expect_slice(const LabelMap& map, Index layer, Index k, const std::vector<int>& pixels,
                  Index label) {
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const Index found = map.layers[static_cast<std::size_t>(layer)][map.offset(0, 0, k) + n];
    ASSERT_EQ(found == label, pixels[n] != 0) << "slice " << k << ", pixel " << n;
  }
}

TEST(DicomSeg, SegmentsThatDoNotOverlapShareALayer) {
  SegBytes seg = small_seg();
  seg.segments = {{1, "a", {}}, {300, "b", {}}};
  for (int k = 0; k < 3; ++k) {
    SegFrame other = seg.frames[static_cast<std::size_t>(k)];
    other.segment = 300;
    for (int& pixel : other.pixels) pixel = 1 - pixel;
    seg.frames.push_back(other);
  }
  const LabelMap map = read(seg).map;
  EXPECT_NO_THROW(require_valid(map));
  ASSERT_EQ(map.layers.size(), 1u);
  for (Index k = 0; k < 3; ++k) {
    expect_slice(map, 0, k, seg.frames[static_cast<std::size_t>(k)].pixels, 1);
    expect_slice(map, 0, k, seg.frames[static_cast<std::size_t>(k + 3)].pixels, 300);
  }
}

TEST(DicomSeg, SegmentsThatOverlapGetLayers) {
  SegBytes seg = small_seg();
  seg.segments = {{1, "a", {}}, {2, "b", {}}, {3, "c", {}}};
  seg.frames.push_back({2, {10, 20, 32}, std::vector<int>(15, 1)});
  SegFrame third{3, {10, 20, 30}, seg.frames[0].pixels};
  for (int& pixel : third.pixels) pixel = 1 - pixel;
  seg.frames.push_back(third);
  const LabelMap map = read(seg).map;
  EXPECT_NO_THROW(require_valid(map));
  ASSERT_EQ(map.layers.size(), 2u);
  EXPECT_EQ(map.segments[0].layer, 0);
  EXPECT_EQ(map.segments[1].layer, 1);
  EXPECT_EQ(map.segments[2].layer, 0);
  expect_slice(map, 0, 1, seg.frames[1].pixels, 1);
  expect_slice(map, 1, 1, std::vector<int>(15, 1), 2);
  expect_slice(map, 0, 0, third.pixels, 3);
}

TEST(DicomSeg, SlicesWithoutAFrameAreBackground) {
  SegBytes seg = small_seg();
  seg.slice_spacing = 2;
  seg.frames[2].position[2] = 40;
  seg.frames[1].position[2] = 38;
  const LabelMap map = read(seg).map;
  ASSERT_EQ(map.size[2], 6);
  for (const Index k : {1, 2, 3}) expect_slice(map, 0, k, std::vector<int>(15, 0), 1);
  expect_slice(map, 0, 4, seg.frames[1].pixels, 1);
}

TEST(DicomSeg, SegmentsWithoutAFrameStay) {
  SegBytes seg = small_seg();
  seg.segments.push_back({9, "absent", {}});
  const LabelMap map = read(seg).map;
  EXPECT_EQ(map.segments[1].name, "absent");
  EXPECT_EQ(range_of(map, map.segments[1]), std::nullopt);
}

SegBytes fractional_seg() {
  SegBytes seg;
  seg.type = "FRACTIONAL", seg.bits = 8, seg.most_fraction = 200;
  seg.segments = {{4, "half", {}}};
  seg.frames = {{4, {0, 0, 0}, {0, 99, 100, 200, 255}}, {4, {0, 0, 1}, {}}};
  return seg;
}

TEST(DicomSeg, FractionalHoldsAVoxelFromHalfTheMaximumOn) {
  const LabelMap map = read(fractional_seg()).map;
  expect_slice(map, 0, 0, {0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
}

TEST(DicomSeg, FractionalGivesProbabilities) {
  const Probabilities p = read_shares(fractional_seg()).probabilities;
  ASSERT_EQ(p.layers.size(), 1u);
  EXPECT_EQ(p.segments[0].name, "half");
  EXPECT_EQ(p.segments[0].label, 1);
  const std::vector<float> begin(p.layers[0].begin(), p.layers[0].begin() + 5);
  EXPECT_THAT(begin, ElementsAre(0, 99 / 200.0f, 0.5f, 1, 1));
  const Probabilities bits = read_shares(small_seg()).probabilities;
  EXPECT_EQ(bits.layers[0][0], 1);
  EXPECT_EQ(bits.layers[0][1], 0);
}

/// One frame per slice, its pixels the numbers of the segments.
SegBytes label_seg(int bits) {
  SegBytes seg;
  seg.sop_class = "1.2.840.10008.5.1.4.1.1.66.7", seg.type = "LABELMAP", seg.bits = bits;
  seg.segments = {{0, "background", {}}, {1, "a", {}}, {bits == 8 ? 255 : 65535, "b", {}}};
  seg.frames = {{-1, {0, 0, 0}, {0, 1, bits == 8 ? 255 : 65535}}, {-1, {0, 0, 1}, {1}}};
  return seg;
}

TEST(DicomSeg, LabelMapsOfEightAndSixteenBits) {
  for (const int bits : {8, 16}) {
    SegBytes seg = label_seg(bits);
    const Index most = bits == 8 ? 255 : 65535;
    for (const char* photometric : {"MONOCHROME2", "PALETTE COLOR"}) {
      seg.photometric = photometric;
      const LabelMap map = read(seg).map;
      ASSERT_EQ(map.layers.size(), 1u);
      EXPECT_EQ(map.segments.size(), 2u);
      EXPECT_EQ(map.layers[0][1], 1);
      EXPECT_EQ(map.layers[0][2], most);
      EXPECT_EQ(map.layers[0][15], 1);
      EXPECT_NO_THROW(require_valid(map));
    }
    EXPECT_REFUSED(read_shares(seg), HasSubstr("one of segment numbers"));
    seg.frames[1].pixels = {2};
    EXPECT_REFUSED(read(seg), HasSubstr("found 2 in frame 2"));
    seg.frames[1].position[2] = 0;
    EXPECT_REFUSED(read(seg), HasSubstr("0018,0088"));
  }
}

TEST(DicomSeg, RleFramesOfALabelMap) {
  SegBytes seg = label_seg(8);
  seg.transfer_syntax = "1.2.840.10008.1.2.5";
  const auto fragment = [](const std::string& packed) {
    std::string header(64, '\0');
    header.replace(0, 8, bytes_of(1u) + bytes_of(64u));
    const std::string content = header + packed;
    return bytes_of(std::uint16_t{0xfffe}) + bytes_of(std::uint16_t{0xe000}) +
           bytes_of(static_cast<std::uint32_t>(content.size())) + content;
  };
  std::string bytes = seg.bytes();
  bytes.resize(bytes.rfind(std::string("\xe0\x7f\x10\x00OB", 6)));
  bytes += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12);
  bytes += std::string("\xfe\xff\x00\xe0\0\0\0\0", 8);            // no offsets
  bytes += fragment(std::string("\x02\x00\x01\xff\xf5\x00", 6));  // 0 1 255, then twelve times 0
  bytes += fragment(std::string("\xf2\x01", 2));                  // fifteen times 1
  bytes += std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  const TempFolder folder;
  write_bytes(folder / "a.dcm", bytes);
  WideBudget budget;
  const LabelMap map = read_dicom_labels(folder / "a.dcm", budget).map;
  EXPECT_EQ(map.layers[0][2], 255);
  EXPECT_EQ(map.layers[0][14], 0);
  EXPECT_THAT(std::vector<int>(map.layers[0].begin() + 15, map.layers[0].end()), Each(1));
}

TEST(DicomSeg, OverlapsAreBoundedByTheBytesOfTheFile) {
  SegBytes seg;
  seg.segments.clear();
  seg.slice_spacing = 1;
  for (int n = 1; n <= 40; ++n) {  // all at one place, so that each needs a layer
    seg.segments.push_back({n, "s", {}});
    seg.frames.push_back({n, {0, 0, 0}, {1}});
  }
  EXPECT_EQ(read(seg).map.layers.size(), 40u);
  seg.frames.push_back({1, {0, 0, 3e5}, {1}});
  EXPECT_REFUSED(read(seg), HasSubstr("8192 voxels per byte"));
}

/// Two frames far from one another: most voxels are in no frame.
TEST(DicomSeg, LayersAreClaimedBeforeTheyAreMade) {
  SegBytes seg = small_seg();
  seg.slice_spacing = 1;
  for (SegFrame& frame : seg.frames) frame.position[2] *= 50'000;
  const TempFolder folder;
  write_bytes(folder / "a.dcm", seg.bytes());
  MemoryBudget small("a.dcm", {0.001}), enough("a.dcm", {0.1});
  EXPECT_REFUSED(read_dicom_labels(folder / "a.dcm", small), HasSubstr("for labels"));
  EXPECT_REFUSED(read_dicom_probabilities(folder / "a.dcm", small), HasSubstr("memory"));
  EXPECT_NO_THROW(read_dicom_labels(folder / "a.dcm", enough));
}

}  // namespace
}  // namespace mesamis

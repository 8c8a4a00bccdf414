// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/seg_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/seg_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

SegFile open(const SegBytes& seg) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", seg.bytes());
  WideBudget budget;
  return open_seg(folder / "a.dcm", budget);
}

TEST(SegFile, ReadsFramesOfBitsThatCrossBytes) {
  const SegBytes bytes = small_seg();
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kDeflated}) {
    for (const bool in_open_sequences : {false, true}) {
      SegBytes coded = bytes;
      coded.coding = coding;
      coded.in_open_sequences = in_open_sequences;
      const SegFile seg = open(coded);
      WideBudget budget;
      ASSERT_EQ(seg.number.size(), 3u);
      std::vector<float> pixels;
      for (std::size_t frame = 0; frame < 3; ++frame) {
        read_frame(seg, frame, pixels, budget);
        EXPECT_THAT(pixels, ElementsAreArray(bytes.frames[frame].pixels));
      }
    }
  }
}

TEST(SegFile, TakesNamesAndColoursInTheOrderOfTheNumbers) {
  SegBytes seg = small_seg();
  seg.segments = {{7, "hip ", {65535, 32896, 32896}}, {1, "", {}}};
  const SegFile file = open(seg);
  ASSERT_EQ(file.segments.size(), 2u);
  EXPECT_EQ(file.segments[0], (Segment{"label 1", 1, 0, default_colour(1)}));
  EXPECT_EQ(file.segments[1], (Segment{"hip", 7, 0, {255, 255, 255}}));
}

TEST(SegFile, NamesAreInUtf8) {
  SegBytes seg = small_seg();
  seg.segments[0].label =
      "H\xfc"
      "fte";
  seg.character_set = "ISO_IR 100";
  EXPECT_EQ(open(seg).segments[0].name, "H\u00fcfte");
  seg.segments[0].label = "H\u00fcfte";
  seg.character_set = "ISO_IR 192";
  EXPECT_EQ(open(seg).segments[0].name, "H\u00fcfte");
}

TEST(SegFile, TakesTheSegmentFromSharedGroupsToo) {
  SegBytes seg = small_seg();
  seg.number_in_shared = true;
  EXPECT_THAT(open(seg).number, ElementsAre(1, 1, 1));
}

template <class Spoil>
void refused(Spoil spoil, const char* why) {
  SegBytes seg = small_seg();
  spoil(seg);
  EXPECT_REFUSED(open(seg), HasSubstr(why));
}

TEST(SegFile, RefusesWhatIsNoSegmentation) {
  refused([](SegBytes& s) { s.sop_class = "1.2.840.10008.5.1.4.1.1.2"; },
          "found \"1.2.840.10008.5.1.4.1.1.2\"");
  refused([](SegBytes& s) { s.type = "OTHER"; }, "found \"OTHER\"");
  refused([](SegBytes& s) { s.type = "FRACTIONAL"; }, "unsigned pixels of 8 bits, found 1");
  refused([](SegBytes& s) { s.bits = 8; }, "unsigned pixels of 1 bit, found 8");
  refused([](SegBytes& s) { s.transfer_syntax = "1.2.840.10008.1.2.5"; },
          "single bits coded natively");
  refused([](SegBytes& s) { s.type = "FRACTIONAL", s.bits = 8, s.most_fraction = 0; },
          "Maximum Fractional Value");
}

TEST(SegFile, RefusesSegmentsThatAreNotDescribed) {
  refused([](SegBytes& s) { s.frames[1].segment = 2; }, "frame 2 to refer to a segment");
  refused([](SegBytes& s) { s.frames[1].segment = -1; }, "(0062,000b) of frame 2, found none");
  refused([](SegBytes& s) { s.segments.clear(); }, "(0062,0002), found none");
  refused([](SegBytes& s) { s.segments[0].number = -1; }, "Segment Number (0062,0004)");
  refused([](SegBytes& s) { s.segments[0].number = 0; }, "from 1 once, found 0");
  refused([](SegBytes& s) { s.segments.push_back(s.segments[0]); }, "found 1 again");
}

TEST(SegFile, RefusesFramesThatAreMissingOrCutOff) {
  refused([](SegBytes& s) { s.frames_stated = 4; }, "found 6");  // bytes of pixels
  refused([](SegBytes& s) { s.frames_stated = 2; }, "of 2 frames, found 3");
  refused([](SegBytes& s) { s.frames_stated = 2'000'000'000; }, "frames");
  refused([](SegBytes& s) { s.pixel_data = "abcd"; }, "expected 6 bytes of pixels");
  refused([](SegBytes& s) { s.frames[2].position = s.frames[0].position; },
          "frame 3 of segment 1 at that of another");
}

}  // namespace
}  // namespace mesamis

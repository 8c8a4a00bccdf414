// SPDX-License-Identifier: Apache-2.0
// Label maps that other programs have written, where they are installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/label_files/label_table.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/temp_folder.h"
#include "support/test_data.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// Mean sample of the scan where a segment is; 0 if there is none.
double mean_in(const Volume& scan, const LabelMap& map, const Segment& segment) {
  const auto mask = mask_on(map, std::span(&segment, 1), scan);
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask[n]) sum += static_cast<double>(scan.samples[n]), ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Of the range of a segment, LPS, mm.
double centre_x(const LabelMap& map, const Segment& segment) {
  const CropRange range = range_of(map, segment).value();
  Vec3 middle;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    middle[a] = 0.5 * (range.begin[axis] + range.end[axis] - 1) * map.spacing[a];
  }
  return map.to_world(middle).x;
}

TEST(RealLabels, NamesOfTotalSegmentatorFitTheScan) {
  const auto labels = test_data("data/pelvis_ts/labels_total.nii.gz");
  const auto scan = test_data("data/pelvis_ts/ct.nii.gz");
  MESAMIS_REQUIRE_DATA(labels);
  MESAMIS_REQUIRE_DATA(scan);
  const LabelFile file = read_label_map(labels);
  const Volume ct = read_volume(scan).volume;
  EXPECT_EQ(find_segment(file.map.segments, "spleen").label, 1);
  // Bone is bright in CT; a bladder is water.
  EXPECT_GT(mean_in(ct, file.map, find_segment(file.map.segments, "sacrum")), 100);
  EXPECT_GT(mean_in(ct, file.map, find_segment(file.map.segments, "hip_left")), 150);
  EXPECT_NEAR(mean_in(ct, file.map, find_segment(file.map.segments, "urinary_bladder")), 10, 40);
  EXPECT_REFUSED(find_segment(file.map.segments, "hip"), HasSubstr("\"hip_left\" ("));
}

TEST(RealLabels, OfADicomSeriesInAFileOfAnotherOrientation) {
  const auto labels = test_data("data/dicom_ct_j2k_labels.nii.gz");
  const auto scan = test_data("data/dicom_ct_j2k");
  MESAMIS_REQUIRE_DATA(labels);
  MESAMIS_REQUIRE_DATA(scan);
  const LabelMap map = read_label_map(labels).map;
  const Volume ct = read_volume(scan).volume;
  for (const char* bone : {"vertebrae_T12", "humerus_left"}) {
    EXPECT_GT(mean_in(ct, map, find_segment(map.segments, bone)), 100) << bone;
  }
  EXPECT_NEAR(mean_in(ct, map, find_segment(map.segments, "liver")), 90, 60);
  // x grows to the patient's left.
  EXPECT_GT(centre_x(map, find_segment(map.segments, "humerus_left")),
            centre_x(map, find_segment(map.segments, "humerus_right")) + 200);
}

TEST(RealLabels, TablesOfSlicerNameTheAtlases) {
  const auto labels = test_data("data/knee_spl/labels.nrrd");
  const auto table = test_data("data/knee_spl/knee.ctbl");
  MESAMIS_REQUIRE_DATA(labels);
  MESAMIS_REQUIRE_DATA(table);
  const LabelMap map = with_names(read_label_map(labels).map, read_label_table(table));
  const Segment femur = find_segment(map.segments, "95");
  EXPECT_THAT(femur.name, HasSubstr("femur"));
  const auto range = range_of(map, femur);
  ASSERT_TRUE(range);
  const Segment patella = find_segment(map.segments, "98");
  EXPECT_THAT(patella.name, HasSubstr("patella"));
  const auto volume = [&map](const Segment& s) {
    return std::count(map.layers[0].begin(), map.layers[0].end(), s.label);
  };
  EXPECT_GT(volume(femur), 3 * volume(patella));
}

TEST(RealLabels, RoundTripThroughEveryFormat) {
  for (const char* name : {"data/mouse_skull/labels.nii.gz", "data/pelvis_spl/labels.nrrd"}) {
    const auto path = test_data(name);
    MESAMIS_REQUIRE_DATA(path);
    const LabelMap map = read_label_map(path).map;
    EXPECT_NO_THROW(require_valid(map));
    const TempFolder folder;
    for (const char* copy : {"a.nii.gz", "a.seg.nrrd"}) {
      write_label_map(folder / copy, map);
      const LabelMap back = read_label_map(folder / copy).map;
      EXPECT_TRUE(back.layers == map.layers) << name << " as " << copy;
      EXPECT_EQ(back.segments, map.segments);
      EXPECT_TRUE(labels_on(back, map).layers == map.layers) << name << " as " << copy;
    }
  }
}

/// The file says one frame and describes three.
TEST(RealLabels, ASegmentationThatContradictsItselfIsRefused) {
  const auto path = test_data("data/bad/pydicom/liver_1frame.dcm");
  MESAMIS_REQUIRE_DATA(path);
  EXPECT_REFUSED(read_label_map(path), HasSubstr("of 1 frames, found 3"));
}

TEST(RealLabels, ASegmentationWhoseFramesDoNotEndAtBytes) {
  const auto path = test_data("data/bad/pydicom_data/liver_nonbyte_aligned.dcm");
  MESAMIS_REQUIRE_DATA(path);
  const LabelMap map = read_label_map(path).map;
  EXPECT_NO_THROW(require_valid(map));
  ASSERT_FALSE(map.segments.empty());
  const auto range = range_of(map, map.segments[0]);
  ASSERT_TRUE(range);
  // Each slice continues the one below: bits out of step would leave stripes.
  const auto& labels = map.layers[0];
  std::size_t inside = 0, borders = 0;
  for (Index k = 0; k < map.size[2]; ++k) {
    for (Index j = 0; j < map.size[1]; ++j) {
      for (Index i = 1; i < map.size[0]; ++i) {
        const bool in = labels[map.offset(i, j, k)] > 0;
        inside += in;
        borders += in != (labels[map.offset(i - 1, j, k)] > 0);
      }
    }
  }
  EXPECT_GT(inside, 10 * borders);
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_spacing.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const Vec3 kRow{1, 0, 0}, kColumn{0, 1, 0};

/// Slices at these heights along z, 1 x 1 mm pixels, files s0, s1, ...
std::vector<DicomSlice> slices_at(const std::vector<double>& heights) {
  std::vector<DicomSlice> slices(heights.size());
  for (std::size_t n = 0; n < slices.size(); ++n) {
    slices[n].file = "s" + std::to_string(n);
    slices[n].along_row = kRow;
    slices[n].along_column = kColumn;
    slices[n].position = {5, 6, heights[n]};
  }
  return slices;
}

void check_spacing(const std::vector<double>& heights) {
  require_even_spacing("scan", sort_along_normal(slices_at(heights)));
}

TEST(DicomSpacing, SortsAlongTheNormal) {
  const SortedSlices sorted = sort_along_normal(slices_at({4, 0, 2}));
  EXPECT_THAT(sorted.height, ElementsAre(0, 2, 4));
  EXPECT_EQ(sorted.slices[0].file, "s1");
  EXPECT_EQ(sorted.slices[2].file, "s0");
  expect_near(sorted.normal, {0, 0, 1});
  EXPECT_DOUBLE_EQ(mean_spacing(sorted), 2);
}

TEST(DicomSpacing, GapsAreThoseOfNeighboursInTheirOrder) {
  EXPECT_THAT(gaps_of(sort_along_normal(slices_at({7, 0, 4, 2}))), ElementsAre(2, 2, 3));
}

/// Turning the whole stack changes neither order nor heights.
TEST(DicomSpacing, DoesNotDependOnTheOrientation) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turned = [c, s](const Vec3& v) {
    return Vec3{c * v.x - s * v.z, v.y, s * v.x + c * v.z};
  };
  std::vector<DicomSlice> slices = slices_at({0, 1.5, 3, 4.5});
  for (DicomSlice& slice : slices) {
    slice.along_row = turned(slice.along_row);
    slice.along_column = turned(slice.along_column);
    slice.position = turned(slice.position);
  }
  const SortedSlices sorted = sort_along_normal(slices);
  EXPECT_NEAR(mean_spacing(sorted), 1.5, 1e-12);
  expect_near(sorted.normal, turned({0, 0, 1}), 1e-12);
  EXPECT_NO_THROW(require_even_spacing("scan", sorted));
  EXPECT_NO_THROW(require_no_tilt("scan", sorted));
}

TEST(DicomSpacing, DeviationsUpToTwoPercentAreEven) {
  EXPECT_NO_THROW(check_spacing({0, 2, 4, 6, 8.039, 10}));
  EXPECT_REFUSED(check_spacing({0, 2, 4, 6, 8.041, 10.041}),
                 AllOf(HasSubstr("scan: the slices are unevenly spaced between s3 and s4"),
                       HasSubstr("expected 2 mm, found 2.041 mm")));
  EXPECT_NO_THROW(check_spacing({0, 7}));
}

TEST(DicomSpacing, MissingSlicesAreCalledSo) {
  EXPECT_REFUSED(check_spacing({0, 2, 4, 8, 10}),
                 AllOf(HasSubstr("slices are missing between s2 and s3"),
                       HasSubstr("expected 2 mm, found 4 mm")));
  EXPECT_REFUSED(check_spacing({0, 2, 4, 7, 9}), HasSubstr("unevenly spaced"));
}

TEST(DicomSpacing, TwoSlicesAtOnePlaceAreRefused) {
  const auto names_both =
      AllOf(HasSubstr("scan: expected one slice per position"), HasSubstr("s2 and s3"));
  EXPECT_REFUSED(check_spacing({0, 2, 4, 4.00005, 6}), names_both);
  const SortedSlices sorted = sort_along_normal(slices_at({0, 2, 4, 4.00005, 6}));
  EXPECT_REFUSED(require_apart("scan", sorted, 3), names_both);
  for (const std::size_t n : {1, 2, 4}) EXPECT_NO_THROW(require_apart("scan", sorted, n));
}

TEST(DicomSpacing, TiltIsRefusedWithItsAngle) {
  std::vector<DicomSlice> slices = slices_at({0, 2, 4, 6});
  for (std::size_t n = 0; n < 4; ++n) slices[n].position.y += 2.0 * static_cast<double>(n);
  EXPECT_REFUSED(
      require_no_tilt("scan", sort_along_normal(slices)),
      HasSubstr("scan: expected slices straight above one another, found a tilt of 45 "));
}

/// Between neighbours 2 % of the spacing are allowed, in sum a quarter of the smallest edge.
TEST(DicomSpacing, ASmallDriftIsAllowedUntilItAddsUp) {
  for (const int count : {7, 9}) {
    std::vector<double> heights;
    for (int n = 0; n < count; ++n) heights.push_back(2.0 * n);
    std::vector<DicomSlice> slices = slices_at(heights);
    for (int n = 0; n < count; ++n) slices[static_cast<std::size_t>(n)].position.x += 0.035 * n;
    const SortedSlices sorted = sort_along_normal(slices);
    if (count == 7) {  // 0.21 mm
      EXPECT_NO_THROW(require_no_tilt("scan", sorted));
    } else {  // 0.28 mm
      EXPECT_REFUSED(require_no_tilt("scan", sorted), HasSubstr("tilt"));
    }
  }
}

}  // namespace
}  // namespace mesamis

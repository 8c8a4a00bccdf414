// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_confidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"
#include "support/label_grids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// The label 1 where x is at least so much, else 0.
OwnedLabels half_space(Index n, double from) {
  return labels_where({n, 5, 5}, {1, 1, 1}, [from](const Vec3& p) { return p.x >= from ? 1 : 0; });
}

float weight_at(const OwnedLabels& labels, const std::vector<float>& weight, Index i) {
  return weight[static_cast<std::size_t>(i + labels.size[0] * (2 + labels.size[1] * 2))];
}

TEST(LabelConfidence, GrowsFromTheBorderAndIsCertainAMarginAway) {
  const OwnedLabels labels = half_space(20, 10);
  const auto weight = label_confidence(labels.grid(), 4);
  for (Index i = 10; i < 14; ++i) {  // half a voxel and more inside
    const double r = (i - 10 + 0.5) / 4, odds = r / (1 - r);
    EXPECT_NEAR(weight_at(labels, weight, i), 0.005 + 0.03 * odds * odds, 1e-6) << i;
    EXPECT_NEAR(weight_at(labels, weight, 19 - i), weight_at(labels, weight, i), 1e-6) << i;
  }
  EXPECT_EQ(weight_at(labels, weight, 14), kCertain);
  EXPECT_EQ(weight_at(labels, weight, 19), kCertain) << "the border of the grid is none";
  EXPECT_EQ(weight_at(labels, weight, 0), kCertain);
}

TEST(LabelConfidence, IsCertainWhereALabelIsThin) {
  OwnedLabels labels = labels_where({9, 9, 9}, {1, 1, 1}, [](const Vec3&) { return 0; });
  labels.at(4, 4, 4) = 7;
  const auto weight = label_confidence(labels.grid(), 3);
  const auto at = [&](Index i, Index j, Index k) {
    return weight[static_cast<std::size_t>(i + 9 * (j + 9 * k))];
  };
  EXPECT_EQ(at(4, 4, 4), kCertain) << "a voxel alone";
  // Beside it the margin is a voxel and a half: r is a third there, not a sixth.
  EXPECT_NEAR(at(5, 4, 4), 0.005 + 0.03 * 0.25, 1e-6);
}

TEST(LabelConfidence, IsCertainOfTheMiddleOfAWallBesideSomethingThick) {
  const OwnedLabels labels = labels_where({30, 15, 15}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 12 || std::abs(p.z - 7) < 1.5 ? 1 : 0;  // three voxels thick
  });
  const auto weight = label_confidence(labels.grid(), 4);
  const auto at = [&](Index i, Index k) {
    return weight[static_cast<std::size_t>(i + 30 * (7 + 15 * k))];
  };
  for (Index i = 16; i < 28; ++i) {
    EXPECT_EQ(at(i, 7), kCertain) << i;
    EXPECT_LT(at(i, 6), 1) << i;
  }
}

TEST(LabelConfidence, DoesNotTrustABumpOfAFewLabels) {
  OwnedLabels labels = half_space(20, 10);
  labels.at(9, 2, 2) = 1;
  EXPECT_LT(weight_at(labels, label_confidence(labels.grid(), 4), 9), 1);
}

TEST(LabelConfidence, DoesNotTrustAClefOfBackground) {
  // One voxel of background between two objects may be an error of their labels.
  OwnedLabels labels = labels_where({21, 5, 5}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 10 ? 1 : p.x > 10 ? 2 : 0;
  });
  const auto weight = label_confidence(labels.grid(), 3);
  EXPECT_LT(weight_at(labels, weight, 10), 0.01);
}

TEST(LabelConfidence, IsCertainAtBordersThatTheImageDoesNotShow) {
  const OwnedLabels labels = labels_where({24, 5, 5}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 8 ? 3 : p.x < 16 ? 1 : 0;
  });
  const auto seen = label_confidence(labels.grid(), 3);
  for (const LabelPair& pair : {LabelPair{1, 3}, LabelPair{3, 1}}) {
    const auto weight = label_confidence(labels.grid(), 3, {{pair}});
    for (Index i = 0; i < 12; ++i) EXPECT_EQ(weight_at(labels, weight, i), kCertain) << i;
    for (Index i = 12; i < 24; ++i) {
      EXPECT_EQ(weight_at(labels, weight, i), weight_at(labels, seen, i)) << i;
    }
    EXPECT_LT(weight_at(labels, weight, 15), 0.01);
  }
}

TEST(LabelConfidence, MeasuresInMillimetres) {
  const OwnedLabels fine =
      labels_where({20, 3, 3}, {0.5, 0.5, 0.5}, [](const Vec3& p) { return p.x >= 5 ? 1 : 0; });
  const auto weight = label_confidence(fine.grid(), 2);
  const auto at = [&](Index i) { return weight[static_cast<std::size_t>(i + 20 * (1 + 3))]; };
  EXPECT_LT(at(13), kCertain);
  EXPECT_EQ(at(14), kCertain) << "2.25 mm inside";
}

TEST(LabelConfidence, IsTheSameForAnyNumberOfThreads) {
  const OwnedLabels labels = random_blobs(30, 12, 5);
  const auto one = with_threads(1, [&] { return label_confidence(labels.grid(), 3); });
  EXPECT_EQ(with_threads(2, [&] { return label_confidence(labels.grid(), 3); }), one);
}

TEST(LabelConfidence, RefusesWhatDoesNotFit) {
  OwnedLabels labels = half_space(6, 3);
  EXPECT_REFUSED(label_confidence(labels.grid(), 0), ::testing::HasSubstr("margin"));
  EXPECT_REFUSED(label_confidence(labels.grid(), std::numeric_limits<double>::infinity()),
                 ::testing::HasSubstr("margin"));
  labels.labels.pop_back();
  EXPECT_REFUSED(label_confidence(labels.grid(), 1), ::testing::HasSubstr("expected 150"));
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/join_diagonals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/label_grids.h"

namespace mesamis {
namespace {

/// Of the Kuhn tetrahedra's nodes, edges, triangles and cells whose nodes have the label.
class EulerCharacteristic {
 public:
  EulerCharacteristic(const OwnedLabels& labels, std::uint16_t label)
      : labels_(labels), label_(label) {
    for (Index k = 0; k < labels.size[2]; ++k) {
      for (Index j = 0; j < labels.size[1]; ++j) {
        for (Index i = 0; i < labels.size[0]; ++i) add({i, j, k}, 0, 1);
      }
    }
  }
  int value() const { return sum_; }

 private:
  void add(const std::array<Index, 3>& low, unsigned corner, int sign) {
    std::array<Index, 3> at = low;
    for (std::size_t a = 0; a < 3; ++a) {
      at[a] += static_cast<Index>(corner >> a & 1U);
      if (at[a] >= labels_.size[a]) return;
    }
    const auto n = at[0] + labels_.size[0] * (at[1] + labels_.size[1] * at[2]);
    if (labels_.labels[static_cast<std::size_t>(n)] != label_) return;
    sum_ += sign;
    for (unsigned next = corner + 1; next < 8; ++next) {
      if ((next & corner) == corner) add(low, next, -sign);
    }
  }

  const OwnedLabels& labels_;
  std::uint16_t label_;
  int sum_ = 0;
};

int parts_of(const OwnedLabels& labels, std::uint16_t label) {
  const LabelParts parts = find_label_parts(labels.grid());
  return static_cast<int>(std::count(parts.label.begin(), parts.label.end(), label));
}

/// Of an object that does not reach the faces of the grid.
int tunnels_of(const OwnedLabels& labels, std::uint16_t label) {
  OwnedLabels rest = labels;
  for (std::uint16_t& l : rest.labels) l = l == label ? 1 : 0;
  const int cavities = parts_of(rest, 0) - 1;
  return parts_of(labels, label) + cavities - EulerCharacteristic(labels, label).value();
}

OwnedLabels joined(const OwnedLabels& labels) {
  OwnedLabels after = labels;
  after.labels = join_diagonals(labels.grid());
  return after;
}

/// A disc one node thick: where a plane passes the nodes.
OwnedLabels disc(const Vec3& along) {
  const double steepest = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
  return labels_where({30, 30, 30}, {1, 1, 1}, [&](const Vec3& p) {
    const Vec3 from = p - Vec3{14.3, 14.6, 14.1};
    const double height = dot(from, along) / steepest;
    return height >= -0.5 && height < 0.5 && norm(from) < 11 ? 1 : 0;
  });
}

TEST(JoinDiagonals, LeavesNoTunnelInAnObliqueSheet) {
  int before = 0;
  for (const double x : {-1., 0.3, 0.8}) {
    for (const double y : {-0.7, 0.1, 1.}) {
      for (const double z : {-0.9, 0.45, 1.}) {
        const OwnedLabels labels = disc({x, y, z}), after = joined(labels);
        before += tunnels_of(labels, 1) + parts_of(labels, 1) - 1;
        EXPECT_EQ(tunnels_of(after, 1), 0) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(parts_of(after, 1), 1) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_GT(before, 100);
}

TEST(JoinDiagonals, JoinsThePiecesOfAnObliqueBar) {
  OwnedLabels labels{.size = {20, 20, 20}, .labels = std::vector<std::uint16_t>(8000, 0)};
  for (Index n = 2; n < 18; ++n) labels.at(n, 19 - n, n) = 1;
  EXPECT_EQ(parts_of(labels, 1), 16);
  const OwnedLabels after = joined(labels);
  EXPECT_EQ(parts_of(after, 1), 1);
  EXPECT_EQ(tunnels_of(after, 1), 0);
}

TEST(JoinDiagonals, LeavesThickObjectsThatTouchAtAnEdgeApart) {
  for (const double corner : {-1., 1.}) {
    const OwnedLabels labels = labels_where({20, 20, 20}, {1, 1, 1}, [&](const Vec3& p) {
      const Vec3 from = p - Vec3{9.5, 9.5, 9.5};
      const bool within = std::abs(from.x) < 6 && std::abs(from.y) < 6 && std::abs(from.z) < 6;
      return within && corner * from.x * from.y > 0 ? 1 : 0;
    });
    EXPECT_EQ(joined(labels).labels, labels.labels);
  }
}

TEST(JoinDiagonals, TakesFromTheBackgroundAlone) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    OwnedLabels labels = random_blobs(24, 5, seed);
    std::mt19937 generator(seed);
    for (std::uint16_t& label : labels.labels) {
      if (generator() % 4 == 0) label = static_cast<std::uint16_t>(generator() % 6);
    }
    const OwnedLabels after = joined(labels);
    EXPECT_NE(after.labels, labels.labels);
    for (std::size_t n = 0; n < labels.labels.size(); ++n) {
      if (labels.labels[n] != 0) {
        ASSERT_EQ(after.labels[n], labels.labels[n]);
      }
    }
  }
}

/// Random nodes in a shell: some touch at edges and corners.
OwnedLabels crumbs(unsigned seed) {
  std::mt19937 generator(seed);
  return labels_where({26, 26, 26}, {1, 1, 1}, [&](const Vec3& p) {
    const double radius = norm(p - Vec3{12.5, 12.5, 12.5});
    return radius < 11 && (radius < 4 || generator() % 8 == 0) ? 1 : 0;
  });
}

TEST(JoinDiagonals, MakesNoHandleAndNoPart) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const OwnedLabels labels = crumbs(seed), after = joined(labels);
    EXPECT_LT(parts_of(after, 1), parts_of(labels, 1)) << seed;
    EXPECT_LE(tunnels_of(after, 1), tunnels_of(labels, 1)) << seed;
  }
}

TEST(JoinDiagonals, TellsWhatANodeChanges) {
  for (unsigned seed = 1; seed < 4; ++seed) {
    OwnedLabels labels = crumbs(seed);
    const auto joins = find_diagonal_joins(labels.grid(), find_label_parts(labels.grid()).of_node);
    ASSERT_FALSE(joins.empty());
    int sum = EulerCharacteristic(labels, 1).value();
    for (const DiagonalJoin& join : joins) {
      labels.labels[static_cast<std::size_t>(join.node)] = 1;
      sum += join.change;
    }
    EXPECT_EQ(sum, EulerCharacteristic(labels, 1).value());
  }
}

}  // namespace
}  // namespace mesamis

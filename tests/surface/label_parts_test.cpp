// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/label_parts.h"

#include <gtest/gtest.h>

#include <random>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/grid_field.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

TEST(LabelParts, AreThoseOfABoxMeshsEdges) {
  std::mt19937 generator(3);
  OwnedLabels labels{.size = {6, 5, 4}};
  for (int n = 0; n < 6 * 5 * 4; ++n) {
    labels.labels.push_back(static_cast<std::uint16_t>(generator() % 3));
  }
  const LabelParts parts = find_label_parts(labels.grid());
  // The smallest number that reaches a node along the edges of one label.
  std::vector<Index> flood(labels.labels.size());
  for (std::size_t n = 0; n < flood.size(); ++n) flood[n] = static_cast<Index>(n);
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {5, 4, 3});
  for (bool changed = true; changed;) {
    changed = false;
    for (const Cell& cell : mesh.cells) {
      for (const Index a : cell) {
        for (const Index b : cell) {
          if (labels.labels[a] != labels.labels[b] || flood[a] <= flood[b]) continue;
          flood[a] = flood[b];
          changed = true;
        }
      }
    }
  }
  for (std::size_t a = 0; a < flood.size(); ++a) {
    EXPECT_EQ(parts.label[parts.of_node[a]], labels.labels[a]);
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_EQ(parts.of_node[a] == parts.of_node[b], flood[a] == flood[b]) << a << " " << b;
    }
  }
}

TEST(LabelParts, AreNumberedInTheOrderOfTheirFirstNodes) {
  OwnedLabels labels{.size = {5, 2, 2}, .labels = std::vector<std::uint16_t>(20, 7)};
  for (Index j = 0; j < 2; ++j) {
    for (Index k = 0; k < 2; ++k) labels.at(2, j, k) = 1;
  }
  const LabelParts parts = find_label_parts(labels.grid());
  EXPECT_EQ(parts.label, (std::vector<Index>{7, 1, 7}));
  EXPECT_EQ((std::vector<Index>{parts.of_node.begin(), parts.of_node.begin() + 5}),
            (std::vector<Index>{0, 0, 1, 2, 2}));
}

}  // namespace
}  // namespace mesamis

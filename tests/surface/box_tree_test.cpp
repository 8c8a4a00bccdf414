// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/box_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace mesamis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Boxes in a cube of 1, with sides from 1e-3 to 1 each: length ratios up to 1000:1.
std::vector<Box> random_boxes(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(0, 1), exponent(-3, 0);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 lo{place(generator), place(generator), place(generator)};
    const Vec3 side{std::pow(10, exponent(generator)), std::pow(10, exponent(generator)),
                    std::pow(10, exponent(generator))};
    boxes.push_back({lo, lo + side});
  }
  return boxes;
}

std::vector<std::size_t> found_by(const BoxTree& tree, const Box& box) {
  std::vector<std::size_t> found;
  tree.for_each_overlap(box, [&found](std::size_t i) {
    found.push_back(i);
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::size_t> found_by_brute_force(const std::vector<Box>& boxes, const Box& box) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis) {
      apart |= boxes[i].hi[axis] < box.lo[axis] || box.hi[axis] < boxes[i].lo[axis];
    }
    if (!apart) found.push_back(i);
  }
  return found;
}

TEST(BoxTree, AgreesWithBruteForceWhileBoxesChange) {
  std::vector<Box> boxes = random_boxes(700, 1);
  const std::vector<Box> queries = random_boxes(400, 2), others = random_boxes(400, 3);
  BoxTree tree(boxes);
  std::mt19937 generator(4);
  std::size_t overlaps = 0;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto expected = found_by_brute_force(boxes, queries[q]);
    ASSERT_EQ(found_by(tree, queries[q]), expected) << q;
    overlaps += expected.size();
    const std::size_t changed = generator() % boxes.size();
    boxes[changed] = q % 5 == 0 ? kNoBox : others[q];
    tree.update(changed, boxes[changed]);
  }
  EXPECT_GT(overlaps, 1000u);
}

TEST(BoxTree, CountsTouchingAsOverlap) {
  const BoxTree tree(std::vector<Box>{{{0, 0, 0}, {1, 1, 1}}, {{5, 5, 5}, {5, 5, 5}}});
  EXPECT_THAT(found_by(tree, {{1, 1, 1}, {2, 2, 2}}), ElementsAre(0));
  EXPECT_THAT(found_by(tree, {{5, 5, 5}, {5, 5, 5}}), ElementsAre(1));
  EXPECT_THAT(found_by(tree, {{std::nextafter(1, 2), 0, 0}, {2, 2, 2}}), IsEmpty());
}

TEST(BoxTree, CopesWithEqualBoxesAndNone) {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  const BoxTree equal(std::vector<Box>(1000, unit));
  EXPECT_EQ(found_by(equal, unit).size(), 1000u);
  EXPECT_THAT(found_by(equal, {{2, 2, 2}, {3, 3, 3}}), IsEmpty());
  EXPECT_THAT(found_by(equal, kNoBox), IsEmpty());
  EXPECT_THAT(found_by(BoxTree(std::vector<Box>{}), unit), IsEmpty());
}

using ItemPairs = std::vector<std::array<std::size_t, 2>>;

/// Each pair as often as any share visits it.
ItemPairs pairs_of_shares(const BoxTree& tree, std::size_t count) {
  ItemPairs pairs;
  for (const auto& share : tree.shares_of_pairs(count)) {
    tree.for_each_pair(share, [&pairs](std::size_t i, std::size_t j) {
      pairs.push_back({std::min(i, j), std::max(i, j)});
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(BoxTree, SharesHoldEachPairThatOverlapsOnce) {
  for (const std::size_t items : {0, 1, 2, 3, 7, 300}) {
    std::vector<Box> boxes = random_boxes(items, 6);
    BoxTree tree(boxes);
    for (int round = 0; round < 2; ++round) {
      ItemPairs expected;
      for (std::size_t i = 0; i < items; ++i) {
        for (std::size_t j = i + 1; j < items; ++j) {
          if (overlap(boxes[i], boxes[j])) expected.push_back({i, j});
        }
      }
      EXPECT_GE(expected.size(), items == 300 ? 500u : 0u);
      for (const std::size_t count : {1, 2, 50, 100000}) {
        EXPECT_EQ(pairs_of_shares(tree, count), expected) << items << " " << count;
      }
      boxes = random_boxes(items, 7);
      for (Box& box : boxes) box = {box.lo + Vec3{3, 0, 0}, box.hi + Vec3{3, 0, 0}};
      tree.update(boxes);
      EXPECT_EQ(found_by(tree, {{3, 0, 0}, {5, 2, 2}}).size(), items) << "all are elsewhere";
    }
  }
}

TEST(BoxTree, HasAboutAsManySharesAsAreAskedFor) {
  const BoxTree tree(random_boxes(300, 6));
  EXPECT_EQ(tree.shares_of_pairs(1).size(), 1u);
  EXPECT_GE(tree.shares_of_pairs(100).size(), 100u);
  EXPECT_LT(tree.shares_of_pairs(100).size(), 400u);
}

TEST(BoxTree, StopsWhenTheVisitorSaysSo) {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  const BoxTree tree(std::vector<Box>(100, unit));
  int visits = 0;
  tree.for_each_overlap(unit, [&visits](std::size_t) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

TEST(BoxTree, VisitsInTheSameOrderEveryTime) {
  const std::vector<Box> boxes = random_boxes(300, 5);
  std::vector<std::size_t> orders[2];
  for (auto& order : orders) {
    BoxTree(boxes).for_each_overlap({{0, 0, 0}, {1, 1, 1}}, [&order](std::size_t i) {
      order.push_back(i);
      return true;
    });
  }
  EXPECT_EQ(orders[0], orders[1]);
}

}  // namespace
}  // namespace mesamis

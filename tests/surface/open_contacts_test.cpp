// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/open_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/self_intersections.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"
#include "support/random_memberships.h"

namespace mesamis {
namespace {

const std::vector<char> kAll(8, 1);

std::int64_t contact_triangles(const PartitionSurface& partition) {
  return std::ranges::count_if(partition.sides,
                               [](const auto& s) { return s[0] > 0 && s[1] != kNoIndex; });
}

bool is_same(const PartitionSurface& one, const PartitionSurface& other) {
  return one.points == other.points && one.triangles == other.triangles && one.sides == other.sides;
}

/// A slab of label 1 below one of label 2, which touch where told; a gap of two voxels elsewhere.
template <class Touches>
PartitionSurface slabs_that_touch(Touches touches) {
  const OwnedLabels labels = labels_where({20, 20, 16}, {1, 1, 1}, [&](const Vec3& p) {
    if (std::min(p.x, p.y) < 3 || std::max(p.x, p.y) > 16 || p.z < 3 || p.z > 12) return 0;
    if (p.z > 7) return 2;
    return p.z < 6 || touches(p) ? 1 : 0;
  });
  return extract_net_on_grid(smooth_memberships(labels.grid()));
}

TEST(OpenContacts, OpenTheContactOfAFewVoxels) {
  for (const int width : {1, 2, 3}) {
    const PartitionSurface touching = slabs_that_touch(
        [&](const Vec3& p) { return p.x >= 9 && p.x < 9 + width && p.y >= 9 && p.y < 9 + width; });
    ASSERT_GE(contact_triangles(touching), 2 * width * width);
    const PartitionSurface open = open_narrow_contacts(touching, kAll, {.depth = 2, .gap = 0.1});
    EXPECT_EQ(contact_triangles(open), 0) << width;
    expect_partition_laws(open, 19 * 19 * 15, std::to_string(width));
    for (const Index object : {1, 2}) {
      const SurfaceCheck was = check_surface(object_surface(touching, object)),
                         is = check_surface(object_surface(open, object));
      EXPECT_LT(is.volume, was.volume);
      EXPECT_GT(is.volume, was.volume - 0.1 * 4 * (width + 1) * (width + 1));
    }
  }
}

/// All but the voxel faces at its corners.
TEST(OpenContacts, LeaveAWideContact) {
  const PartitionSurface touching =
      slabs_that_touch([](const Vec3& p) { return p.x > 5 && p.x < 13 && p.y > 5 && p.y < 13; });
  const PartitionSurface open = open_narrow_contacts(touching, kAll, {.depth = 2, .gap = 0.1});
  EXPECT_GE(contact_triangles(open), contact_triangles(touching) - 8);
}

/// A ribbon goes, the wide contact that it begins at stays; depth 1 leaves what has a point inside.
TEST(OpenContacts, OpenWhatIsNarrowOfAContact) {
  const auto touches = [](bool ribbon) {
    return slabs_that_touch([&](const Vec3& p) {
      const bool wide = p.x < 10 && p.y > 5 && p.y < 13;
      return wide || (ribbon && p.x >= 10 && p.y > 8 && p.y < 11);
    });
  };
  const PartitionSurface without = touches(false), with = touches(true);
  const PartitionSurface open = open_narrow_contacts(with, kAll, {.depth = 2, .gap = 0.1});
  expect_partition_laws(open, 19 * 19 * 15, "ribbon");
  EXPECT_GE(contact_triangles(open), contact_triangles(without) - 4);
  EXPECT_LE(contact_triangles(open), contact_triangles(without) + 12);
  EXPECT_GE(contact_triangles(with), contact_triangles(without) + 20);
  const PartitionSurface less = open_narrow_contacts(with, kAll, {.depth = 1, .gap = 0.1});
  EXPECT_GT(contact_triangles(less), contact_triangles(open));
}

/// Each contact of a rod that lies between four blocks is narrow, but the background is far.
TEST(OpenContacts, LeaveNarrowContactsFarFromTheBackground) {
  const OwnedLabels labels = labels_where({22, 22, 22}, {1, 1, 1}, [](const Vec3& p) {
    if (std::min({p.x, p.y, p.z}) < 3 || std::max({p.x, p.y, p.z}) > 18) return 0;
    if (p.x > 9 && p.x < 12 && p.y > 9 && p.y < 12) return 5;
    return 1 + (p.x < 10.5 ? 0 : 1) + (p.y < 10.5 ? 0 : 2);
  });
  const PartitionSurface net = extract_net_on_grid(smooth_memberships(labels.grid()));
  EXPECT_TRUE(is_same(net, open_narrow_contacts(net, kAll, {.depth = 2, .gap = 0.1})));
}

/// What is not chosen is background: a chosen object's boundary with it is no contact.
TEST(OpenContacts, AreBetweenChosenObjects) {
  const PartitionSurface touching =
      slabs_that_touch([](const Vec3& p) { return p.x == 9 && p.y == 9; });
  const std::vector<char> one{0, 1, 0};
  EXPECT_TRUE(is_same(touching, open_narrow_contacts(touching, one, {.depth = 2, .gap = 0.1})));
}

TEST(OpenContacts, HoldTheLawsOfPartitionsWhereLabelsAreRandom) {
  std::int64_t before = 0, after = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Index materials = 3 + static_cast<Index>(seed % 4);
    const PartitionSurface net = extract_net_on_grid(random_grid({7, 6, 8}, materials, seed));
    const int depth = 1 + static_cast<int>(seed % 3);
    const PartitionSurface open = open_narrow_contacts(net, kAll, {.depth = depth, .gap = 0.1});
    expect_partition_laws(open, 6 * (5 * 2) * (7 * 0.5), "seed " + std::to_string(seed));
    before += contact_triangles(net);
    after += contact_triangles(open);
    for (const Index m : materials_of(net)) {
      if (m == 0) continue;
      const TriMesh was = object_surface(net, m), is = object_surface(open, m);
      EXPECT_EQ(is.triangles.size(), was.triangles.size());
      EXPECT_EQ(check_surface(is).components, check_surface(was).components);
    }
  }
  EXPECT_LT(after, before - before / 20);
}

/// The boundary of the background together with what lies outside.
SurfaceCheck check_background(const PartitionSurface& partition) {
  TriMesh boundary{partition.points, {}};
  const auto is_background = [](Index side) { return side == 0 || side == kNoIndex; };
  for (std::size_t t = 0; t < partition.sides.size(); ++t) {
    const bool behind = is_background(partition.sides[t][0]),
               before = is_background(partition.sides[t][1]);
    const auto& [i, j, k] = partition.triangles[t];
    if (behind != before)
      boundary.triangles.push_back(behind ? Triangle{i, j, k} : Triangle{i, k, j});
  }
  return check_surface(boundary);
}

/// Labels that reach the border are closed by it, and the background goes on outside.
TEST(OpenContacts, PinchNoBackgroundAtTheBorder) {
  int changed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PartitionSurface net = extract_net_on_grid(random_grid({7, 6, 8}, 4, seed));
    const PartitionSurface open = open_narrow_contacts(net, kAll, {.depth = 2, .gap = 0.1});
    const SurfaceCheck was = check_background(net), is = check_background(open);
    EXPECT_EQ(is.nonmanifold_edges, was.nonmanifold_edges) << seed;
    EXPECT_EQ(is.nonmanifold_points, was.nonmanifold_points) << seed;
    EXPECT_EQ(is.open_edges, 0) << seed;
    if (!is_same(net, open)) ++changed;
  }
  EXPECT_GT(changed, 15);
}

/// Points that were one are not left so close that they would be one again in a file.
TEST(OpenContacts, PartPointsByMoreThanRounding) {
  for (const unsigned seed : {17, 19, 38, 47, 56}) {
    const PartitionSurface net = extract_net_on_grid(random_grid({7, 6, 8}, 6, seed));
    const PartitionSurface open = open_narrow_contacts(net, kAll, {.depth = 2, .gap = 0.1});
    ASSERT_GT(open.points.size(), net.points.size());
    double least = 1;
    for (std::size_t p = net.points.size(); p < open.points.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        least = std::min(least, norm(open.points[p] - open.points[q]));
      }
    }
    EXPECT_GT(least, 1e-6) << seed;
  }
}

/// Far from the origin single precision is coarse: contacts that would not stay open in a file are
/// not opened.
TEST(OpenContacts, MeetNothingInAFileFarFromTheOrigin) {
  std::int64_t opened = 0;
  int nets = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PartitionSurface net = extract_net_on_grid(random_grid({7, 6, 8}, 6, seed));
    const auto in_file = [](const Vec3& p) { return rounded(p + Vec3{-900, 700, 1000}); };
    const ContactOptions options{.depth = 2, .gap = 0.1, .in_file = in_file};
    const PartitionSurface open = open_narrow_contacts(net, kAll, options);
    opened += contact_triangles(net) - contact_triangles(open);
    const auto meet = [&](const PartitionSurface& partition) {
      TriMesh filed{partition.points, partition.triangles};
      for (Vec3& p : filed.points) p = in_file(p);
      return find_self_intersections(filed).size();
    };
    if (meet(net) > 0) continue;
    ++nets;
    EXPECT_EQ(meet(open), 0U) << seed;
  }
  EXPECT_GT(opened, 100);
  EXPECT_GT(nets, 5);
}

TEST(OpenContacts, HoldTheLawsOfPartitionsWhereBlobsTouch) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const OwnedLabels labels = random_blobs(14, 2 + static_cast<int>(seed) % 6, seed);
    const PartitionSurface net = extract_net_on_grid(smooth_memberships(labels.grid()));
    const PartitionSurface open = open_narrow_contacts(net, kAll, {.depth = 3, .gap = 0.1});
    expect_partition_laws(open, labels.box_volume(), "seed " + std::to_string(seed));
  }
}

TEST(OpenContacts, AreTheSameForAnyNumberOfThreads) {
  const PartitionSurface net = extract_net_on_grid(random_grid({9, 9, 9}, 6, 3));
  const ContactOptions options{.depth = 2, .gap = 0.1};
  const auto open = [&] { return open_narrow_contacts(net, kAll, options); };
  const PartitionSurface one = with_threads(1, open), all = with_threads(2, open);
  EXPECT_TRUE(is_same(one, all));
  EXPECT_FALSE(is_same(net, all));
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "object/object_scenes.h"
#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Mat3 columns(const Vec3& x, const Vec3& y, const Vec3& z) { return transpose(Mat3{{x, y, z}}); }

VoxelGrid placed(const Mat3& direction) {
  VoxelGrid grid = grid_of({12, 10, 8}, {0.75, 1.25, 2});
  grid.origin = {-30, 14, 105.5};
  grid.direction = direction;
  return grid;
}

VoxelGrid oblique() {
  const double c = std::cos(0.4), s = std::sin(0.4), e = std::cos(-1.1), f = std::sin(-1.1);
  return placed(Mat3{{Vec3{c, -s * e, s * f}, Vec3{s, c * e, -c * f}, Vec3{0, f, e}}});
}

/// Grids whose axes are those of the world, in any order and sense; one is left-handed.
std::vector<VoxelGrid> along_the_world() {
  return {placed({}), placed(columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1})),
          placed(columns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1})),
          placed(columns({0, 0, -1}, {1, 0, 0}, {0, -1, 0}))};
}

Vec3 centre(const VoxelGrid& grid, const std::array<Index, 3>& v) {
  return grid.to_world({v[0] * grid.spacing.x, v[1] * grid.spacing.y, v[2] * grid.spacing.z});
}

bool holds(const CropRange& range, const std::array<Index, 3>& v) {
  bool inside = true;
  for (std::size_t a = 0; a < 3; ++a) inside &= v[a] >= range.begin[a] && v[a] < range.end[a];
  return inside;
}

std::string box_text(const Box& box) {
  std::string text;
  for (int a = 0; a < 3; ++a) {
    text += (a > 0 ? "," : "") + std::to_string(box.lo[a]) + ":" + std::to_string(box.hi[a]);
  }
  return text;
}

TEST(ParseBox, KeepsOpenEndsOpen) {
  const Box box = parse_box("-5:10,,:2.5");
  EXPECT_EQ(box.lo.x, -5);
  EXPECT_EQ(box.hi.x, 10);
  EXPECT_TRUE(std::isinf(box.lo.y) && std::isinf(box.hi.y) && std::isinf(box.lo.z));
  EXPECT_EQ(box.hi.z, 2.5);
  const Box corners = parse_box("-5,1,2,10,3,2.5");
  EXPECT_EQ(corners.lo, (Vec3{-5, 1, 2}));
  EXPECT_EQ(corners.hi, (Vec3{10, 3, 2.5}));
  for (const auto* text :
       {"", "1:2", "2:1,,", "1:2,3:4,5:6,7:8", "a:b,,", "1,2,3", "1,2,3,4,5,3", "1,2,3,4,5,6,7"}) {
    EXPECT_REFUSED(parse_box(text), HasSubstr("box: expected X0:X1,Y0:Y1,Z0:Z1"));
  }
}

TEST(ParsePoint, ReadsThreeNumbersInTheirFrame) {
  expect_near(parse_point("1,-2.5,3e1", Frame::kLps), {1, -2.5, 30});
  expect_near(parse_point(" 1, +2 ,3", Frame::kRas), {-1, -2, 3});
}

TEST(ParsePoint, RefusesAnythingElse) {
  for (const auto* text : {"", "1,2", "1,2,3,4", "1,2,x", "1,,3", "1,2,3mm", "1;2;3", "nan,0,0",
                           "inf,0,0", "1 2,3,4", "1,2,3,", "++1,2,3"}) {
    EXPECT_REFUSED(parse_point(text, Frame::kLps), HasSubstr("expected X,Y,Z in mm"));
  }
  EXPECT_REFUSED(parse_point("1\n2", Frame::kLps), HasSubstr("\"1 2\""));
  EXPECT_REFUSED(parse_point(std::string(1000, 'x'), Frame::kLps), HasSubstr("...\""));
}

TEST(VoxelAt, IsTheVoxelOfItsOwnCentre) {
  for (const VoxelGrid& grid : {oblique(), along_the_world()[3]}) {
    for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
      const Vec3 nearby = centre(grid, v) + grid.direction * Vec3{0.3, -0.6, 0.9};
      EXPECT_EQ(voxel_at(grid, nearby), v);
    });
  }
}

TEST(VoxelAt, RefusesPointsBeyondTheVoxels) {
  for (const VoxelGrid& grid : {oblique(), along_the_world()[1]}) {
    const Box box = grid.box();
    for (int a = 0; a < 3; ++a) {
      Vec3 below = 0.5 * box.hi, above = below;
      below[a] = -0.49 * grid.spacing[a];
      above[a] = box.hi[a] + 0.49 * grid.spacing[a];
      EXPECT_EQ(voxel_at(grid, grid.to_world(below))[static_cast<std::size_t>(a)], 0);
      EXPECT_EQ(voxel_at(grid, grid.to_world(above))[static_cast<std::size_t>(a)],
                grid.size[static_cast<std::size_t>(a)] - 1);
      below[a] = -0.51 * grid.spacing[a];
      above[a] = box.hi[a] + 0.51 * grid.spacing[a];
      EXPECT_REFUSED(voxel_at(grid, grid.to_world(below)), HasSubstr("within the scan"));
      EXPECT_REFUSED(voxel_at(grid, grid.to_world(above)), HasSubstr("within the scan"));
    }
    EXPECT_REFUSED(voxel_at(grid, {std::nan(""), 0, 0}), HasSubstr("within the scan"));
    EXPECT_REFUSED(voxel_at(grid, {1e300, 0, 0}), HasSubstr("within the scan"));
  }
}

TEST(WorldBox, IsTheSmallestAroundAllCentres) {
  auto grids = along_the_world();
  grids.push_back(oblique());
  for (const VoxelGrid& grid : grids) {
    for (const Frame frame : {Frame::kLps, Frame::kRas}) {
      Box expected{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
      for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
        const Vec3 p = in_frame(centre(grid, v), frame);
        for (int a = 0; a < 3; ++a) {
          expected.lo[a] = std::min(expected.lo[a], p[a]);
          expected.hi[a] = std::max(expected.hi[a], p[a]);
        }
      });
      const Box found = world_box(grid, frame);
      expect_near(found.lo, expected.lo);
      expect_near(found.hi, expected.hi);
    }
  }
}

TEST(BoxToRange, HoldsTheCentresInTheBoxWhereTheAxesAreTheWorlds) {
  for (const VoxelGrid& grid : along_the_world()) {
    for (const Frame frame : {Frame::kLps, Frame::kRas}) {
      const Box all = world_box(grid, frame);
      const Box box{all.lo + 0.31 * all.extent(), all.lo + 0.83 * all.extent()};
      const CropRange range = box_to_range(grid, box_text(box), frame);
      std::size_t inside = 0;
      for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
        const bool is_in = box.contains(in_frame(centre(grid, v), frame));
        EXPECT_EQ(holds(range, v), is_in);
        inside += is_in;
      });
      EXPECT_GT(inside, 20u);
    }
  }
}

TEST(BoxToRange, HoldsFacesOfTheBox) {
  const VoxelGrid grid = along_the_world()[0];  // centres at -30 + 0.75 i, 14 + 1.25 j, 105.5 + 2 k
  const CropRange range = box_to_range(grid, "-28.5:-27,15.25:16.5,105.5:107.5", Frame::kLps);
  EXPECT_EQ(range, (CropRange{{2, 1, 0}, {5, 3, 2}}));
  EXPECT_EQ(box_to_range(grid, "27:28.5,-16.5:-15.25,105.5:107.5", Frame::kRas), range);
}

TEST(BoxToRange, OpenEndsReachToTheScans) {
  for (const VoxelGrid& grid : {along_the_world()[2], oblique()}) {
    for (const auto* text : {",,", ":,:,:", "-1e300:1e300,,", " , : ,"}) {
      EXPECT_EQ(box_to_range(grid, text, Frame::kRas), (CropRange{{0, 0, 0}, grid.size})) << text;
    }
  }
  const VoxelGrid grid = along_the_world()[0];
  EXPECT_EQ(box_to_range(grid, "-28.5:,:16.5,", Frame::kLps), (CropRange{{2, 0, 0}, {12, 3, 8}}));
  EXPECT_EQ(box_to_range(grid, ":28.5,-16.5:,", Frame::kRas), (CropRange{{2, 0, 0}, {12, 3, 8}}));
}

TEST(BoxToRange, OfAnObliqueGridIsTheSmallestThatHoldsTheBox) {
  const VoxelGrid grid = oblique();
  const Vec3 middle = grid.to_world(0.5 * grid.box().hi), half{1.7, 2.1, 1.9};
  const Box box{middle - half, middle + half};
  const CropRange range = box_to_range(grid, box_text(box), Frame::kLps);
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
    if (box.contains(centre(grid, v))) {
      EXPECT_TRUE(holds(range, v));
    }
  });
  const double middles[]{5.5, 4.5, 3.5};
  for (int a = 0; a < 3; ++a) {
    double reach = 0;  // of the box along the grid's axis, from its middle, in voxels
    for (int w = 0; w < 3; ++w) reach += std::abs(grid.direction.rows[std::size_t(w)][a]) * half[w];
    reach /= grid.spacing[a];
    EXPECT_EQ(range.begin[std::size_t(a)], std::ceil(middles[a] - reach - 1e-5)) << a;
    EXPECT_EQ(range.end[std::size_t(a)], std::floor(middles[a] + reach + 1e-5) + 1) << a;
  }
}

TEST(BoxToRange, RefusesWhatIsNoBox) {
  const VoxelGrid grid = along_the_world()[0];
  for (const auto* text : {"", "1:2,3:4", "1:2,3:4,5:6,7:8", "2:1,,", "1:1,,", "1:2:3,,", "a:b,,",
                           "5,,", "nan:1,,", "1:inf,,"}) {
    EXPECT_REFUSED(box_to_range(grid, text, Frame::kLps), HasSubstr("expected X0:X1,Y0:Y1,Z0:Z1"));
  }
}

TEST(BoxToRange, BesideTheScanSaysWhereTheScanIs) {
  const VoxelGrid grid = along_the_world()[0];
  EXPECT_REFUSED(
      box_to_range(grid, "100:200,,", Frame::kLps),
      AllOf(HasSubstr("-30:-21.75,14:25.25,105.5:119.5 mm (LPS)"), HasSubstr("at least 2 voxels")));
  EXPECT_REFUSED(box_to_range(grid, "100:200,,", Frame::kRas), HasSubstr("21.75:30"));
  EXPECT_REFUSED(box_to_range(grid, "-29:-28.4,,", Frame::kLps), HasSubstr("at least 2 voxels"));
}

}  // namespace
}  // namespace mesamis

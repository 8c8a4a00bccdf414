// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom_designs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "mesamis/phantom/phantom.h"

namespace mesamis {
namespace {

const PhantomDesign& design(const std::string& name) {
  for (const PhantomDesign& d : phantom_designs()) {
    if (name == d.name) return d;
  }
  throw std::out_of_range(name);
}

TEST(PhantomDesigns, HaveNamesOfTheirOwnAndTexts) {
  std::set<std::string> names;
  for (const PhantomDesign& d : phantom_designs()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    EXPECT_FALSE(std::string(d.description).empty()) << d.name;
  }
  EXPECT_EQ(names.size(), phantom_list().size());
}

TEST(PhantomDesigns, HaveFineSlabsInOrderWithinTheBox) {
  for (const PhantomDesign& d : phantom_designs()) {
    EXPECT_GT(d.step, 0);
    std::array<double, 3> end{};
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_GE(d.size[a], kPhantomSizeMin);
      end[a] = -0.5 * d.size[a];
    }
    for (const FineSlab& slab : d.fine) {
      const auto a = static_cast<std::size_t>(slab.axis);
      EXPECT_LT(end.at(a), slab.lo) << d.name;
      EXPECT_LT(slab.lo, slab.hi) << d.name;
      EXPECT_LT(slab.hi, 0.5 * d.size[a]) << d.name;
      EXPECT_LT(slab.step, d.step) << d.name;
      end[a] = slab.hi;
    }
  }
}

TEST(PhantomDesigns, AreConstantBelowTheDepthTheyTell) {
  std::mt19937 generator(1);
  for (const PhantomDesign& d : phantom_designs()) {
    std::set<double> greys;
    int inside = 0;
    for (int n = 0; n < 200'000; ++n) {
      Vec3 p;
      for (int a = 0; a < 3; ++a) {
        const double half = 0.5 * d.size[static_cast<std::size_t>(a)];
        p[a] = std::uniform_real_distribution<double>(-half, half)(generator);
      }
      const double depth = d.inside(p);
      inside += depth > 0;
      if (depth <= 0 || d.grey == nullptr) continue;
      const double grey = d.grey(p, depth);
      EXPECT_GT(grey, kSoftTissue) << d.name;
      EXPECT_LE(grey, kBone) << d.name;
      if (depth > d.constant_below) greys.insert(grey);
    }
    EXPECT_GT(inside, 100) << d.name;
    EXPECT_LE(greys.size(), 1u) << d.name;
  }
}

TEST(PhantomDesigns, SphereIsTheExactDistance) {
  for (const double r : {0.0, 5.0, 20.0, 31.0}) {
    const Vec3 p = (r / norm(Vec3{1, 2, 2})) * Vec3{1, 2, 2};
    EXPECT_NEAR(design("sphere").inside(p), 20 - r, 1e-12);
  }
}

/// The volume inside by midpoints, mm^3.
double volume_of(const PhantomDesign& d, double step) {
  double count = 0;
  const auto from = [&](std::size_t a) { return -0.5 * d.size[a] + step / 2; };
  for (double z = from(2); z < 0.5 * d.size[2]; z += step) {
    for (double y = from(1); y < 0.5 * d.size[1]; y += step) {
      for (double x = from(0); x < 0.5 * d.size[0]; x += step) count += d.inside({x, y, z}) > 0;
    }
  }
  return count * step * step * step;
}

TEST(PhantomDesigns, PlateHasTheVolumeOfItsSides) {
  // 44 x 36 x 2 mm, its edges and corners rounded with 0.6 mm.
  constexpr double r = 0.6, kPi = std::numbers::pi;
  const double a = 44 - 2 * r, b = 36 - 2 * r, c = 2 - 2 * r;
  const double exact = a * b * c + 2 * r * (a * b + b * c + a * c) + kPi * r * r * (a + b + c) +
                       4.0 / 3 * kPi * r * r * r;
  EXPECT_NEAR(volume_of(design("plate"), 0.4) / exact, 1, 0.01);
}

TEST(PhantomDesigns, WallGrowsThinAtAKnownRate) {
  const PhantomDesign& d = design("wall");
  // Through the wall, in its own frame: turned by 0.3 about z, then by 0.2 about y.
  const auto thickness = [&d](double x) {
    double sum = 0;
    for (double y = -4; y < 4; y += 0.002) {
      const double cy = std::cos(0.2), sy = std::sin(0.2), cz = std::cos(0.3), sz = std::sin(0.3);
      const Vec3 q{cy * x, y, -sy * x};
      sum += d.inside({cz * q.x - sz * q.y, 9 + sz * q.x + cz * q.y, q.z}) > 0 ? 0.002 : 0;
    }
    return sum;
  };
  for (const double x : {-20.0, -10.0, 0.0, 10.0, 20.0}) {
    EXPECT_NEAR(thickness(x), 0.3 + (x + 26) / 52 * 2.7, 0.01) << x;
  }
}

TEST(PhantomDesigns, FractureHasAGapThatNarrows) {
  const PhantomDesign& d = design("fracture");
  // Across the gap, in its own frame: turned by 0.12 about y.
  const auto at = [&d](double x, double z) {
    const double c = std::cos(0.12), s = std::sin(0.12);
    return d.inside({c * x + s * z, 0, c * z - s * x});
  };
  const auto width = [&at](double x) {
    double sum = 0;
    for (double z = -6; z < 6; z += 0.01) sum += at(x, z) < 0 ? 0.01 : 0;
    return sum;
  };
  EXPECT_EQ(width(-8), 0);             // beyond the tip
  EXPECT_GT(width(0), 0.5);            // past it
  EXPECT_GT(width(10), width(0) + 1);  // wide where it begins
}

}  // namespace
}  // namespace mesamis

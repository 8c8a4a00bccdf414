// SPDX-License-Identifier: Apache-2.0
// The hip bone of phantom/hemipelvis.cpp, as make_phantom() hands it out.
#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/phantom/implicit_surface.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {
namespace {

/// Half the size of life: the shape is the same, and a quarter of the work.
const Phantom& hemipelvis() {
  static const Phantom phantom = make_phantom("hemipelvis", {102, 122, 152});
  return phantom;
}

/// A point of the design, given from the middle of its box.
Vec3 design_point(const Vec3& p) { return Vec3{51, 61, 76} + hemipelvis().scale * p; }

/// The volume by the points of a grid that are inside, mm^3.
double volume_by_points(double step) {
  const auto layers = static_cast<std::size_t>(152 / step);
  return step * step * step * parallel_sum(layers, [step](std::size_t begin, std::size_t end) {
           double count = 0;
           for (std::size_t k = begin; k < end; ++k) {
             const double z = (static_cast<double>(k) + 0.5) * step;
             for (double y = step / 2; y < 122; y += step) {
               for (double x = step / 2; x < 102; x += step)
                 count += hemipelvis().inside({x, y, z}) > 0;
             }
           }
           return count;
         });
}

TEST(Hemipelvis, TruthIsClosedAndOfTheVolumeInside) {
  const TriMesh truth = extract_implicit(hemipelvis().lines, hemipelvis().inside, 0.2);
  const SurfaceCheck check = check_surface(truth);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume / volume_by_points(1), 1, 0.01);
}

TEST(Hemipelvis, HasItsLandmarks) {
  const auto is_bone = [](const Vec3& p) { return hemipelvis().inside(design_point(p)) > 0; };
  const Vec3 socket{22, -8, -32};
  EXPECT_FALSE(is_bone(socket + Vec3{9, -7, -7}));      // the head of the femur sits here
  EXPECT_TRUE(is_bone(socket + Vec3{-24, 12, 4}));      // behind it the columns
  EXPECT_TRUE(is_bone(socket + Vec3{-14, 30, -66}));    // the ischium
  EXPECT_TRUE(is_bone(socket + Vec3{-62, -48, -22}));   // the pubis
  EXPECT_FALSE(is_bone(socket + Vec3{-42, -12, -40}));  // the obturator foramen
}

TEST(Hemipelvis, IsDenserAtItsSurface) {
  double shallow = 0, deep = 0;
  for (double z = 1; z < 152; z += 2) {
    for (double y = 1; y < 122; y += 2) {
      for (double x = 1; x < 102; x += 2) {
        const double depth = hemipelvis().inside({x, y, z});
        if (depth <= 0) continue;
        const double grey = hemipelvis().grey({x, y, z}, depth);
        EXPECT_GE(grey, 200);
        EXPECT_LE(grey, 230);
        if (depth < 0.4) shallow = std::max(shallow, 230 - grey);
        if (depth > hemipelvis().constant_below) deep = std::max(deep, std::abs(grey - 200));
      }
    }
  }
  EXPECT_LT(shallow, 1e-9);  // the shell
  EXPECT_LT(deep, 1e-9);     // constant where the phantom says so
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mesamis/base/error.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

double bumpy(Index i, Index j, Index k) { return std::sin(1.3 * i) + std::cos(0.7 * j * k) + k; }

/// An oblique, anisotropic grid with samples of no special structure.
Volume oblique(std::array<Index, 3> size = {5, 4, 6}) {
  Volume v;
  v.size = size;
  v.spacing = {0.5, 1.25, 2};
  v.origin = {-10, 20, 3};
  const double c = std::cos(0.3), s = std::sin(0.3);
  v.direction = {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  v.modality = "CT";
  for (Index k = 0; k < size[2]; ++k)
    for (Index j = 0; j < size[1]; ++j)
      for (Index i = 0; i < size[0]; ++i) v.samples.push_back(static_cast<float>(bumpy(i, j, k)));
  return v;
}

Vec3 centre(const Volume& v, Index i, Index j, Index k) {
  return {i * v.spacing.x, j * v.spacing.y, k * v.spacing.z};
}

std::string complaint(const Volume& v) {
  try {
    require_usable(v);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Volume, AcceptsAnObliqueAndALeftHandedGrid) {
  EXPECT_EQ(complaint(oblique()), "");
  Volume mirrored = oblique();
  for (Vec3& row : mirrored.direction.rows) row.x = -row.x;
  EXPECT_EQ(complaint(mirrored), "");
}

TEST(Volume, RefusesWhatNoMethodCanUse) {
  const auto spoil = [](auto&& change) {
    Volume v = oblique();
    change(v);
    return complaint(v);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(oblique({5, 4, 1})), HasSubstr("found 5 x 4 x 1"));
  EXPECT_THAT(complaint(Volume{}), HasSubstr("at least 2 voxels"));
  Volume slice;
  slice.size = {5, 4, 1};
  EXPECT_REFUSED(cropped_size(slice, {}), HasSubstr("volume: expected at least 2 voxels"));
  EXPECT_THAT(spoil([](Volume& v) { v.samples.pop_back(); }), HasSubstr("found 119"));
  EXPECT_THAT(spoil([](Volume& v) { v.spacing.y = 0; }), HasSubstr("spacing along axis 1"));
  EXPECT_THAT(spoil([&](Volume& v) { v.spacing.z = nan; }), HasSubstr("spacing along axis 2"));
  EXPECT_THAT(spoil([&](Volume& v) { v.origin.x = nan; }), HasSubstr("finite origin"));
  EXPECT_THAT(spoil([](Volume& v) { v.direction.rows[0].x *= 1.01; }), HasSubstr("orthonormal"));
  EXPECT_THAT(spoil([&](Volume& v) { v.direction.rows[2].z = nan; }), HasSubstr("orthonormal"));
  EXPECT_THAT(spoil([&](Volume& v) { v.samples[v.offset(3, 2, 1)] = static_cast<float>(nan); }),
              HasSubstr("at voxel 3 2 1"));
  EXPECT_THAT(spoil([](Volume& v) { std::fill(v.samples.begin(), v.samples.end(), 7.f); }),
              HasSubstr("found 7 everywhere"));
}

/// Voxels that no Volume owns, as a program that uses the library has them.
class ViewOfAnArray : public ::testing::Test {
 protected:
  const Volume owner_ = oblique();
  const std::vector<float> voxels_ = owner_.samples;
  const VolumeView view_{owner_, voxels_};
};

TEST_F(ViewOfAnArray, CopiesNoSample) {
  EXPECT_EQ(view_.samples.data(), voxels_.data());
  const VolumeView of_volume = owner_;
  EXPECT_EQ(of_volume.samples.data(), owner_.samples.data());
  EXPECT_EQ(of_volume.samples.size(), owner_.samples.size());
}

TEST_F(ViewOfAnArray, KnowsTheSameGridAndSamples) {
  EXPECT_EQ(view_.size, owner_.size);
  EXPECT_EQ(view_.modality, "CT");
  EXPECT_EQ(view_.box(), owner_.box());
  EXPECT_EQ(view_.to_world({1, 2, 3}), owner_.to_world({1, 2, 3}));
  EXPECT_EQ(view_.at(3, 2, 1), owner_.at(3, 2, 1));
}

TEST_F(ViewOfAnArray, IsReadAsTheVolumeIs) {
  EXPECT_NO_THROW(require_usable(view_));
  const CropRange range{{1, 0, 2}, {4, -1, 5}};
  EXPECT_EQ(crop(view_, range).samples, crop(owner_, range).samples);
  EXPECT_EQ(subsample(view_, {2, 3, 1}).samples, subsample(owner_, {2, 3, 1}).samples);
  EXPECT_EQ(interpolate(view_, {0.7, 1.1, 4.2}), interpolate(owner_, {0.7, 1.1, 4.2}));
}

TEST_F(ViewOfAnArray, IsRefusedWhereSamplesAreMissing) {
  const VolumeView cut{owner_, std::span(voxels_).first(100)};
  EXPECT_REFUSED(require_usable(cut), HasSubstr("expected 120 samples"));
}

TEST_F(ViewOfAnArray, IsCopiedIntoAVolumeOfItsOwn) {
  const Volume copy = copy_volume(view_);
  EXPECT_EQ(copy.samples, voxels_);
  EXPECT_NE(copy.samples.data(), voxels_.data());
  EXPECT_EQ(copy.origin, view_.origin);
  EXPECT_EQ(copy.direction, view_.direction);
}

TEST(VolumeView, IsWrittenInOneExpression) {
  const std::vector<float> voxels{0, 1, 2, 3, 4, 5, 6, 7};
  const VolumeView view{{.size = {2, 2, 2}, .spacing = {0.5, 0.5, 1}}, voxels};
  EXPECT_NO_THROW(require_usable(view));
  EXPECT_EQ(view.at(1, 0, 1), 5);
}

TEST(Volume, GoesToTheWorldAndBack) {
  Volume v = oblique();
  EXPECT_LT(norm(v.to_grid(v.origin)), 1e-12);
  for (const bool mirrored : {false, true}) {
    if (mirrored) v.direction.rows[1].z = -v.direction.rows[1].z, v.direction.rows[2].z *= -1;
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{-4, 0.5, 100}}) {
      EXPECT_LT(norm(v.to_grid(v.to_world(p)) - p), 1e-12);
    }
  }
}

TEST(Volume, CropKeepsSamplesAndTheirPlaceInTheWorld) {
  const Volume v = oblique();
  const Volume part = crop(v, {{1, 0, 2}, {4, -1, 5}});
  EXPECT_EQ(part.size, (std::array<Index, 3>{3, 4, 3}));
  EXPECT_EQ(part.modality, "CT");
  for (Index k = 0; k < part.size[2]; ++k)
    for (Index j = 0; j < part.size[1]; ++j)
      for (Index i = 0; i < part.size[0]; ++i) {
        EXPECT_EQ(part.at(i, j, k), v.at(i + 1, j, k + 2));
        EXPECT_LT(
            norm(part.to_world(centre(part, i, j, k)) - v.to_world(centre(v, i + 1, j, k + 2))),
            1e-12);
      }
}

TEST(Volume, CropOfMarksKeepsThoseOfTheSameVoxels) {
  const Volume v = oblique();
  std::vector<std::uint8_t> marks(v.voxel_count());
  for (std::size_t n = 0; n < marks.size(); ++n) marks[n] = static_cast<std::uint8_t>(n);
  const CropRange range{{1, 0, 2}, {4, -1, 5}};
  const auto kept = crop(marks, v, range);
  const Volume part = crop(v, range);
  ASSERT_EQ(kept.size(), part.voxel_count());
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const auto [i, j, k] = part.voxel(n);
    EXPECT_EQ(kept[n], marks[v.offset(i + 1, j, k + 2)]);
  }
  EXPECT_REFUSED(crop(marks, v, {{3, 0, 0}, {3, -1, -1}}), HasSubstr("crop"));
}

TEST(VoxelGrid, TellsTheVoxelOfEachPlace) {
  const VoxelGrid grid = oblique();
  for (Index k = 0; k < grid.size[2]; ++k)
    for (Index j = 0; j < grid.size[1]; ++j)
      for (Index i = 0; i < grid.size[0]; ++i)
        EXPECT_EQ(grid.voxel(grid.offset(i, j, k)), (std::array<Index, 3>{i, j, k}));
}

TEST(VoxelGrid, TellsTheVolumeOfAVoxel) {
  EXPECT_EQ((VoxelGrid{.spacing = {0.5, 2, 3}}.voxel_volume()), 3);
  EXPECT_NEAR((VoxelGrid{.spacing = {0.5, 2, 8}}.voxel_size()), 2, 1e-15);
}

TEST(Volume, CropRefusesRangesOutsideEmptyOrThin) {
  const Volume v = oblique();
  EXPECT_THROW(crop(v, {{-1, 0, 0}, {-1, -1, -1}}), InputError);
  EXPECT_THROW(crop(v, {{0, 0, 0}, {6, -1, -1}}), InputError);
  EXPECT_THROW(crop(v, {{3, 0, 0}, {3, -1, -1}}), InputError);
  EXPECT_THROW(crop(v, {{4, 0, 0}, {-1, -1, -1}}), InputError);
  EXPECT_THROW(crop(v, {{std::numeric_limits<Index>::max(), 0, 0}, {-1, -1, -1}}), InputError);
}

TEST(Volume, SubsampleKeepsEveryStrideThVoxelInItsPlace) {
  const Volume v = oblique();
  const Volume coarse = subsample(v, {2, 3, 1});
  EXPECT_EQ(coarse.size, (std::array<Index, 3>{3, 2, 6}));
  for (Index k = 0; k < coarse.size[2]; ++k)
    for (Index j = 0; j < coarse.size[1]; ++j)
      for (Index i = 0; i < coarse.size[0]; ++i) {
        EXPECT_EQ(coarse.at(i, j, k), v.at(2 * i, 3 * j, k));
        EXPECT_LT(
            norm(coarse.to_world(centre(coarse, i, j, k)) - v.to_world(centre(v, 2 * i, 3 * j, k))),
            1e-12);
      }
  EXPECT_EQ(coarse.spacing, (Vec3{2 * v.spacing.x, 3 * v.spacing.y, v.spacing.z}));
  EXPECT_THROW(subsample(v, {0, 1, 1}), InputError);
  EXPECT_THROW(subsample(v, {1, 4, 1}), InputError);
}

TEST(Interpolate, EqualsTheSamplesAtTheVoxelCentres) {
  const Volume v = oblique();
  for (Index k = 0; k < v.size[2]; ++k)
    for (Index j = 0; j < v.size[1]; ++j)
      for (Index i = 0; i < v.size[0]; ++i) {
        EXPECT_NEAR(interpolate(v, centre(v, i, j, k)), v.at(i, j, k), 1e-6);
      }
}

TEST(Interpolate, ReproducesLinearFunctions) {
  Volume v = oblique();
  const auto linear = [](const Vec3& p) { return 1 + 2 * p.x - 3 * p.y + 0.5 * p.z; };
  for (Index k = 0; k < v.size[2]; ++k)
    for (Index j = 0; j < v.size[1]; ++j)
      for (Index i = 0; i < v.size[0]; ++i) {
        v.samples[v.offset(i, j, k)] = static_cast<float>(linear(centre(v, i, j, k)));
      }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 hi = v.box().hi;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p{unit(random) * hi.x, unit(random) * hi.y, unit(random) * hi.z};
    EXPECT_NEAR(interpolate(v, p), linear(p), 1e-5);
  }
}

/// The definition: barycentric coordinates in the one of the cell's six tetrahedra (corner, +a,
/// +a+b, +a+b+c) that holds the point.
double by_definition(const Volume& v, const Vec3& t) {
  const Vec3 base{std::floor(t.x), std::floor(t.y), std::floor(t.z)};
  const Vec3 f = t - base;
  std::array<int, 3> path{0, 1, 2};
  do {
    const double w0 = 1 - f[path[0]], w1 = f[path[0]] - f[path[1]];
    const double w2 = f[path[1]] - f[path[2]], w3 = f[path[2]];
    if (std::min({w0, w1, w2, w3}) < 0) continue;
    std::array<Index, 3> at{static_cast<Index>(base.x), static_cast<Index>(base.y),
                            static_cast<Index>(base.z)};
    double sum = w0 * v.at(at[0], at[1], at[2]);
    const std::array<double, 3> weights{w1, w2, w3};
    for (std::size_t s = 0; s < 3; ++s) {
      ++at[static_cast<std::size_t>(path[s])];
      sum += weights[s] * v.at(at[0], at[1], at[2]);
    }
    return sum;
  } while (std::next_permutation(path.begin(), path.end()));
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(Interpolate, AgreesWithBarycentricCoordinatesInTheKuhnCells) {
  const Volume v = oblique();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 0.999);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 t{unit(random) * (v.size[0] - 1), unit(random) * (v.size[1] - 1),
                 unit(random) * (v.size[2] - 1)};
    const Vec3 p{t.x * v.spacing.x, t.y * v.spacing.y, t.z * v.spacing.z};
    EXPECT_NEAR(interpolate(v, p), by_definition(v, t), 1e-6);
  }
}

TEST(Interpolate, ClampsToTheBox) {
  const Volume v = oblique();
  const Vec3 hi = v.box().hi;
  const double huge = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(interpolate(v, {-5, -5, -5}), v.at(0, 0, 0));
  EXPECT_DOUBLE_EQ(interpolate(v, hi + Vec3{9, 9, 9}), v.at(4, 3, 5));
  EXPECT_DOUBLE_EQ(interpolate(v, {huge, -huge, huge}), v.at(4, 0, 5));
  EXPECT_DOUBLE_EQ(interpolate(v, {1e300, 0, 0}), v.at(4, 0, 0));
  EXPECT_DOUBLE_EQ(interpolate(v, {-1, 1.25 * 2, 99}), v.at(0, 2, 5));
}

TEST(Interpolate, WorksOnTheSmallestVolume) {
  Volume v;
  v.size = {2, 2, 2};
  v.samples = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_DOUBLE_EQ(interpolate(v, {1, 1, 1}), 7);
  EXPECT_DOUBLE_EQ(interpolate(v, {0.5, 0.25, 0.125}), 0.5 + 0.5 + 0.5);
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "mesamis/base/parallel.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;

/// The object's volume by the voxels of a phantom of two grey values, mm^3.
double volume_by_voxels(const Volume& volume) {
  double sum = 0;
  for (const float x : volume.samples) sum += (double{x} - 120) / (230 - 120);
  return sum * volume.spacing.x * volume.spacing.y * volume.spacing.z;
}

TEST(Phantom, SphereFillsItsVoxelsAsItShould) {
  const Volume volume = sample_phantom(make_phantom("sphere"));
  const double exact = 4.0 / 3 * kPi * 20 * 20 * 20;
  EXPECT_NEAR(volume_by_voxels(volume) / exact, 1, 5e-4);
  const Vec3 middle{32, 32, 32};
  for (Index k = 0; k < 64; ++k) {
    for (Index j = 0; j < 64; ++j) {
      for (Index i = 0; i < 64; ++i) {
        const double off = norm(volume.to_world({double(i), double(j), double(k)}) - middle) - 20;
        if (off > 0.87) {
          EXPECT_EQ(volume.at(i, j, k), 120);
        }
        if (off < -0.87) {
          EXPECT_EQ(volume.at(i, j, k), 230);
        }
      }
    }
  }
}

TEST(Phantom, MorePointsPerVoxelComeNearerToTheTruth) {
  const Phantom phantom = make_phantom("sphere", {24, 24, 24}, {2, 2, 2});
  const Volume best = sample_phantom(phantom, 16);
  const auto error = [&](int samples) {
    const Volume volume = sample_phantom(phantom, samples);
    double sum = 0;
    for (std::size_t n = 0; n < best.samples.size(); ++n) {
      sum += std::pow(double{volume.samples[n]} - best.samples[n], 2);
    }
    return std::sqrt(sum);
  };
  EXPECT_LT(error(4), 0.4 * error(1));
  EXPECT_LT(error(8), 0.6 * error(4));
}

TEST(Phantom, ShapeDependsOnTheBoxNotOnItsVoxels) {
  const Phantom fine = make_phantom("fracture");
  const Phantom flat = make_phantom("fracture", {64, 32, 16}, {1, 2, 4});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 64);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{uniform(generator), uniform(generator), uniform(generator)};
    EXPECT_DOUBLE_EQ(fine.inside(p), flat.inside(p));
  }
  const Volume a = sample_phantom(fine), b = sample_phantom(flat);
  EXPECT_NEAR(volume_by_voxels(a) / volume_by_voxels(b), 1, 2e-3);
}

TEST(Phantom, ScalesWithTheBoxAndStaysInItsMiddle) {
  const Phantom unit = make_phantom("sphere");
  const Phantom wide = make_phantom("sphere", {96, 32, 64}, {1, 1, 1});
  EXPECT_DOUBLE_EQ(wide.scale, 0.5);
  EXPECT_DOUBLE_EQ(wide.inside({48, 16, 32}), 10);
  EXPECT_DOUBLE_EQ(unit.inside({32, 32, 32}), 20);
}

/// What sampling and extraction rely on.
TEST(Phantom, EveryOneIsLipschitzWithAGradientNearItsSurface) {
  for (const PhantomInfo& info : phantom_list()) {
    const Phantom phantom = make_phantom(info.name);
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr double h = 1e-5;
    for (int i = 0; i < 100000; ++i) {
      Vec3 p, slope;
      for (int a = 0; a < 3; ++a)
        p[a] = uniform(generator) * info.size[static_cast<std::size_t>(a)];
      for (int a = 0; a < 3; ++a) {
        Vec3 step;
        step[a] = h;
        slope[a] = (phantom.inside(p + step) - phantom.inside(p - step)) / (2 * h);
      }
      ASSERT_LE(norm(slope), 1.0001) << info.name;
      if (std::abs(phantom.inside(p)) < 0.3) {
        ASSERT_GE(norm(slope), 0.2) << info.name;
      }
    }
  }
}

TEST(Phantom, EveryOneKeepsClearOfItsBox) {
  for (const PhantomInfo& info : phantom_list()) {
    const Volume volume = sample_phantom(make_phantom(info.name), 1);
    for (Index k = 0; k < info.size[2]; ++k) {
      for (Index j = 0; j < info.size[1]; ++j) {
        for (Index i = 0; i < info.size[0]; ++i) {
          const bool inner = std::min({i, j, k}) > 0 && i < info.size[0] - 1 &&
                             j < info.size[1] - 1 && k < info.size[2] - 1;
          if (!inner) {
            ASSERT_EQ(volume.at(i, j, k), 120) << info.name;
          }
        }
      }
    }
  }
}

TEST(Phantom, FemurHasAShellAroundALighterCore) {
  const Phantom femur = make_phantom("femur");
  const Volume volume = sample_phantom(femur, 2);
  std::size_t shell = 0, core = 0;
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    const Index i = static_cast<Index>(n % 64), j = static_cast<Index>(n / 64 % 64);
    const Vec3 p = volume.to_world({double(i), double(j), double(n / 64 / 64)});
    const double depth = femur.inside(p);
    if (depth > 5) {
      ASSERT_GE(volume.samples[n], 184);
      ASSERT_LE(volume.samples[n], 216);
      ++core;
    }
    if (depth > 0.9 && depth < 1 && p.z < 30) {
      ASSERT_GT(volume.samples[n], 215);  // the surface may pass through the voxel's corner
      ++shell;
    }
  }
  EXPECT_GT(core, 1000u);
  EXPECT_GT(shell, 50u);
}

TEST(Phantom, SameBytesOnAnyNumberOfThreads) {
  const Phantom phantom = make_phantom("hemipelvis", {51, 61, 76});
  const Volume all = sample_phantom(phantom);
  const Volume one = with_threads(1, [&] { return sample_phantom(phantom); });
  EXPECT_EQ(all.samples, one.samples);
}

/// The slices of a source, read so many at once, one after the other.
std::vector<float> read_in_slabs(const SliceSource& source, Index height) {
  std::vector<float> all;
  for (Index first = 0; first < source.grid().size[2]; first += height) {
    const auto part = source.read(first, std::min(height, source.grid().size[2] - first));
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// Bricks of voxels are decided as a whole; slabs cut through them.
TEST(PhantomSlices, AreThoseOfTheWholeForAnyHeight) {
  for (const PhantomInfo& info : phantom_list()) {
    const Phantom phantom = make_phantom(info.name, {26, 30, 37}, {2, 1.5, 2.5});
    const Volume whole = sample_phantom(phantom, 2);
    const PhantomSlices slices(phantom, 2);
    EXPECT_EQ(slices.grid().origin, whole.origin);
    EXPECT_EQ(slices.grid().size, whole.size);
    for (const Index height : {1, 5, 8, 37}) {
      EXPECT_EQ(read_in_slabs(slices, height), whole.samples) << info.name << ' ' << height;
    }
  }
}

TEST(PhantomSlices, ComeFromAVolumeOfMoreThan32BitsOfVoxels) {
  const Phantom phantom = make_phantom("sphere", {4096, 4096, 4096}, {1, 1, 1});
  const PhantomSlices slices(phantom, 1);
  EXPECT_EQ(slices.grid().voxel_count(), std::size_t{1} << 36);
  const std::vector<float> middle = slices.read(2047, 1);
  ASSERT_EQ(middle.size(), std::size_t{4096} * 4096);
  const auto at = [&](std::size_t i, std::size_t j) { return middle[j * 4096 + i]; };
  EXPECT_EQ(at(2047, 2047), 230);  // the radius is 20/64 of the box: 1280 voxels
  EXPECT_EQ(at(2048 + 1275, 2047), 230);
  EXPECT_EQ(at(2048 + 1285, 2047), 120);
  EXPECT_EQ(at(2047, 2048 - 1285), 120);
}

TEST(Phantom, RefusesWhatItCannotMake) {
  EXPECT_REFUSED(make_phantom("ball"),
                 HasSubstr("sphere, plate, wall, femur, fracture, hemipelvis"));
  EXPECT_REFUSED(make_phantom("sphere", {64, 7, 64}), HasSubstr("size: expected 8 to 4096"));
  EXPECT_REFUSED(make_phantom("sphere", {64, 64, 5000}), HasSubstr("found 5000"));
  EXPECT_REFUSED(sample_phantom(make_phantom("sphere", {4096, 4096, 4096})), HasSubstr("2^31"));
  EXPECT_REFUSED(make_phantom("sphere", {64, 64, 64}, {1, 0, 1}), HasSubstr("spacing"));
  EXPECT_REFUSED(sample_phantom(make_phantom("sphere"), 0), HasSubstr("samples"));
  EXPECT_REFUSED(PhantomSlices(make_phantom("sphere"), 17), HasSubstr("samples"));
}

}  // namespace
}  // namespace mesamis

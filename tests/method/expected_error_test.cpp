// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/expected_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "mesamis/method/mes_amis.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/phantom/phantom_truth.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/measure.h"
#include "mesamis/surface/sampling.h"
#include "support/ball_volume.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

const Vec3 kCenter{19.5, 19.5, 19.5};

TriMesh ball() {
  return level_set({{0, 0, 0}, {39, 39, 39}}, {20, 20, 20},
                   [](const Vec3& p) { return 11 - norm(p - kCenter); });
}

ErrorSummary summary_of(const ErrorOptions& options) {
  const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = 11}));
  const TriMesh surface = ball();
  return summarize_error(surface, expected_error(surface, image, options));
}

TEST(ExpectedError, GrowsWithNoiseBlurAndContrast) {
  const ErrorOptions usual{.noise = {5, 5, 5}, .contrast = 110, .blur = {1, 1, 1}};
  const double mean = summary_of(usual).mean;
  EXPECT_GT(mean, 0);
  const auto with = [&usual](auto change) {
    ErrorOptions other = usual;
    change(other);
    return summary_of(other);
  };
  EXPECT_GT(with([](ErrorOptions& o) { o.noise = {10, 10, 10}; }).mean, mean);
  EXPECT_GT(with([](ErrorOptions& o) { o.contrast = 220; }).mean, mean);
  EXPECT_GT(with([](ErrorOptions& o) { o.level = 5; }).mean, mean);
  EXPECT_GT(with([](ErrorOptions& o) { o.blur = {1.5, 1.5, 1.5}; }).mean, mean);
  EXPECT_GE(summary_of(usual).percentile95, mean);
  EXPECT_LE(with([](ErrorOptions& o) {
              o.noise = {1e9, 0, 0};
            }).mean,
            2 + 1e-9)
      << "two voxels at most";
  EXPECT_EQ(summary_of({}).mean, 0);
  ErrorOptions decimated = usual;
  decimated.decimated = 0.8;
  EXPECT_GT(summary_of(decimated).mean, std::hypot(mean, 0.19));
  EXPECT_LT(summary_of(decimated).mean, mean + 0.2);
}

TEST(ExpectedError, LeavesOutWhereTheBoxCutsTheObject) {
  const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = 11}));
  TriMesh surface = ball();
  const ErrorOptions usual{.noise = {5, 5, 5}, .contrast = 110, .blur = {1, 1, 1}};
  const double mean = summarize_error(surface, expected_error(surface, image, usual)).mean;
  const auto first = static_cast<int>(surface.points.size());
  for (const Vec3& p : {Vec3{0, 5, 5}, Vec3{0, 30, 5}, Vec3{0, 5, 30}}) surface.points.push_back(p);
  surface.triangles.push_back({first, first + 1, first + 2});
  const auto errors = expected_error(surface, image, usual);
  EXPECT_EQ(errors.back(), 0);
  EXPECT_EQ(summarize_error(surface, errors).mean, mean);
}

TEST(ExpectedError, SummarizesOverTheArea) {
  const TriMesh surface = ball();
  const std::vector<double> same(surface.points.size(), 0.25);
  EXPECT_NEAR(summarize_error(surface, same).mean, 0.25, 1e-12);
  // 95 % of a normal variable lie within 1.95996 deviations, its mean size is 0.79788 of one.
  EXPECT_NEAR(summarize_error(surface, same).percentile95, 0.25 * 1.95996 / 0.79788, 1e-5);
  std::vector<double> height(surface.points.size());
  std::transform(surface.points.begin(), surface.points.end(), height.begin(),
                 [](const Vec3& p) { return p.z; });
  // A sphere has the same area in every slab of the same height (Archimedes).
  EXPECT_NEAR(summarize_error(surface, height).mean, 19.5, 0.1);
  EXPECT_NEAR(summarize_error(surface, height).most, 19.5 + 11, 0.4);
  double inside = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    const double size = (height[a] + height[b] + height[c]) / 3;
    inside += triangle_area(surface, t) *
              std::erf(summarize_error(surface, height).percentile95 / (size * std::sqrt(M_PI)));
  }
  EXPECT_NEAR(inside / summarize_error(surface, height).area, 0.95, 1e-3);
  EXPECT_EQ(summarize_error({}, {}).mean, 0);
}

TEST(ExpectedError, IsWithinAFactorOfTwoOfTheRealOne) {
  const Phantom phantom = make_phantom("femur", {48, 48, 48});
  const TriMesh truth = make_truth(phantom).surface;
  struct Case {
    double noise;
    std::optional<double> tolerance;
  };
  for (const auto& [noise, tolerance] : {Case{4, {}}, Case{15, {}}, Case{4, 0.6}}) {
    Settings settings;
    settings.tolerance = tolerance;
    const Result result =
        mes_amis(degrade(sample_phantom(phantom), {.blur = 1, .noise = noise}), settings);
    const double found = summarize_error(result.surface, result.expected_error).mean;
    // Over the area: vertices lie farther out than the triangles between them.
    const std::vector<Vec3> samples = sample_by_area(result.surface, 20000);
    const auto distances = distances_to_surface(samples, truth);
    const double real = std::accumulate(distances.begin(), distances.end(), 0.0) / 20000;
    EXPECT_LT(found, 2 * real) << noise;
    EXPECT_GT(found, real / 2) << noise;
  }
}

}  // namespace
}  // namespace mesamis

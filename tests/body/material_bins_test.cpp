// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/material_bins.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Elements {
  std::vector<double> modulus, density;
};

Elements random_elements(int count) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> modulus(7, 1.2);
  Elements e;
  for (int c = 0; c < count; ++c) {
    e.modulus.push_back(std::round(modulus(random)) + 1);  // some are equal
    e.density.push_back(std::sqrt(e.modulus.back()) / 100);
  }
  return e;
}

TEST(MaterialBins, OfAKnownExample) {
  const std::vector<double> e{100, 400, 950, 1000, 449, 401, 899}, rho{1, 4, 9, 10, 4, 4, 8};
  const MaterialBins found = bin_materials(e, rho, {.gap = 50, .poisson = 0.4});
  EXPECT_THAT(found.of_cell, ElementsAre(3, 2, 0, 0, 2, 2, 1));
  ASSERT_EQ(found.bins.size(), 4u);
  const MaterialBin &first = found.bins[0], &third = found.bins[2];
  EXPECT_EQ(first.modulus, 1000);
  EXPECT_EQ(first.modulus_low, 950);
  EXPECT_EQ(first.modulus_high, 1000);
  EXPECT_EQ(first.density, 9.5);
  EXPECT_EQ(first.poisson, 0.4);
  EXPECT_EQ(first.cells, 2);
  EXPECT_EQ(third.modulus, 449);
  EXPECT_EQ(third.density, 4);
  const MaterialBins mean = bin_materials(e, rho, {.gap = 50, .modulus = BinModulus::kMean});
  EXPECT_EQ(mean.of_cell, found.of_cell);
  EXPECT_EQ(mean.bins[0].modulus, 975);
  EXPECT_NEAR(mean.bins[2].modulus, 1250.0 / 3, 1e-9);
}

TEST(MaterialBins, NoElementIsFartherFromItsBinThanTheGap) {
  const Elements elements = random_elements(4000);
  for (const double gap : {0.0, 1.0, 37.5, 500.0, 1e9}) {
    for (const BinModulus which : {BinModulus::kHighest, BinModulus::kMean}) {
      const MaterialBins found =
          bin_materials(elements.modulus, elements.density, {.gap = gap, .modulus = which});
      Index counted = 0;
      for (const MaterialBin& bin : found.bins) counted += bin.cells;
      EXPECT_EQ(counted, 4000);
      for (std::size_t c = 0; c < elements.modulus.size(); ++c) {
        const MaterialBin& bin = found.bins[static_cast<std::size_t>(found.of_cell[c])];
        EXPECT_LE(std::abs(bin.modulus - elements.modulus[c]), gap);
        EXPECT_GE(elements.modulus[c], bin.modulus_low);
        EXPECT_LE(elements.modulus[c], bin.modulus_high);
      }
    }
  }
}

/// No bin could be dropped: each opens beyond the gap of the one before.
TEST(MaterialBins, OpenOnlyBeyondTheGap) {
  const Elements elements = random_elements(1000);
  const MaterialBins found = bin_materials(elements.modulus, elements.density, {.gap = 60});
  EXPECT_EQ(found.bins[0].modulus,
            *std::max_element(elements.modulus.begin(), elements.modulus.end()));
  for (std::size_t b = 1; b < found.bins.size(); ++b) {
    EXPECT_GT(found.bins[b - 1].modulus_high - found.bins[b].modulus_high, 60);
    EXPECT_LT(found.bins[b].modulus_high, found.bins[b - 1].modulus_low);
  }
}

TEST(MaterialBins, WithoutAGapHoldEqualElements) {
  const std::vector<double> e{5, 3, 5, 3, 4}, rho{1, 1, 2, 1, 1};
  const MaterialBins found = bin_materials(e, rho, {.gap = 0});
  EXPECT_THAT(found.of_cell, ElementsAre(0, 2, 0, 2, 1));
  EXPECT_EQ(found.bins[0].density, 1.5);
}

TEST(MaterialBins, WhatCannotBeSortedIsRefused) {
  const std::vector<double> one{1}, two{1, 2}, zero{0}, none;
  const std::vector<double> unknown{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_REFUSED(bin_materials(none, none, {}), HasSubstr("found none"));
  EXPECT_REFUSED(bin_materials(two, one, {}), HasSubstr("each of 2 elements, found 1"));
  EXPECT_REFUSED(bin_materials(zero, one, {}), HasSubstr("found 0 MPa and 1 g/cm^3 at element 0"));
  EXPECT_REFUSED(bin_materials(one, unknown, {}), HasSubstr("nan g/cm^3"));
  EXPECT_REFUSED(bin_materials(one, one, {.gap = -1}), HasSubstr("0 MPa, found -1"));
  EXPECT_REFUSED(bin_materials(one, one, {.poisson = 0.5}), HasSubstr("found 0.5"));
}

}  // namespace
}  // namespace mesamis

// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/material_law.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

double modulus(const char* law, double density) {
  return modulus_at(find_material_law(law), density);
}

TEST(MaterialLaw, NamedLawsHaveTheFormulasOfTheirSources) {
  EXPECT_NEAR(modulus("morgan-2003-femoral-neck", 0.5), 6850 * std::pow(0.5, 1.49), 1e-9);
  EXPECT_NEAR(modulus("morgan-2003-pooled", 0.3), 8920 * std::pow(0.3, 1.83), 1e-9);
  EXPECT_NEAR(modulus("keyak-1994", 0.2), 33900 * std::pow(0.2, 2.20), 1e-9);
  EXPECT_NEAR(modulus("keyak-1994", 0.5), 5307 * 0.5 + 469, 1e-9);
  EXPECT_NEAR(modulus("keyak-1994", 1.1), 10200 * std::pow(1.1, 2.01), 1e-9);
  EXPECT_NEAR(modulus("carter-hayes-1977", 1.8), 3790 * std::pow(0.01, 0.06) * 1.8 * 1.8 * 1.8,
              1e-8);
}

/// The sources join the ranges at 0.27 and 0.6 g/cm^3: a wrong digit would leave a step.
TEST(MaterialLaw, PiecesOfKeyakMeet) {
  for (const double at : {0.27, 0.6}) {
    const double below = modulus("keyak-1994", at), above = modulus("keyak-1994", at + 1e-12);
    EXPECT_NEAR(below, above, 1e-3 * below);
  }
}

/// Schileo's law is Morgan's for the femoral neck, by ash density with rho_ash = 0.6 rho_app.
TEST(MaterialLaw, SchileoIsMorganByAshDensity) {
  EXPECT_NEAR(modulus("schileo-2008", 1), 14664, 1);
  for (const double app : {0.1, 0.4, 1.2, 2.0}) {
    EXPECT_NEAR(modulus("schileo-2008", 0.6 * app), modulus("morgan-2003-femoral-neck", app), 1e-8);
  }
}

TEST(MaterialLaw, EveryLawRisesFromZeroAndHasACitation) {
  for (const MaterialLaw& law : material_laws()) {
    EXPECT_EQ(modulus_at(law, 0), 0) << law.name;
    EXPECT_EQ(modulus_at(law, -0.3), 0) << law.name;
    for (double rho = 0.01; rho < 2.2; rho += 0.01) {
      EXPECT_GT(modulus_at(law, rho), modulus_at(law, rho - 0.01)) << law.name << " " << rho;
    }
    EXPECT_THAT(law.citation, testing::MatchesRegex(".*(19|20)[0-9][0-9].*"));
    EXPECT_GT(law.poisson, 0);
    EXPECT_LT(law.poisson, 0.5);
    if (law.valid) {
      EXPECT_LT((*law.valid)[0], (*law.valid)[1]);
    }
  }
}

TEST(MaterialLaw, AnUnknownNameListsAll) {
  for (const MaterialLaw& law : material_laws()) {
    EXPECT_EQ(find_material_law(law.name).citation, law.citation);
    EXPECT_EQ(parse_material_law(law.name).name, law.name);
    EXPECT_REFUSED(find_material_law("morgan"), AllOf(HasSubstr(law.name), HasSubstr("'morgan'")));
    EXPECT_REFUSED(parse_material_law("morgan"),
                   AllOf(HasSubstr(law.name), HasSubstr("E=c*rho^p")));
  }
}

TEST(MaterialLaw, PowerLawsOfTheUsersOwnAreRead) {
  const MaterialLaw law = parse_material_law("E=2017.3*rho^2.5");
  EXPECT_EQ(law.name, "E=2017.3*rho^2.5");
  EXPECT_EQ(law.density, DensityKind::kApparent);
  EXPECT_FALSE(law.valid);
  EXPECT_NEAR(modulus_at(law, 0.7), 2017.3 * std::pow(0.7, 2.5), 1e-9);
  EXPECT_EQ(parse_material_law("E=1*rho_app^1").density, DensityKind::kApparent);
  EXPECT_EQ(parse_material_law("E=1*rho_ash^1").density, DensityKind::kAsh);
  EXPECT_EQ(parse_material_law("E=1*rho_qct^1").density, DensityKind::kQct);
  EXPECT_NEAR(modulus_at(parse_material_law("E=1e4*rho_ash^1.5+20"), 0.25), 1270, 1e-9);
}

TEST(MaterialLaw, OtherTextsAreRefused) {
  for (const char* text : {"", "E=", "E=5", "E=5*rho", "E=5*rho^", "E=5*tau^2", "E=-5*rho^2",
                           "E=5*rho^0", "E=5*rho^2-3", "E=5*rho^2x", "E = 5*rho^2", "E=5*rho^2.5.5",
                           "E=5*rho^2+-3", "E=+-5*rho^2", "E=1e999*rho^2", "E=inf*rho^2"}) {
    EXPECT_REFUSED(parse_material_law(text), HasSubstr("'" + std::string(text) + "'"));
  }
}

/// Whatever the text, a law rises with density or is refused in one line.
TEST(MaterialLaw, TextsAtRandomAreReadOrRefused) {
  const std::vector<std::string> words{"E=", "*", "rho", "_ash", "^", "+",
                                       "-",  "1", ".5",  "e9",   "x"};
  std::mt19937 random(2);
  int laws = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 ? "E=2*rho^" : "";
    for (auto n = random() % 6; n > 0; --n) text += words[random() % words.size()];
    try {
      const MaterialLaw law = parse_material_law(text);
      EXPECT_GT(modulus_at(law, 1), modulus_at(law, 0.5)) << text;
      ++laws;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      EXPECT_LT(std::string(error.what()).size(), 470u);
    }
  }
  EXPECT_GT(laws, 100);
}

}  // namespace
}  // namespace mesamis
